// What verification says of recordings that hold, that were changed, and that lack something.
#include "clients/verify/verify.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "clients/verify/report_text.h"
#include "idl/wire/frame_head.h"
#include "tests/clients/verify/session.h"

namespace flexcast::verify {
namespace {

using namespace server::test;
using test::Event;
using test::Session;

Report report_of(const Session& session, std::optional<std::uint64_t> only = {}) {
  auto report = session.verify(only);
  if (!report) throw std::runtime_error(report.error().message);
  return std::move(report).value();
}

RunReport only_run(const Session& session) {
  Report report = report_of(session);
  EXPECT_EQ(report.runs.size(), 1u);
  EXPECT_EQ(report.verified(), report.runs[0].verdict == Verdict::equal);
  return std::move(report.runs.at(0));
}

Event& event_of(Session& session, server::CommandKind kind) {
  for (Event& event : session.events) {
    if (event.kind == server::EventKind::command && event.command == kind) return event;
  }
  throw std::runtime_error("no such event");
}

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

TEST(Verify, AnEventThatIsRefusedHereIsADifferenceWithTheEnginesReason) {
  Session session(test::pair_scene());
  session.run(5);
  session.apply(set({{"rope.stiffness", 10.0}}));
  session.run(5);
  event_of(session, server::CommandKind::set).values[0].value = -10.0;
  const RunReport run = only_run(session);
  EXPECT_EQ(run.verdict, Verdict::differs);
  EXPECT_NE(run.reason.find("rope.stiffness = -10"), std::string::npos) << run.reason;
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

TEST(Verify, AFailureMustHappenHereToo) {
  Session session(test::pair_scene());
  session.run(5);
  session.apply(set({{"rope.stiffness", 1e13}}));
  session.run(50);
  ASSERT_EQ(session->state(), server::WorldState::failed);
  session.apply(set({{"rope.stiffness", 10.0}}));
  session.apply(resume());
  session.run(10);
  const RunReport run = only_run(session);
  EXPECT_EQ(run.verdict, Verdict::equal) << run.reason;
  event_of(session, server::CommandKind::set).values[0].value = 20.0;  // with which nothing fails
  EXPECT_EQ(only_run(session).verdict, Verdict::differs);
}

TEST(Verify, ACheckpointOfAnotherRunOfTheRecordingIsKnown) {
  Session session(test::pair_scene());
  session.run(10);
  session.apply(save("start"));
  session.run(10);
  session.apply(reset());
  session.run(15);
  session.apply(restore("start"));
  session.run(10);
  const Report report = report_of(session);
  EXPECT_TRUE(report.verified()) << to_text(report);
  EXPECT_EQ(report.runs.size(), 2u);
  const Report second = report_of(session, 2);
  ASSERT_EQ(second.runs.size(), 1u) << "the first is executed all the same";
  EXPECT_EQ(second.runs[0].number, 2u);
  EXPECT_TRUE(second.verified()) << to_text(second);
  EXPECT_TRUE(report_of(session, session->run_id()).verified()) << "by its id";
  EXPECT_NE(session.verify(3).error().message.find("there is no run 3"), std::string::npos);
}

TEST(Verify, ACheckpointThatTheRecordingHasNotSeenIsRefused) {
  Session session(test::pair_scene());
  session.run(10);
  session.apply(save("start"));
  session.run(10);
  session.apply(restore("start"));
  session.run(10);
  event_of(session, server::CommandKind::save).name = "other";
  const RunReport run = only_run(session);
  EXPECT_EQ(run.verdict, Verdict::not_verifiable);
  EXPECT_NE(run.reason.find("not saved in this recording"), std::string::npos) << run.reason;
  EXPECT_EQ(run.frames, 21u) << "up to there";
}

TEST(Verify, ABudgetsChoicesAreTakenFromTheEvents) {
  Session session(test::pair_scene());
  session.apply(set({{"time.budget", 0.02}}));
  for (int i = 0; i < 10; ++i) session.run(20, 1e-6 * (1 + i));
  const RunReport run = only_run(session);
  EXPECT_EQ(run.verdict, Verdict::equal) << run.reason;
  const auto choice = std::find_if(session.events.rbegin(), session.events.rend(),
                                   [](const Event& e) { return e.kind == server::EventKind::choice; });
  ASSERT_NE(choice, session.events.rend());
  std::get<std::int64_t>(choice->values[0].value) += 1;
  EXPECT_EQ(only_run(session).verdict, Verdict::differs) << "the choices count";
}

TEST(Verify, ATolerancesChoicesMustComeOutAgain) {
  Session session(test::pair_scene("pair", "[[probe]]\nname = \"tip\"\nbody = \"rope\"\nnode = 6\n"));
  session.apply(set({{"time.tolerance", 1e-4}}));
  session.run(300);
  ASSERT_EQ(only_run(session).verdict, Verdict::equal) << only_run(session).reason;
  std::vector<Event*> choices;
  for (Event& event : session.events) {
    if (event.kind == server::EventKind::choice) choices.push_back(&event);
  }
  ASSERT_GE(choices.size(), 3u) << "the motion changes, so does the choice";
  std::get<std::int64_t>(choices[choices.size() - 2]->values[0].value) += 1;
  const RunReport run = only_run(session);
  EXPECT_EQ(run.verdict, Verdict::differs);
  EXPECT_NE(run.reason.find("in the recording"), std::string::npos) << run.reason;
}

// A reset makes the contract anew under the kept values, which is not the same as to set them afterwards.
TEST(Verify, AResetThatKeepsParametersUnderAContractIsEqual) {
  for (const char* contract : {"time.tolerance", "time.budget"}) {
    Session session(test::pair_scene());
    session.apply(set({{contract, 1e-2}, {"rope.stiffness", 1.0}, {"time.integrator", std::string("bdf2")}}));
    session.run(40);
    session.apply(reset(true));
    session.run(40);
    session.apply(reset(false));
    session.run(20);
    const Report report = report_of(session);
    EXPECT_EQ(report.runs.size(), 3u);
    EXPECT_TRUE(report.verified()) << to_text(report);
  }
}

// A parameter of a handle moves particles at once; a frame of before that had to wait at the server shows it.
TEST(Verify, AFrameThatWaitedShowsWhatACommandMadeOfItsState) {
  Session session(R"(name = "held"
[[body]]
name = "rope"
model = "mass_spring"
mesh = { shape = "rope", cells = [6], size = [0.6] }
springs = { stiffness = 20.0, damping = 0.01 }
mass = 0.02
handle = [ { name = "grip", select = { nodes = [0] }, translate = [0, 0, 0.1] } ]
)");
  session.run(10);
  session.apply(set({{"handle.grip.translate", Vec3(0, 0, 0.2)}}));
  const auto at_once = session.frames.back();
  session.delay_frame();
  ASSERT_NE(session.frames.back(), at_once);
  session.run(10);
  const RunReport run = only_run(session);
  EXPECT_EQ(run.verdict, Verdict::equal) << run.reason;
  EXPECT_EQ(run.frames, 21u);
}

TEST(Verify, MeshFilesComeFromTheRecording) {
  const server::test::Folder folder;
  std::ofstream(folder.path() / "tetrahedron.node") << "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n";
  std::ofstream(folder.path() / "tetrahedron.ele") << "1 4 0\n0 0 1 2 3\n";
  std::filesystem::create_directory(folder.path() / "scenes");
  const std::string text = R"(name = "one"
gravity = [0, 0, -9.81]
[[body]]
name = "stone"
model = "fem"
mesh = { file = "../tetrahedron.node" }
material = { law = "corotational", young = 1e5, poisson = 0.3, density = 1000.0 }
)";
  auto scene = load_scene_text(text, "scene", folder.path() / "scenes");
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  server::WorldOptions options;
  options.load_scene = [&](const std::string&) { return load_scene_text(text, "scene", folder.path() / "scenes"); };
  Session session(test::pair_scene(), options);
  session.apply(server::test::load_scene("one"));
  session.run(10);
  std::filesystem::remove(folder.path() / "tetrahedron.node");
  const Report report = report_of(session);
  EXPECT_TRUE(report.verified()) << to_text(report);
  EXPECT_EQ(report.runs.at(1).frames, 11u);
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
