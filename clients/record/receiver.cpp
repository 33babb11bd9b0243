#include "clients/record/receiver.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "clients/record/message_head.h"
#include "idl/wire/fill.h"

namespace flexcast::record {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t batch_samples = 64;
constexpr std::size_t batch_bytes = std::size_t{64} << 20;  // copied before they go to the queue
constexpr auto longest_wait = 100ms;
constexpr auto finishing_time = 500ms;  // for the rest of a frame
constexpr auto finishing_period = 5ms;

std::int64_t system_time() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

Message make_message(wire::TopicId topic, std::uint32_t sequence, const wire::RawSample& sample) {
  return {topic, sequence, sample.receive_time, sample.info.source_time, {sample.bytes.begin(), sample.bytes.end()}};
}

}  // namespace

wire::Result<std::unique_ptr<Receiver>> Receiver::create(const wire::Participant& participant,
                                                         const Subscriptions& subscriptions, ItemQueue& queue,
                                                         const std::string& world, const Limits& limits) {
  auto guard = wire::GuardCondition::create(participant);
  if (!guard) return guard.error();
  auto wait_set = wire::WaitSet::create(participant);
  if (!wait_set) return wait_set.error();
  std::unique_ptr<Receiver> receiver(
      new Receiver(subscriptions, queue, world, limits, std::move(guard).value(), std::move(wait_set).value()));
  wire::WaitSet& set = receiver->wait_set_;
  if (auto attached = set.attach(receiver->guard_); !attached) return attached.error();
  if (auto attached = set.attach_data(subscriptions.scenes()); !attached) return attached.error();
  for (const wire::RawReader& reader : subscriptions.raw()) {
    if (auto attached = set.attach_data(reader); !attached) return attached.error();
  }
  return receiver;
}

Receiver::Receiver(const Subscriptions& subscriptions, ItemQueue& queue, std::string world, const Limits& limits,
                   wire::GuardCondition guard, wire::WaitSet wait_set)
    : subscriptions_(subscriptions),
      queue_(queue),
      world_(std::move(world)),
      limits_(limits),
      guard_(std::move(guard)),
      wait_set_(std::move(wait_set)),
      ledger_(limits.frames) {}

void Receiver::start() {
  thread_ = std::thread(&Receiver::run, this);
}

void Receiver::stop() {
  stopping_ = true;
  guard_.trigger();
  if (thread_.joinable()) thread_.join();
}

Progress Receiver::progress() const {
  const std::scoped_lock lock(mutex_);
  const auto dropped = std::accumulate(reception_.dropped.begin(), reception_.dropped.end(), std::uint64_t{0},
                                       [](std::uint64_t sum, const auto& entry) { return sum + entry.second; });
  return {ledger_.run_id(), ledger_.next_frame(), ledger_.frames(), ledger_.missing(), dropped};
}

Reception Receiver::reception() const {
  Reception reception = reception_;
  reception.runs = ledger_.runs();
  reception.gaps = ledger_.gaps();
  if (first_frame_) reception.seconds = std::chrono::duration<double>(end_time_ - *first_frame_).count();
  return reception;
}

void Receiver::run() {
  while (!at_end()) {
    auto timeout = std::chrono::nanoseconds(longest_wait);
    if (limits_.duration && first_frame_) {
      timeout = std::min<std::chrono::nanoseconds>(timeout, *first_frame_ + *limits_.duration - Clock::now());
    }
    wait_set_.wait(std::max(timeout, 0ns));
    receive();
  }
  if (reception_.end != EndReason::failed) finish_frames();
  end_time_ = Clock::now();
  ended_ = true;
}

bool Receiver::at_end() {
  if (reception_.end == EndReason::failed) return true;
  if (ledger_.is_full()) {
    reception_.end = EndReason::frames;
  } else if (limits_.duration && first_frame_ && Clock::now() - *first_frame_ >= *limits_.duration) {
    reception_.end = EndReason::duration;
  } else {
    return stopping_;
  }
  return true;
}

void Receiver::finish_frames() {
  receive();
  {
    const std::scoped_lock lock(mutex_);
    ledger_.close();
  }
  const auto latest = Clock::now() + finishing_time;
  while (ledger_.in_progress() > 0 && reception_.end != EndReason::failed && Clock::now() < latest) {
    std::this_thread::sleep_for(finishing_period);
    receive();
  }
}

void Receiver::receive() {
  receive_scenes();
  for (const wire::RawReader& reader : subscriptions_.raw()) {
    if (reader.row().id == wire::TopicId::frames) {
      receive_frames(reader);
    } else {
      receive_messages(reader);
    }
  }
}

