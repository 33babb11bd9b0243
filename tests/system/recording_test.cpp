// A recording holds every step, bit for bit what a run without network computes.
#include "tests/system/recording.h"

#include <gtest/gtest.h>

#include <cstring>

#include "tests/system/replay.h"
#include "tests/system/scenes.h"
#include "tests/system/system_test.h"

namespace flexcast::test {
namespace {

using RecordingSystem = SystemTest;

bool same_bits(const std::vector<double>& recorded, const VecX& computed) {
  return recorded.size() == static_cast<std::size_t>(computed.size()) &&
         std::memcmp(recorded.data(), computed.data(), recorded.size() * sizeof(double)) == 0;
}

bool same_after_rounding(const std::vector<float>& recorded, std::size_t first, const VecX& computed) {
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    if (recorded[i] != static_cast<float>(computed[static_cast<Eigen::Index>(first + i)])) return false;
  }
  return true;
}

// Frame k is the state after k steps: numbers, time and every coordinate.
void expect_states(const std::vector<FrameMessage>& frames, const std::filesystem::path& scene) {
  std::size_t k = 0;
  replay(scene, static_cast<std::int64_t>(frames.size()) - 1, {}, [&](const Simulation& simulation) {
    if (testing::Test::HasFatalFailure()) return;
    const FrameMessage& frame = frames[k++];
    const State& state = simulation.state();
    ASSERT_EQ(frame.step, static_cast<std::uint64_t>(state.step));
    ASSERT_EQ(frame.time, state.time) << "step " << frame.step;
    ASSERT_EQ(frame.state_hash, simulation.calc_state_hash()) << "step " << frame.step;
    ASSERT_TRUE(same_bits(frame.positions64, state.positions)) << "step " << frame.step;
    ASSERT_TRUE(same_bits(frame.velocities64, state.velocities)) << "step " << frame.step;
  });
}

TEST_F(RecordingSystem, TwoThousandStepsWithoutAGapEqualAHeadlessRun) {
  const auto scene = write_file("pair.toml", pair_scene());
  const auto server = start_server(scene, {"--paused", "--rate", "0.5"});
  auto connection = connect();
  const auto recorder = start_recorder("run.mcap", {"--frames", "2001"});
  wait_for_frames(1);  // the initial state is there
  const auto reply = applied(connection.step(2000, patience));
  EXPECT_EQ(reply.applied_step, 2000U);
  EXPECT_EQ(reply.state, flexcast_WORLD_PAUSED);
  const Json summary = await_recorder(*recorder);
  EXPECT_EQ(summary["frames"], 2001);
  EXPECT_EQ(summary["gaps"], 0);
  EXPECT_EQ(summary["dropped"], 0);
  EXPECT_EQ(summary["runs"].size(), 1U);

  const Recording recording = read_recording(path("run.mcap"));
  expect_complete(recording);
  EXPECT_EQ(recording.metadata.at("flexcast.gaps").at("missing"), "0");
  ASSERT_EQ(recording.frames.size(), 2001U);
  ASSERT_EQ(recording.run_ids(), std::vector{reply.run_id});
  expect_contiguous(recording.frames, 0);
  expect_states(recording.frames, scene);

  const Ended lab = run("flexcast-lab", {"run", scene.string(), "--steps", "2000", "--json"});
  ASSERT_EQ(lab.code, 0) << lab.err;
  const std::string hash = Json::parse(lab.out)["state_hash"];  // 16 hexadecimal digits
  EXPECT_EQ(std::stoull(hash, nullptr, 16), recording.frames.back().state_hash);
}

TEST_F(RecordingSystem, RecorderThatSaysItRecordsMissesNothingOfAPausedWorldNotEvenTheInitialState) {
  const auto server = start_server(write_file("pair.toml", pair_scene()), {"--paused", "--rate", "0.5"});
  auto connection = connect();
  const auto recorder = start_recorder("run.mcap");
  applied(connection.step(20, patience));
  wait_for_recorder([](const auto& info) { return info.next_frame == 21; });
  EXPECT_EQ(end_recorder(*recorder)["runs"][0]["joined_at"], 0);
  const Recording recording = read_recording(path("run.mcap"));
  EXPECT_EQ(recording.frames.size(), 21U);
  expect_contiguous(recording.frames, 0);
}

TEST_F(RecordingSystem, ResetStartsANewRunAtStepZeroWithTheBitsOfTheFirst) {
  const auto scene = write_file("pair.toml", pair_scene());
  const auto server = start_server(scene, {"--paused", "--rate", "0.5"});
  auto connection = connect();
  const auto recorder = start_recorder("run.mcap");
  wait_for_frames(1);
  applied(connection.resume());
  wait_for_frames(100);
  const auto set = applied(connection.set({{"rope.stiffness", 20.0}}));
  wait_for_frames(set.applied_step + 100);
  const auto reset = applied(connection.reset());
  EXPECT_NE(reset.run_id, set.run_id);
  EXPECT_EQ(reset.applied_step, 0U);
  EXPECT_EQ(reset.time, 0.0);
  wait_for_recorder([&](const auto& info) { return info.run_id == reset.run_id && info.next_frame > 300; });
  const auto set_again = applied(connection.set({{"rope.stiffness", 20.0}}));
  const auto kept = applied(connection.reset(true));
  wait_for_recorder([&](const auto& info) { return info.run_id == kept.run_id && info.next_frame > 100; });
  EXPECT_EQ(end_recorder(*recorder)["gaps"], 0);

  const Recording recording = read_recording(path("run.mcap"));
  ASSERT_EQ(recording.run_ids(), (std::vector{set.run_id, reset.run_id, kept.run_id}));
  const auto first = recording.frames_of(set.run_id);
  const auto second = recording.frames_of(reset.run_id);
  const auto third = recording.frames_of(kept.run_id);
  for (const auto& run : {first, second, third}) expect_contiguous(run, 0);
  const std::size_t common = std::min(set.applied_step, set_again.applied_step) + 1;  // up to the first change
  ASSERT_GT(common, 100U);
  for (std::size_t k = 0; k < common; ++k) ASSERT_EQ(first[k].state_hash, second[k].state_hash) << "step " << k;
  const Change change{0, {{"rope.stiffness", 20.0}}};
  EXPECT_EQ(hashes_of(third), calc_hashes(scene, static_cast<std::int64_t>(third.size()) - 1, {change}));
}

TEST_F(RecordingSystem, LateRecorderGetsSceneTopologyAndParametersAndSaysWhereItJoined) {
  write_file("meshes/two.node", "5 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 1 1 1\n");
  write_file("meshes/two.ele", "2 4 0\n0 0 1 2 3\n1 1 4 2 3\n");
  const std::string text = rope_scene("pair") +
                           "\n[[body]]\nname = \"solid\"\nmodel = \"fem\"\nmesh = { file = \"meshes/two.node\" }\n"
                           "material = { law = \"corotational\", young = 1e4, poisson = 0.3, density = 1000.0 }\n";
  const auto server = start_server(write_file("pair.toml", text), {"--rate", "0.3", "--set", "rope.damping=0.02"});
  auto connection = connect();
  const auto set = applied(connection.set({{"rope.stiffness", 60.0}}));
  wait_for_status(connection, [](const auto& status) { return status.report.step > 50; });
  const auto recorder = start_recorder("late.mcap", {"--frames", "50"});
  const Json summary = await_recorder(*recorder);
  EXPECT_EQ(summary["gaps"], 0);
  ASSERT_EQ(summary["runs"].size(), 1U);

  const Recording recording = read_recording(path("late.mcap"));
  expect_complete(recording);
  const auto joined = summary["runs"][0]["joined_at"].get<std::uint64_t>();
  EXPECT_GT(joined, 50U);
  ASSERT_EQ(recording.frames.size(), 50U);
  expect_contiguous(recording.frames, joined);
  EXPECT_EQ(recording.metadata.at("flexcast.gaps").at("missing"), "0");

  ASSERT_EQ(recording.scenes.size(), 1U);
  const SceneMessage& sent = recording.scenes[0];
  EXPECT_EQ(sent.scene_text, text);
  EXPECT_EQ(sent.overrides, std::vector<std::string>{"rope.damping=0.02"});
  EXPECT_EQ(sent.particles, 16U);
  ASSERT_EQ(sent.bodies.size(), 2U);
  EXPECT_EQ(sent.bodies[1].tetrahedra, 2U);
  EXPECT_EQ(recording.attachments.at("pair.toml"), text);
  for (const std::string name : {"meshes/two.node", "meshes/two.ele"}) {
    EXPECT_EQ(recording.attachments.at(name), read_file(path(name)));
  }
  ASSERT_EQ(recording.topologies.size(), 2U);
  for (const TopologyMessage& topology : recording.topologies) {
    EXPECT_EQ(topology.rest_positions.size(), topology.body == 0 ? 33U : 15U);
    EXPECT_EQ(topology.springs.size(), topology.body == 0 ? 20U : 0U);
    EXPECT_EQ(topology.tetrahedra.size(), topology.body == 0 ? 0U : 8U);
    EXPECT_EQ(topology.topology_revision, recording.frames[0].topology_revision);
  }
  ASSERT_FALSE(recording.parameter_sets.empty());
  const ParameterSetMessage& parameters = recording.parameter_sets.back();
  EXPECT_EQ(parameters.parameter_revision, recording.frames.back().parameter_revision);
  EXPECT_EQ(parameters.value("rope.stiffness").numbers, std::vector{60.0});
  EXPECT_EQ(parameters.value("rope.damping").numbers, std::vector{0.02});
  const auto events = recording.command_events(flexcast_COMMAND_SET);  // kept for late joiners
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].step, set.applied_step);
}

