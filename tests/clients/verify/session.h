// Session: a world in this process, everything it says, and a recording of that.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "clients/mcap/file_sink.h"
#include "clients/mcap/writer.h"
#include "clients/verify/verify.h"
#include "idl/wire/topics.h"
#include "server/convert/events.h"
#include "server/convert/frame_capture.h"
#include "server/convert/frames.h"
#include "server/convert/scene_info.h"
#include "tests/server/worlds.h"
#include "tests/support/encode.h"

namespace flexcast::verify::test {

using server::Command;
using server::Event;
using server::World;
using server::WorldOptions;

// Two bodies: springs and tetrahedra, one of them pinned; `more` may add tables.
inline std::string pair_scene(const std::string& name = "pair", const std::string& more = {}) {
  return "name = \"" + name + R"("
gravity = [0, 0, -9.81]
[time]
step = 0.001
[[body]]
name = "beam"
model = "fem"
mesh = { shape = "beam", cells = [2, 1, 1], size = [0.2, 0.1, 0.1] }
material = { law = "corotational", young = 1e5, poisson = 0.3, density = 1000.0 }
damping = { stiffness = 0.001 }
pin = [ { select = { box = [[-1e-9, -1, -1], [1e-9, 1, 1]] } } ]
[[body]]
name = "rope"
model = "mass_spring"
mesh = { shape = "rope", cells = [6], size = [0.6] }
springs = { stiffness = 20.0, damping = 0.01 }
mass = 0.02
origin = [0, 0, 1]
pin = [ { select = { nodes = [0] } } ]
)" + more;
}

class Session {
 public:
  explicit Session(const std::string& scene, WorldOptions options = {}) {
    options.checkpoints = folder_.path() / "checkpoints";
    if (!options.load_scene) {
      options.load_scene = [](const std::string& name) { return load_scene_text(pair_scene(name)); };
    }
    world_.emplace(server::test::load(scene), options, run_ids_);
    collect();
  }

  World& operator*() { return *world_; }
  World* operator->() { return &*world_; }

  server::Reply apply(const Command& command) {
    world_->apply(command, server::Clock::now());
    server::Reply reply;
    for (server::Reply& one : world_->take_replies()) {
      if (one.key.request_id == command.key.request_id) reply = std::move(one);
    }
    collect();
    return reply;
  }

  // As long as it runs, at most so many steps; each substep is said to take so long.
  int run(int steps, double substep_seconds = 1e-6) {
    int taken = 0;
    for (; taken < steps && world_->running(); ++taken) {
      world_->take_step();
      collect_frame();
      world_->settle(substep_seconds * world_->simulation().choice().substeps);
      collect();
    }
    return taken;
  }

  // The newest frame as it would be had it waited until now.
  void delay_frame() {
    frames.pop_back();
    add_frame(newest_);
  }

  // What is written: a test may change it before.
  std::vector<server::RunStarted> runs;
  std::vector<Event> events;
  std::vector<std::vector<std::byte>> frames;

  std::string write() const {
    const std::string path = folder_.path() / "run.mcap";
    auto sink = mcap::FileSink::create(path, {.replace_existing = true}).value();
    mcap::Writer writer(*sink);
    std::map<wire::TopicId, mcap::ChannelId> channels;
    for (const wire::TopicId id : {wire::TopicId::scene, wire::TopicId::events, wire::TopicId::frames}) {
      const auto schema = writer.add_schema(wire::topic(id).type_name, "omgidl", std::string_view("text"));
      channels[id] = writer.add_channel(wire::topic(id).name, "cdr", schema.value()).value();
    }
    const auto put = [&](wire::TopicId id, const std::vector<std::byte>& bytes) {
      EXPECT_TRUE(writer.write_message(channels[id], 0, 1, 1, bytes).ok());
    };
    for (const auto& run : runs) put(wire::TopicId::scene, flexcast::test::encode(*make_scene_info(run, "world")));
    for (const Event& event : events) put(wire::TopicId::events, flexcast::test::encode(*to_wire(event, "world")));
    for (const auto& frame : frames) put(wire::TopicId::frames, frame);
    EXPECT_TRUE(writer.close().ok());
    EXPECT_TRUE(sink->close().ok());
    return path;
  }

  wire::Result<Report> verify(std::optional<std::uint64_t> only = {}) const {
    auto recording = recording::Recording::open(write());
    if (!recording) return recording.error();
    return verify_recording(recording.value(), only, [](const Progress&) { return true; });
  }

 private:
  void collect_frame() {
    const auto header = world_->take_due_frame();
    if (!header) return;
    newest_ = *header;
    add_frame(newest_);
  }

  void add_frame(const server::FrameHeader& header) {
    capture_.fill(header, world_->simulation_state(), nullptr, frame_);
    message_.assign(frame_);
    for (std::uint32_t chunk = 0; chunk < message_.chunks(); ++chunk) {
      frames.push_back(flexcast::test::encode(message_.chunk(chunk)));
    }
  }

  void collect() {
    collect_frame();
    (void)world_->take_replies();
    for (server::Notice& notice : world_->take_notices()) {
      if (auto* run = std::get_if<server::RunStarted>(&notice)) runs.push_back(std::move(*run));
      if (auto* event = std::get_if<Event>(&notice)) events.push_back(std::move(*event));
    }
  }

  server::test::Folder folder_;
  server::RunIds run_ids_;
  std::optional<World> world_;
  server::FrameHeader newest_;
  server::FrameCapture capture_;
  server::Frame frame_;
  server::FrameMessage message_{"world"};
};

}  // namespace flexcast::verify::test
