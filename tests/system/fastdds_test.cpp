// A client on another vendor's DDS (tests/interop/fastdds), made from our IDL by its compiler, beside one of ours.
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "idl/wire/fill.h"
#include "tests/system/scenes.h"
#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

struct ForeignFrame {
  std::uint64_t frame = 0, step = 0, state_hash = 0;
  std::uint32_t particles = 0;
  std::vector<double> positions;
};

struct ForeignReply {
  std::uint64_t request = 0;
  int outcome = -1;
  std::uint64_t applied_step = 0;
};

// What flexcast-fastdds printed.
struct Printed {
  std::map<std::uint64_t, ForeignFrame> frames;
  std::vector<ForeignReply> replies;
};

Printed parse(const std::string& text) {
  Printed printed;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "reply") {
      ForeignReply& reply = printed.replies.emplace_back();
      words >> reply.request >> reply.outcome >> reply.applied_step;
    } else if (kind == "frame") {
      ForeignFrame frame;
      words >> frame.frame >> frame.step >> frame.state_hash >> frame.particles;
      for (double x; words >> x;) frame.positions.push_back(x);
      printed.frames[frame.frame] = std::move(frame);
    }
  }
  return printed;
}

class FastDds : public SystemTest {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(program()))
      GTEST_SKIP() << "flexcast-fastdds was not built: install libfastrtps-dev and fastddsgen, and configure again";
  }
  static std::filesystem::path program() { return program_path("flexcast-fastdds"); }

  // Our client's frames 0 to `last`, by number.
  static std::map<std::uint64_t, client::Frame> collect(client::FrameStream& stream, std::uint64_t last) {
    std::map<std::uint64_t, client::Frame> frames;
    while (!frames.contains(last)) {
      auto frame = stream.next(patience);
      if (!frame) throw std::runtime_error("our client gets no more frames");
      frames[frame->frame] = std::move(*frame);
    }
    return frames;
  }

  // The client_id whose command set the parameter, from the events.
  std::string who_set(const std::string& name, double value) const {
    const auto participant = wire::Participant::create({.domain = domain()}).value();
    const auto events =
        wire::Reader<flexcast_Event>::create(participant, wire::topic_of<flexcast_Event>().recorder).value();
    for (const client::Deadline deadline(patience); !deadline.passed(); events.wait(deadline.left())) {
      const auto samples = events.take();
      for (const auto [event, info] : samples.value())
        if (info.valid && event.command_kind == flexcast_COMMAND_SET && event.values._length == 1 &&
            wire::text(event.values._buffer[0].name) == name && event.values._buffer[0].numbers._length == 1 &&
            event.values._buffer[0].numbers._buffer[0] == value)
          return std::string(wire::text(event.client_id));
    }
    return "nobody";
  }
};

TEST_F(FastDds, SeesEveryFrameBitForBitAndCommands) {
  constexpr std::uint64_t steps = 20;
  const auto server = start_server(write_file("rope.toml", rope_scene()), {"--paused", "--rate", "0.5"});
  auto connection = connect();
  auto stream = connection.frames().value();
  Process foreign(program(), {std::to_string(domain()), "rope", "rope.stiffness=20", std::to_string(steps)});
  const auto ours = collect(stream, steps);
  ASSERT_EQ(foreign.wait(patience), 0) << foreign.err();
  const Printed theirs = parse(foreign.out());

  ASSERT_EQ(theirs.replies.size(), 2U);
  for (const ForeignReply& reply : theirs.replies) EXPECT_EQ(reply.outcome, flexcast_OUTCOME_APPLIED);
  EXPECT_EQ(theirs.replies[0].applied_step, 0U);
  EXPECT_EQ(theirs.replies[1].applied_step, steps);
  EXPECT_EQ(who_set("rope.stiffness", 20.0).substr(0, 8), "fastdds-");

  for (std::uint64_t frame = 1; frame <= steps; ++frame) {
    ASSERT_TRUE(theirs.frames.contains(frame)) << frame;
    ASSERT_TRUE(ours.contains(frame)) << frame;
    EXPECT_EQ(theirs.frames.at(frame).step, frame);
    EXPECT_EQ(theirs.frames.at(frame).particles, 11U);
    EXPECT_EQ(theirs.frames.at(frame).state_hash, ours.at(frame).state_hash);
    EXPECT_EQ(theirs.frames.at(frame).positions, ours.at(frame).positions);
  }
  EXPECT_NE(theirs.frames.at(1).positions, theirs.frames.at(steps).positions);
}

}  // namespace
}  // namespace flexcast::test
