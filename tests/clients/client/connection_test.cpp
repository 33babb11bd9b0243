#include "clients/client/connection.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/fake_server.h"

namespace flexcast::client {
namespace {

using namespace std::chrono_literals;
using test::FakeServer;

ConnectOptions options(const std::string& world = "beam") {
  return {.world = world, .domain = test::test_domain(), .profile = "loopback"};
}

Connection connect(const std::string& world = "beam") {
  auto connection = Connection::open(options(world));
  if (!connection) ADD_FAILURE() << connection.error().message;
  return std::move(connection).value();
}

std::string error_of_open(ConnectOptions wanted, std::chrono::nanoseconds wait = 100ms) {
  wanted.wait = wait;
  const auto connection = Connection::open(wanted);
  return connection ? "" : connection.error().message;
}

std::string place() {
  return " on domain " + std::to_string(test::test_domain()) + " (profile loopback)";
}

TEST(Connect, FindsTheOnlyWorldWithoutItsName) {
  const FakeServer server("beam");
  EXPECT_EQ(connect("").world(), "beam");
}

TEST(Connect, SaysWhatItLookedForWhenThereIsNoServer) {
  EXPECT_EQ(error_of_open(options("")), "no world" + place() + ": waited 0.1 s");
  EXPECT_EQ(error_of_open(options("beam")), "no world 'beam'" + place() + ": waited 0.1 s");
}

TEST(Connect, ListsTheWorldsWhenItMustChooseOrMisses) {
  const FakeServer rope("rope"), beam("beam");
  EXPECT_EQ(error_of_open(options(""), 5s), "more than one world" + place() + ", name one: beam, rope");
  EXPECT_EQ(error_of_open(options("cloth"), 500ms), "no world 'cloth'" + place() + ": waited 0.5 s; there: beam, rope");
}

TEST(Connect, WaitsForAServerThatStartsLater) {
  std::unique_ptr<FakeServer> server;
  std::jthread starter([&] {
    std::this_thread::sleep_for(200ms);
    server = std::make_unique<FakeServer>("beam");
  });
  EXPECT_EQ(connect().world(), "beam");
}

TEST(Connect, GivesEveryClientAnIdOfItsOwn) {
  const FakeServer server("beam");
  std::set<std::string> ids;
  for (int i = 0; i < 5; ++i) ids.insert(connect().client_id());
  EXPECT_EQ(ids.size(), 5u);
}

class Commands : public testing::Test {
 protected:
  FakeServer server{"beam"};
  Connection connection = connect();
};

TEST_F(Commands, AreAnsweredInOrderByTheirOwnReplies) {
  for (std::uint64_t i = 1; i <= 50; ++i) {
    const auto reply = connection.step(2);
    ASSERT_TRUE(reply.ok());
    EXPECT_TRUE(reply.value().applied());
    EXPECT_EQ(reply.value().kind, flexcast_COMMAND_STEP);
    EXPECT_EQ(reply.value().applied_step, 2 * i);
  }
  EXPECT_EQ(server.executed, 50);
}

TEST_F(Commands, AreSentAgainWhenTheyGetLostAndStillExecutedOnce) {
  server.ignore = 2;
  const auto lost_command = connection.step();
  ASSERT_TRUE(lost_command.ok());
  EXPECT_EQ(server.received, 3);
  server.deaf = 1;
  const auto lost_reply = connection.step();
  ASSERT_TRUE(lost_reply.ok());
  EXPECT_EQ(lost_reply.value().applied_step, 2u);
  EXPECT_EQ(server.executed, 2);
}

TEST_F(Commands, GiveUpAfterTheirTimeoutWithAnErrorThatNamesThem) {
  server.ignore = 1'000'000;
  const auto start = Deadline::Clock::now();
  const auto reply = connection.send({.kind = flexcast_COMMAND_PAUSE}, 300ms);
  ASSERT_FALSE(reply.ok());
  EXPECT_EQ(reply.error().message, "no reply to pause from world 'beam'" + place() + " within 0.3 s");
  EXPECT_LT(Deadline::Clock::now() - start, 5s);
}

TEST_F(Commands, OfTwoClientsDoNotMixUp) {
  Connection other = connect();
  ASSERT_TRUE(connection.set({{"beam.young", 5.0}}).ok());
  ASSERT_TRUE(other.pause().ok());
  EXPECT_EQ(other.get({"beam.young"}).value().values, (std::vector{Parameter{"beam.young", 5.0}}));
  EXPECT_EQ(connection.resume().value().state, flexcast_WORLD_RUNNING);
}

TEST_F(Commands, SetTextTakesTheKindsFromTheServer) {
  const std::vector<std::string> texts{"gravity=[0, 0, -3]", "beam.young=2000", "time.substeps=4.0",
                                       "solver.linear=pcg"};
  const auto reply = connection.set_text(texts);
  ASSERT_TRUE(reply.ok());
  EXPECT_TRUE(reply.value().applied()) << reply.value().reason;
  EXPECT_EQ(reply.value().parameter_revision, 1u);
  const auto now = connection.get();
  ASSERT_TRUE(now.ok());
  EXPECT_EQ(*now.value().find("gravity"), Value(Vector{0, 0, -3}));
  EXPECT_EQ(*now.value().find("beam.young"), Value(2000.0));
  EXPECT_EQ(*now.value().find("time.substeps"), Value(std::int64_t{4}));
  EXPECT_EQ(*now.value().find("solver.linear"), Value(std::string("pcg")));
  EXPECT_EQ(now.value().find("nothing"), nullptr);
}

TEST_F(Commands, SaveRestoreGrabAndReleaseCarryTheirArguments) {
  ASSERT_TRUE(connection.step(3).ok());
  EXPECT_TRUE(connection.save("start").value().applied());
  ASSERT_TRUE(connection.step(4).ok());
  EXPECT_EQ(connection.restore("start").value().applied_step, 3u);
  EXPECT_EQ(connection.restore("end").value().outcome, flexcast_OUTCOME_REJECTED);
  EXPECT_EQ(connection.load("other").value().kind, flexcast_COMMAND_LOAD);
  EXPECT_TRUE(connection.grab(7, {1, -2, 0.5}, 40).value().applied());
  EXPECT_EQ(*connection.release(7).value().find("released"), Value(std::string("[1, -2, 0.5] m, 40 N/m")));
  EXPECT_FALSE(connection.release(7).value().applied());
}

TEST_F(Commands, ThatTheServerRefusesAreRepliesWithAReason) {
  const auto reply = connection.set({{"no.such", 1.0}});
  ASSERT_TRUE(reply.ok());
  EXPECT_EQ(reply.value().outcome, flexcast_OUTCOME_REJECTED);
  EXPECT_NE(reply.value().reason.find("no.such"), std::string::npos);
}

TEST_F(Commands, StatusIsNewerThanTheCall) {
  ASSERT_TRUE(connection.pause().ok());
  const auto status = connection.status();
  ASSERT_TRUE(status.ok());
  EXPECT_EQ(status.value()->state, flexcast_WORLD_PAUSED);
  server.quiet = true;
  (void)connection.status(100ms);  // one may have been on its way
  const auto silent = connection.status(300ms);
  ASSERT_FALSE(silent.ok());
  EXPECT_EQ(silent.error().message, "no status from world 'beam'" + place() + " within 0.3 s");
}

TEST(Reconnect, FindsAServerThatWasStartedAnew) {
  auto server = std::make_unique<FakeServer>("beam");
  Connection connection = connect();
  ASSERT_TRUE(connection.step(3).ok());
  server = nullptr;
  server = std::make_unique<FakeServer>("beam");
  const auto reply = connection.step();
  ASSERT_TRUE(reply.ok());
  EXPECT_EQ(reply.value().applied_step, 1u);
}

TEST_F(Commands, ReachTheServerOfTheirWorldAmongSeveral) {
  FakeServer other("rope");
  Connection to_other = connect("rope");
  ASSERT_TRUE(connection.step(1).ok());
  ASSERT_TRUE(to_other.step(5).ok());
  EXPECT_EQ(connection.step(1).value().applied_step, 2u);
  EXPECT_EQ(other.executed, 1);
}

class Frames : public Commands {
 protected:
  FrameStream frames = connection.frames().value();
};

TEST_F(Frames, ComeInOrderAndWhole) {
  for (std::uint64_t i = 0; i < 20; ++i) server.publish(1, i, 3);
  for (std::uint64_t i = 0; i < 20; ++i) {
    const auto frame = frames.next(5s);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->frame, i);
    EXPECT_EQ(frame->position(5)[0], 100.0 * static_cast<double>(i) + 5);
  }
  EXPECT_EQ(frames.missed(), 0u);
  EXPECT_FALSE(frames.next(0ms));
}

TEST_F(Frames, AreWaitedForByPredicate) {
  std::jthread publisher([&] {
    for (std::uint64_t i = 0; i < 10; ++i) {
      std::this_thread::sleep_for(5ms);
      server.publish(1, i);
    }
  });
  const auto frame = frames.wait_for_frame([](const Frame& f) { return f.step >= 7; }, 10s);
  ASSERT_TRUE(frame.ok());
  EXPECT_EQ(frame.value().frame, 7u);
}

TEST_F(Frames, ThatDoNotComeAreAnErrorThatSaysWhatWasSeen) {
  const auto wanted = [](const Frame& f) { return f.step > 5; };
  EXPECT_EQ(frames.wait_for_frame(wanted, 50ms).error().message,
            "no such frame of world 'beam' within 0.05 s: there was none");
  server.publish(1, 2);
  EXPECT_EQ(frames.wait_for_frame(wanted, 100ms).error().message,
            "no such frame of world 'beam' within 0.1 s: the last one was frame 2, step 2");
}

TEST_F(Frames, OfOtherWorldsStayOut) {
  const FakeServer other("rope");
  other.publish(1, 0);
  server.publish(1, 1);
  EXPECT_EQ(frames.next(5s)->frame, 1u);
  EXPECT_FALSE(frames.next(50ms));
}

TEST_F(Frames, NewestPassesOverWhatCameBefore) {
  auto newest = connection.frames(Keep::newest).value();
  for (std::uint64_t i = 0; i < 10; ++i) server.publish(1, i);
  EXPECT_EQ(newest.next(5s)->frame, 9u);
}

TEST_F(Frames, OutliveTheirConnection) {
  { const Connection gone = std::move(connection); }
  server.publish(1, 0);
  EXPECT_TRUE(frames.next(5s));
}

}  // namespace
}  // namespace flexcast::client
