#include "server/frame_mailbox.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <set>
#include <thread>

namespace {
thread_local std::size_t allocations = 0;
}

// Counts what this thread allocates; the address sanitizer has its own operators.
#ifndef FLEXCAST_SANITIZED
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
#endif

namespace flexcast::server {
namespace {

constexpr std::int64_t particles = 5;

State make_state(double value) {
  State state;
  state.positions = VecX::Constant(3 * particles, value);
  state.velocities = VecX::Constant(3 * particles, -value);
  return state;
}

FrameHeader make_header(std::uint64_t frame) {
  FrameHeader header;
  header.frame = frame;
  return header;
}

std::vector<float> floats_of(double value) {
  return std::vector<float>(3 * particles, static_cast<float>(value));
}

TEST(FrameMailbox, HandsFramesOnInOrderAndUnchanged) {
  FrameMailbox mailbox(particles);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(mailbox.push(make_header(i), make_state(i)));
  for (int i = 0; i < 3; ++i) {
    const Frame* frame = mailbox.take();
    ASSERT_NE(frame, nullptr);
    EXPECT_EQ(frame->header.frame, static_cast<std::uint64_t>(i));
    EXPECT_EQ(frame->payload.positions, floats_of(i));
    EXPECT_EQ(frame->state_hash, calc_state_hash(0, make_state(i).positions, make_state(i).velocities));
  }
  EXPECT_EQ(mailbox.take(), nullptr);
}

TEST(FrameMailbox, ComputesTheFieldsOfItsFramesWhenTheFormatHasThem) {
  Model model;
  model.rest_positions = VecX::LinSpaced(3 * particles, 0.0, 3.0 * particles - 1);
  model.springs = {{0, 1}};
  Body& body = model.bodies.emplace_back();
  body.particles = {0, particles};
  body.springs = {0, 1};
  ParticleFields fields(model);
  State state = make_state(1.0);
  state.positions = 2.0 * model.rest_positions;
  FrameMailbox mailbox(particles);
  FrameHeader header = make_header(0);
  header.format.stretch = true;
  ASSERT_TRUE(mailbox.push(header, state, &fields));
  ASSERT_TRUE(mailbox.push(make_header(1), state, nullptr));
  const Frame* frame = mailbox.take();
  ASSERT_EQ(frame->payload.stretch.size(), static_cast<std::size_t>(particles));
  EXPECT_EQ(frame->payload.stretch[0], 1.0f);
  EXPECT_EQ(frame->payload.stretch[2], 0.0f);
  EXPECT_TRUE(frame->payload.stress.empty());
}

TEST(FrameMailbox, RefusesWhenFullAndTheNumbersShowTheGap) {
  FrameMailbox mailbox(particles, {}, {.frames = 4});
  ASSERT_EQ(mailbox.capacity(), 4u);
  std::uint64_t number = 0;
  for (; number < 4; ++number) EXPECT_TRUE(mailbox.push(make_header(number), make_state(0)));
  for (; number < 6; ++number) EXPECT_FALSE(mailbox.push(make_header(number), make_state(0)));
  EXPECT_EQ(mailbox.take()->header.frame, 0u);
  EXPECT_EQ(mailbox.take()->header.frame, 1u);  // frees frame 0
  EXPECT_TRUE(mailbox.push(make_header(number), make_state(0)));
  std::vector<std::uint64_t> rest;
  while (const Frame* frame = mailbox.take()) rest.push_back(frame->header.frame);
  EXPECT_EQ(rest, (std::vector<std::uint64_t>{2, 3, 6}));
}

TEST(FrameMailbox, CallsOnceWhenHalfOfItIsFreeAgain) {
  FrameMailbox mailbox(particles, {}, {.frames = 8});
  int calls = 0;
  mailbox.on_room([&] { ++calls; });
  for (int i = 0; i < 8; ++i) ASSERT_TRUE(mailbox.push(make_header(i), make_state(0)));
  EXPECT_FALSE(mailbox.push(make_header(8), make_state(0)));
  for (int i = 0; i < 3; ++i) mailbox.take();  // five wait
  EXPECT_EQ(calls, 0);
  mailbox.take();
  EXPECT_EQ(calls, 1);
  EXPECT_TRUE(mailbox.push(make_header(8), make_state(0)));
  while (mailbox.take() != nullptr) {
  }
  EXPECT_EQ(calls, 1);
}

TEST(FrameMailbox, TheTakenFrameStaysUntilTheNextIsTaken) {
  FrameMailbox mailbox(particles, {}, {.frames = 4});
  ASSERT_TRUE(mailbox.push(make_header(0), make_state(7)));
  const Frame* taken = mailbox.take();
  while (mailbox.push(make_header(1), make_state(8))) {
  }
  EXPECT_EQ(taken->header.frame, 0u);
  EXPECT_EQ(taken->payload.positions, floats_of(7));
}

TEST(FrameMailbox, IsCappedByBytesButHoldsFourFramesInAnyCase) {
  constexpr std::size_t frame_bytes = 3 * particles * sizeof(float);
  constexpr StreamFormat larger{.velocities = true, .precision = StreamPrecision::float64};
  EXPECT_EQ(FrameMailbox(particles, {}, {.frames = 64, .bytes = 10 * frame_bytes}).capacity(), 10u);
  EXPECT_EQ(FrameMailbox(particles, {}, {.frames = 64, .bytes = 1}).capacity(), 4u);
  EXPECT_EQ(FrameMailbox(particles, larger, {.frames = 64, .bytes = 40 * frame_bytes}).capacity(), 10u);
  EXPECT_EQ(FrameMailbox(particles).capacity(), 64u);
}

TEST(FrameMailbox, AllocatesNothingForFrames) {
  FrameMailbox mailbox(particles, {}, {.frames = 4});
  const State state = make_state(1);
  const std::size_t before = allocations;
  for (int i = 0; i < 1000; ++i) {
    mailbox.push(make_header(i), state);
    if (i % 3 != 0) mailbox.take();
  }
  EXPECT_EQ(allocations, before);
}

TEST(FrameMailbox, AReaderThatKeepsUpTouchesTwoFramesOnly) {
  FrameMailbox mailbox(particles);
  std::set<const float*> memories;
  for (int i = 0; i < 1000; ++i) {
    ASSERT_TRUE(mailbox.push(make_header(i), make_state(i)));
    memories.insert(mailbox.take()->payload.positions.data());
  }
  EXPECT_EQ(memories.size(), 2u);
}

TEST(FrameMailbox, FramesOfAnotherSceneFollowThoseThatWaitAndTheTakenOneStays) {
  FrameMailbox mailbox(particles, {}, {.frames = 4});
  ASSERT_TRUE(mailbox.push(make_header(0), make_state(7)));
  ASSERT_TRUE(mailbox.push(make_header(1), make_state(8)));
  const Frame* taken = mailbox.take();
  mailbox.begin_scene(2 * particles, {});
  State state;
  state.positions = VecX::Constant(6 * particles, 9.0);
  state.velocities = state.positions;
  ASSERT_TRUE(mailbox.push(make_header(2), state));
  EXPECT_EQ(mailbox.waiting(), 2u);
  EXPECT_EQ(taken->payload.positions, floats_of(7));
  EXPECT_EQ(mailbox.take()->payload.positions, floats_of(8));
  taken = mailbox.take();
  EXPECT_EQ(taken->header.frame, 2u);
  EXPECT_EQ(taken->payload.positions, std::vector<float>(6 * particles, 9.0f));
  EXPECT_EQ(mailbox.take(), nullptr);
  EXPECT_EQ(mailbox.capacity(), 4u);
}

TEST(FrameMailbox, NoticesAreNeverRefusedAndOfStatusesTheNewestCounts) {
  FrameMailbox mailbox(particles, {}, {.frames = 4});
  for (std::uint64_t i = 0; i < 1000; ++i) {
    RunStarted run;
    run.run_id = i;
    mailbox.post(std::vector<Notice>{run});
    WorldStatus status;
    status.run_id = i;
    mailbox.post(std::move(status));
  }
  EXPECT_EQ(mailbox.take_notices().size(), 1000u);
  EXPECT_EQ(mailbox.take_status()->run_id, 999u);
  EXPECT_FALSE(mailbox.take_status().has_value());
}

TEST(FrameMailbox, AStatusAnswersTheRequest) {
  FrameMailbox mailbox(particles);
  EXPECT_FALSE(mailbox.status_wanted());
  mailbox.want_status();
  EXPECT_TRUE(mailbox.status_wanted());
  mailbox.post(WorldStatus{});
  EXPECT_FALSE(mailbox.status_wanted());
}

TEST(FrameMailbox, TwoThreadsLoseNothingThatWasTakenIn) {
  FrameMailbox mailbox(particles, {}, {.frames = 8});
  constexpr std::uint64_t frames = 20'000;
  std::uint64_t taken_in = 0;
  std::atomic<bool> done = false;
  std::thread producer([&] {
    State state = make_state(0);
    for (std::uint64_t i = 0; i < frames; ++i) {
      state.positions.setConstant(static_cast<double>(i));
      taken_in += mailbox.push(make_header(i), state) ? 1 : 0;
    }
    done = true;
    mailbox.wake();
  });
  std::uint64_t received = 0;
  std::uint64_t last = 0;
  for (;;) {
    const bool ending = done;
    const Frame* frame = mailbox.take();
    if (frame == nullptr) {
      if (ending) break;
      mailbox.wait_until(Clock::now() + std::chrono::milliseconds(10));
      continue;
    }
    EXPECT_TRUE(received == 0 || frame->header.frame > last);
    last = frame->header.frame;
    EXPECT_EQ(frame->payload.positions[0], static_cast<float>(last));
    EXPECT_EQ(frame->payload.positions[3 * particles - 1], static_cast<float>(last));
    ++received;
  }
  producer.join();
  EXPECT_EQ(received, taken_in);
}

}  // namespace
}  // namespace flexcast::server
