#include "idl/wire/world_watch.h"

#include <gtest/gtest.h>

#include <thread>

#include "idl/wire/writer.h"
#include "tests/support/network.h"

namespace flexcast::wire {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

Owned<flexcast_Status> status_of(const char* world, std::uint64_t server_id) {
  Owned<flexcast_Status> status;
  set_string(status->world, world);
  status->server_id = server_id;
  return status;
}

TEST(WorldWatch, FindsEveryWorldAndReturnsBeforeItsLimit) {
  const Participant participant = test::join_test_domain();
  const auto first = Writer<flexcast_Status>::create(participant).value();
  const auto second = Writer<flexcast_Status>::create(participant).value();
  ASSERT_TRUE(first.write(*status_of("rope", 1)).ok());
  ASSERT_TRUE(second.write(*status_of("beam", 2)).ok());
  auto watch = WorldWatch::create(participant).value();
  const auto start = Clock::now();
  watch.discover(20s);
  EXPECT_LT(Clock::now() - start, 5s);
  ASSERT_EQ(watch.worlds().size(), 2u);
  EXPECT_EQ(world_name(*watch.worlds()[0]), "beam");
  EXPECT_EQ(world_name(*watch.worlds()[1]), "rope");
  ASSERT_TRUE(watch.find("rope"));
  EXPECT_EQ(watch.find("rope")->status->server_id, 1u);
  EXPECT_EQ(watch.find("rope")->participant, participant.guid());
  EXPECT_FALSE(watch.find("cloth"));
}

TEST(WorldWatch, ForgetsWorldsThatSayGoodbyeOrWhoseServerEnds) {
  const Participant participant = test::join_test_domain();
  auto watch = WorldWatch::create(participant).value();
  const auto polite = Writer<flexcast_Status>::create(participant).value();
  const auto status = status_of("polite", 1);
  ASSERT_TRUE(polite.write(*status).ok());
  {
    const auto sudden = Writer<flexcast_Status>::create(participant).value();
    ASSERT_TRUE(sudden.write(*status_of("sudden", 2)).ok());
    watch.update();
    EXPECT_EQ(watch.worlds().size(), 2u);
  }
  ASSERT_TRUE(polite.dispose(*status).ok());
  watch.update();
  EXPECT_TRUE(watch.worlds().empty());
}

TEST(WorldWatch, ForgetsWorldsThatFallSilent) {
  const Participant participant = test::join_test_domain();
  auto watch = WorldWatch::create(participant).value();
  const auto writer = Writer<flexcast_Status>::create(participant).value();
  ASSERT_TRUE(writer.write(*status_of("stopped", 1)).ok());
  EXPECT_TRUE(watch.wait_for("stopped", 1s));
  std::this_thread::sleep_for(WorldWatch::silence + 100ms);
  watch.update();
  EXPECT_TRUE(watch.worlds().empty());
}

TEST(WorldWatch, WaitsForAWorldThatIsYetToStart) {
  const Participant participant = test::join_test_domain();
  auto watch = WorldWatch::create(participant).value();
  EXPECT_FALSE(watch.wait_for("", 30ms));
  std::jthread server([&] {
    std::this_thread::sleep_for(50ms);
    const auto writer = Writer<flexcast_Status>::create(participant).value();
    (void)writer.write(*status_of("late", 1));
    std::this_thread::sleep_for(500ms);
  });
  EXPECT_TRUE(watch.wait_for("late", 10s));
}

TEST(WorldWatch, SeesTwoServersThatShareAName) {
  const Participant participant = test::join_test_domain();
  auto watch = WorldWatch::create(participant).value();
  const auto first = Writer<flexcast_Status>::create(participant).value();
  const auto second = Writer<flexcast_Status>::create(participant).value();
  ASSERT_TRUE(first.write(*status_of("beam", 1)).ok());
  watch.update();
  ASSERT_TRUE(second.write(*status_of("beam", 2)).ok());
  watch.update();
  EXPECT_EQ(watch.worlds().size(), 2u);
}

}  // namespace
}  // namespace flexcast::wire