// Chunks of a frame of 301 x 301 particles, in float32 more than 1 MiB.
TEST_F(RecordingSystem, FramesOverOneMebibyteComeAsChunksThatCoverEveryParticleOnce) {
  constexpr std::uint32_t particles = 301 * 301;
  const auto scene = write_file("sheet.toml", sheet_scene(300));
  const auto server = start_server(scene, {"--paused", "--rate", "0.01"});
  auto connection = connect();
  const auto recorder = start_recorder("sheet.mcap", {"--frames", "6"});
  wait_for_frames(1);
  applied(connection.step(5, patience));
  const Json summary = await_recorder(*recorder);
  EXPECT_EQ(summary["gaps"], 0);
  EXPECT_EQ(summary["frames"], 6);

  const Recording recording = read_recording(path("sheet.mcap"));
  expect_complete(recording);
  std::map<std::uint64_t, std::map<std::uint32_t, const FrameMessage*>> frames;  // by number and first particle
  for (const FrameMessage& chunk : recording.frames) {
    EXPECT_GT(chunk.chunks, 1U);
    EXPECT_EQ(chunk.total, particles);
    EXPECT_LE(4 * chunk.positions.size(), 1U << 20);
    EXPECT_TRUE(frames[chunk.frame].emplace(chunk.first, &chunk).second) << "frame " << chunk.frame << " overlaps";
  }
  ASSERT_EQ(frames.size(), 6U);
  std::uint64_t number = 0;
  replay(scene, 5, {}, [&](const Simulation& simulation) {
    std::uint32_t next = 0;
    for (const auto& [first, chunk] : frames[number]) {
      EXPECT_EQ(first, next) << "frame " << number;
      EXPECT_EQ(chunk->state_hash, simulation.calc_state_hash());
      EXPECT_TRUE(same_after_rounding(chunk->positions, 3 * std::size_t{first}, simulation.state().positions));
      next = first + static_cast<std::uint32_t>(chunk->positions.size() / 3);
    }
    EXPECT_EQ(next, particles) << "frame " << number;
    EXPECT_EQ(frames[number].size(), frames[number].begin()->second->chunks);
    ++number;
  });
}

}  // namespace
}  // namespace flexcast::test
