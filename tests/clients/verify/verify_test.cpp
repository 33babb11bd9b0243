// What verification says of recordings that hold, that were changed, and that lack something.
#include "clients/verify/verify.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "clients/verify/recorded_scene.h"
#include "clients/verify/report_text.h"
#include "idl/wire/fill.h"
#include "idl/wire/frame_head.h"
#include "tests/clients/verify/reports.h"

namespace flexcast::verify {
namespace {

using namespace server::test;
using test::Event;
using test::event_of;
using test::only_run;
using test::report_of;
using test::Session;

TEST(Verify, AQuietRunIsEqualInEveryFrame) {
  Session session(test::pair_scene());
  session.run(100);
  const RunReport run = only_run(session);
  EXPECT_EQ(run.verdict, Verdict::equal) << run.reason;
  EXPECT_EQ(run.frames, 101u);
  EXPECT_EQ(run.steps, 100u);
  EXPECT_EQ(run.scene, "pair");
  EXPECT_FALSE(run.first_difference);
}

TEST(Verify, AFlippedBitInAHashNamesThatFrameAndNoOther) {
  Session session(test::pair_scene());
  session.run(50);
  session.frames.at(17).at(wire::frame_offset::state_hash + 3) ^= std::byte{4};
  const RunReport run = only_run(session);
  EXPECT_EQ(run.verdict, Verdict::differs);
  ASSERT_TRUE(run.first_difference);
  EXPECT_EQ(run.first_difference->recorded.frame, 17u);
  EXPECT_EQ(run.first_difference->step, 17);
  EXPECT_EQ(run.first_difference->recorded.state_hash ^ run.first_difference->computed_hash, 4u << 24);
  EXPECT_EQ(run.differing, 1u);
  EXPECT_EQ(run.frames, 51u);
}

TEST(Verify, AFlippedBitInAnEventsValueNamesTheFirstFrameAfterIt) {
  Session session(test::pair_scene());
  session.run(20);
  session.apply(set({{"gravity", Vec3(0, 0, -3)}}));
  session.run(20);
  Vec3 changed(0, 0, -3);
  reinterpret_cast<std::uint64_t*>(changed.data())[2] ^= std::uint64_t{1} << 44;
  event_of(session, server::CommandKind::set).values[0].value = changed;
  const RunReport run = only_run(session);
  EXPECT_EQ(run.verdict, Verdict::differs);
  ASSERT_TRUE(run.first_difference);
  EXPECT_EQ(run.first_difference->recorded.frame, 21u);
  EXPECT_EQ(run.differing, 20u);
  EXPECT_NE(run.first_difference->after.find("set gravity"), std::string::npos) << run.first_difference->after;
}

TEST(Verify, AMissingEventRefusesTheRunAndIsNamed) {
  Session session(test::pair_scene());
  for (int i = 0; i < 4; ++i) {
    session.run(5);
    session.apply(set({{"rope.stiffness", 10.0 + i}}));
  }
  session.run(5);
  const auto lost =
      std::find_if(session.events.begin(), session.events.end(), [](const Event& e) { return e.index == 2; });
  session.events.erase(lost);
  const RunReport run = only_run(session);
  EXPECT_EQ(run.verdict, Verdict::not_verifiable);
  EXPECT_NE(run.reason.find("event 2 is missing"), std::string::npos) << run.reason;
  EXPECT_EQ(run.frames, 0u);
}

TEST(Verify, ARunWithoutItsSceneOrEventsCannotBeVerified) {
  Session without_scene(test::pair_scene());
  without_scene.run(5);
  without_scene.runs.clear();
  EXPECT_EQ(only_run(without_scene).verdict, Verdict::not_verifiable);
  Session without_events(test::pair_scene());
  without_events.run(5);
  without_events.events.clear();
  const RunReport run = only_run(without_events);
  EXPECT_EQ(run.verdict, Verdict::not_verifiable);
  EXPECT_NE(run.reason.find("event 0 is missing"), std::string::npos) << run.reason;
}

TEST(Verify, ALateRecordersRunIsVerifiedFromItsBeginning) {
  Session session(test::pair_scene());
  session.run(10);
  session.apply(set({{"gravity", Vec3(0, 0, -1)}}));
  session.run(20);
  session.frames.erase(session.frames.begin(), session.frames.begin() + 15);
  const RunReport run = only_run(session);
  EXPECT_EQ(run.verdict, Verdict::equal) << run.reason;
  EXPECT_EQ(run.frames, 16u);
  EXPECT_EQ(run.missing_frames, 15u);
}

TEST(Verify, GapsAreCountedAndNamedAndTheRestIsCompared) {
  Session session(test::pair_scene());
  session.run(30);
  session.frames.erase(session.frames.begin() + 20, session.frames.begin() + 23);
  session.frames.erase(session.frames.begin() + 10);
  const RunReport run = only_run(session);
  EXPECT_EQ(run.verdict, Verdict::equal) << run.reason;
  EXPECT_EQ(run.frames, 27u);
  EXPECT_EQ(run.missing_frames, 4u);
  const std::vector<std::pair<std::uint64_t, std::uint64_t>> gaps = {{10, 10}, {20, 22}};
  EXPECT_EQ(run.gaps, gaps);
}

TEST(Verify, AFrameThatNoStepGivesIsADifference) {
  Session session(test::pair_scene());
  session.run(10);
  session.apply(set({{"stream.every", std::int64_t{5}}}));
  session.run(10);
  event_of(session, server::CommandKind::set).values[0].value = std::int64_t{6};
  const RunReport run = only_run(session);
  EXPECT_EQ(run.verdict, Verdict::differs) << run.reason;
}

// What a run of a scene gives whose mesh is a TetGen pair in `folder`, called `name`; the files are gone by then.
Report report_of_mesh_named(const std::filesystem::path& folder, const std::string& name) {
  std::ofstream(folder / "tetrahedron.node") << "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n";
  std::ofstream(folder / "tetrahedron.ele") << "1 4 0\n0 0 1 2 3\n";
  std::filesystem::create_directory(folder / "scenes");
  const std::string text = R"(name = "one"
gravity = [0, 0, -9.81]
[[body]]
name = "stone"
model = "fem"
mesh = { file = ")" + name +
                           R"(" }
material = { law = "corotational", young = 1e5, poisson = 0.3, density = 1000.0 }
)";
  server::WorldOptions options;
  options.load_scene = [&](const std::string&) { return load_scene_text(text, "scene", folder / "scenes"); };
  Session session(test::pair_scene(), options);
  const auto reply = session.apply(server::test::load_scene("one"));
  EXPECT_EQ(reply.outcome, server::Outcome::applied) << reply.reason;
  session.run(10);
  std::filesystem::remove(folder / "tetrahedron.node");
  std::filesystem::remove(folder / "tetrahedron.ele");
  return report_of(session);
}

TEST(Verify, MeshFilesComeFromTheRecordingWhateverTheSceneCallsThem) {
  const server::test::Folder folder;
  const std::string up = "../";
  std::string far_up = "../tetrahedron.ele";  // more folders up than there are, and down again
  for (int i = 0; i < 30; ++i) far_up = up + far_up;
  far_up.replace(far_up.rfind("tetra"), std::string::npos, folder.path().string().substr(1) + "/tetrahedron.ele");
  for (const std::string& name :
       {std::string("../tetrahedron.node"), (folder.path() / "tetrahedron.node").string(),
        (folder.path() / "tetrahedron.ele").string(), std::string(".././scenes/../tetrahedron.ele"), far_up}) {
    const Report report = report_of_mesh_named(folder.path(), name);
    EXPECT_TRUE(report.verified()) << name << "\n" << to_text(report);
    EXPECT_EQ(report.runs.at(1).frames, 11u) << name;
  }
}

// A recording is read from anywhere: it may not make files elsewhere, nor read what it did not bring.
TEST(Verify, AMeshOfAnAbsoluteNameIsNeitherReadNorWrittenThere) {
  const server::test::Folder folder;
  const auto mesh = folder.path() / "tetrahedron.node";
  const Report report = report_of_mesh_named(folder.path(), mesh.string());
  EXPECT_TRUE(report.verified());
  EXPECT_FALSE(std::filesystem::exists(mesh));

  std::ofstream(mesh) << "0 3 0 0\n";  // were it read, the run could not be
  Session session(test::pair_scene());
  session.run(3);
  wire::Owned<flexcast_SceneInfo> info = server::make_scene_info(session.runs.at(0), "world");
  wire::set_string(info->scene_text, "name = \"one\"\n[[body]]\nname = \"stone\"\nmodel = \"fem\"\nmesh = { file = \"" +
                                         mesh.string() +
                                         "\" }\nmaterial = { law = \"linear\", young = 1e5, poisson = 0.3, "
                                         "density = 1000.0 }\n");
  const auto scene = load_recorded_scene(*info);
  ASSERT_FALSE(scene.ok());
  EXPECT_NE(scene.error().message.find("there is no such file"), std::string::npos) << scene.error().message;
}

TEST(Verify, AFileOfTheSceneThatHasNoNameIsRefused) {
  Session session(test::pair_scene());
  wire::Owned<flexcast_SceneInfo> info = server::make_scene_info(session.runs.at(0), "world");
  const auto files = wire::resize(info->files, 1);
  for (const std::string name : {"", "..", "/tmp/.."}) {
    wire::set_string(files[0].name, name);
    const auto scene = load_recorded_scene(*info);
    ASSERT_FALSE(scene.ok()) << name;
    EXPECT_NE(scene.error().message.find("'" + name + "'"), std::string::npos) << scene.error().message;
  }
}

TEST(Verify, JsonHasWhatTheTextSays) {
  Session session(test::pair_scene());
  session.run(10);
  session.frames.at(4).at(wire::frame_offset::state_hash) ^= std::byte{1};
  const auto json = nlohmann::json::parse(to_json(report_of(session)));
  EXPECT_EQ(json["verified"], false);
  EXPECT_EQ(json["runs"][0]["verdict"], "differs");
  EXPECT_EQ(json["runs"][0]["first_difference"]["frame"], 4);
  EXPECT_NE(to_text(report_of(session)).find("first difference: frame 4, step 4"), std::string::npos);
}

}  // namespace
}  // namespace flexcast::verify
