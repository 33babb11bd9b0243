#include "idl/wire/wait_set.h"

#include <gtest/gtest.h>

#include <thread>

#include "tests/idl/samples.h"
#include "tests/support/network.h"

namespace flexcast::wire {
namespace {

using namespace std::chrono_literals;

class WaitSets : public testing::Test {
 protected:
  Participant participant = test::join_test_domain();
  WaitSet set = WaitSet::create(participant).value();
};

TEST_F(WaitSets, TimeOutWhenNothingHappens) {
  const auto guard = GuardCondition::create(participant).value();
  ASSERT_TRUE(set.attach(guard).ok());
  const auto start = std::chrono::steady_clock::now();
  EXPECT_FALSE(set.wait(20ms));
  EXPECT_GE(std::chrono::steady_clock::now() - start, 20ms);
  EXPECT_FALSE(set.wait(0ms));
}

TEST_F(WaitSets, AGuardWakesFromAnotherThreadUntilItIsReset) {
  const auto guard = GuardCondition::create(participant).value();
  ASSERT_TRUE(set.attach(guard).ok());
  std::jthread other([&] {
    std::this_thread::sleep_for(10ms);
    guard.trigger();
  });
  EXPECT_TRUE(set.wait(std::chrono::nanoseconds::max()));
  EXPECT_TRUE(set.wait(0ms));
  guard.reset();
  EXPECT_FALSE(set.wait(0ms));
}

TEST(WaitSetsOfReaders, WakeWhileThereIsDataAndOnEveryNewPeer) {
  const Participant participant = test::join_test_domain();
  const auto reader = Reader<flexcast_Status>::create(participant).value();
  auto set = WaitSet::create(participant).value();
  auto peers = WaitSet::create(participant).value();
  ASSERT_TRUE(set.attach_data(reader).ok());
  ASSERT_TRUE(peers.attach_matched(reader).ok());
  EXPECT_FALSE(peers.wait(0ms));

  const auto writer = Writer<flexcast_Status>::create(participant).value();
  EXPECT_TRUE(peers.wait(5s));
  EXPECT_EQ(reader.matched().total, 1u);
  EXPECT_FALSE(peers.wait(0ms));

  EXPECT_FALSE(set.wait(0ms));
  Owned<flexcast_Status> status;
  test::fill(*status);
  ASSERT_TRUE(writer.write(*status).ok());
  EXPECT_TRUE(set.wait(5s));
  EXPECT_TRUE(set.wait(0ms));
  (void)reader.take();
  EXPECT_FALSE(set.wait(0ms));
}

TEST(WaitSetsOfWriters, WakeOnEveryNewReader) {
  const Participant participant = test::join_test_domain();
  const auto writer = Writer<flexcast_ParticleFrame>::create(participant).value();
  auto set = WaitSet::create(participant).value();
  ASSERT_TRUE(set.attach_matched(writer).ok());
  EXPECT_FALSE(set.wait(0ms));
  { const auto reader = Reader<flexcast_ParticleFrame>::create(participant).value(); }
  EXPECT_TRUE(set.wait(5s));
  EXPECT_EQ(writer.matched().current, 0u);
  EXPECT_EQ(writer.matched().total, 1u);
}

}  // namespace
}  // namespace flexcast::wire
