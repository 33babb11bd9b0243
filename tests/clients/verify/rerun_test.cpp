// Each kind of event is executed as it was in the recording.
#include "clients/verify/rerun.h"

#include <gtest/gtest.h>

#include "clients/verify/report_text.h"
#include "tests/clients/verify/reports.h"

namespace flexcast::verify {
namespace {

using namespace server::test;
using test::Event;
using test::event_of;
using test::only_run;
using test::report_of;
using test::Session;

TEST(Rerun, AnEventThatIsRefusedHereIsADifferenceWithTheEnginesReason) {
  Session session(test::pair_scene());
  session.run(5);
  session.apply(set({{"rope.stiffness", 10.0}}));
  session.run(5);
  event_of(session, server::CommandKind::set).values[0].value = -10.0;
  const RunReport run = only_run(session);
  EXPECT_EQ(run.verdict, Verdict::differs);
  EXPECT_NE(run.reason.find("rope.stiffness = -10"), std::string::npos) << run.reason;
}

TEST(Rerun, AFailureMustHappenHereToo) {
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
}

TEST(Rerun, AFailureThatDoesNotHappenHereIsADifferenceAlthoughEveryFrameIsEqual) {
  Session session(test::pair_scene());
  session.run(10);
  Event failure = session.events.back();
  ++failure.index;
  failure.step = 10;
  failure.kind = server::EventKind::state;
  failure.state = server::WorldState::failed;
  session.events.push_back(failure);
  const RunReport run = only_run(session);
  EXPECT_EQ(run.verdict, Verdict::differs);
  EXPECT_EQ(run.differing, 0u);
  EXPECT_NE(run.reason.find("step 11 could not be taken in the recording"), std::string::npos) << run.reason;
}

TEST(Rerun, ACheckpointOfAnotherRunOfTheRecordingIsKnown) {
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

TEST(Rerun, ACheckpointThatTheRecordingHasNotSeenIsRefused) {
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

TEST(Rerun, ABudgetsChoicesAreTakenFromTheEvents) {
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

TEST(Rerun, ATolerancesChoicesMustComeOutAgain) {
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

TEST(Rerun, AResetThatKeepsParametersUnderAContractIsEqual) {
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

TEST(Rerun, AFrameThatWaitedShowsWhatACommandMadeOfItsState) {
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

}  // namespace
}  // namespace flexcast::verify