void Receiver::receive_scenes() {
  const auto samples = subscriptions_.scenes().take();
  if (!samples) return fail(samples.error().message);
  const std::scoped_lock lock(mutex_);
  for (const auto [scene, info] : samples.value()) {
    if (!info.valid || wire::text(scene.world) != world_) continue;
    reception_.server_version = wire::text(scene.version);
    for (Attachment& file : scene_files_.take_new(scene, system_time())) push(wire::TopicId::scene, std::move(file));
  }
}

bool Receiver::belongs(wire::TopicId topic, const wire::RawSample& sample) {
  if (!sample.info.valid) return false;  // the end of an instance: no data
  const auto world = peek_world(topic, sample.bytes);
  if (!world) ++reception_.unreadable;
  return world == world_;
}

void Receiver::receive_messages(const wire::RawReader& reader) {
  const wire::TopicId topic = reader.row().id;
  const std::scoped_lock lock(mutex_);
  const auto taken = reader.take_raw(
      [&](const wire::RawSample& sample) {
        // A number is used up by a message that is dropped, too: it shows.
        if (belongs(topic, sample)) push(topic, make_message(topic, sequences_[topic]++, sample));
      },
      batch_samples);
  if (!taken) fail(taken.error().message);
}

// DDS keeps the order of the samples of each chunk number only, and gives one chunk number after the other: takes all
// there is and puts it in order.
void Receiver::receive_frames(const wire::RawReader& reader) {
  arrivals_.clear();
  arrived_bytes_ = 0;
  const std::scoped_lock lock(mutex_);
  for (std::size_t count = batch_samples; count == batch_samples && arrived_bytes_ < batch_bytes;) {
    const auto taken = reader.take_raw([&](const wire::RawSample& sample) { note_arrival(sample); }, batch_samples);
    if (!taken) return fail(taken.error().message);
    count = taken.value();
  }
  sort_arrivals();
  for (Arrival& arrival : arrivals_) admit(arrival);
  arrivals_.clear();
}

void Receiver::note_arrival(const wire::RawSample& sample) {
  if (!belongs(wire::TopicId::frames, sample)) return;
  auto head = wire::peek_frame_head(sample.bytes);
  if (!head) {
    ++reception_.unreadable;
    return;
  }
  head.value().world = {};  // lives as long as the sample's bytes
  const auto sequence = static_cast<std::uint32_t>(head.value().frame);
  arrivals_.push_back({head.value(), sample.info.writer, make_message(wire::TopicId::frames, sequence, sample)});
  arrived_bytes_ += sample.bytes.size();
}

void Receiver::sort_arrivals() {
  std::vector<std::uint64_t> runs{ledger_.run_id()};  // in the order in which they are met
  const auto rank = [&](std::uint64_t run_id) { return std::find(runs.begin(), runs.end(), run_id) - runs.begin(); };
  for (const Arrival& arrival : arrivals_) {
    if (rank(arrival.head.run_id) == std::ssize(runs)) runs.push_back(arrival.head.run_id);
  }
  const auto earlier = [&](const Arrival& a, const Arrival& b) {
    return std::tuple(rank(a.head.run_id), a.head.frame, a.head.chunk) <
           std::tuple(rank(b.head.run_id), b.head.frame, b.head.chunk);
  };
  if (!std::is_sorted(arrivals_.begin(), arrivals_.end(), earlier)) {
    std::stable_sort(arrivals_.begin(), arrivals_.end(), earlier);
  }
}

void Receiver::admit(Arrival& arrival) {
  const Verdict verdict = ledger_.judge(arrival.head);
  if (verdict == Verdict::invalid) ++reception_.unreadable;
  if (verdict != Verdict::record) return;
  if (!first_frame_) first_frame_ = Clock::now();
  if (push(wire::TopicId::frames, std::move(arrival.message))) {
    ledger_.add(arrival.head, arrival.writer);
  } else {
    ledger_.drop(arrival.head, arrival.writer);
  }
}

bool Receiver::push(wire::TopicId topic, Item item) {
  const Pushed pushed = queue_.push(std::move(item));
  if (pushed == Pushed::full) ++reception_.dropped[topic];
  if (pushed == Pushed::closed) fail("");
  return pushed == Pushed::taken;
}

void Receiver::fail(const std::string& error) {
  if (reception_.end == EndReason::failed) return;
  reception_.end = EndReason::failed;
  reception_.error = error;
}

}  // namespace flexcast::record
