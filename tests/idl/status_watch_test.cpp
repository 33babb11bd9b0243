// How statuses come and end, and who is on a domain.
#include "idl/wire/status_watch.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "idl/wire/domain_census.h"
#include "idl/wire/fill.h"
#include "idl/wire/host_network.h"
#include "idl/wire/writer.h"
#include "tests/support/network.h"

namespace flexcast::wire {
namespace {

using namespace std::chrono_literals;
using Kind = StatusNews::Kind;

Owned<flexcast_Status> make_status(std::uint64_t heartbeat) {
  Owned<flexcast_Status> status;
  set_string(status->world, "beam");
  status->heartbeat = heartbeat;
  return status;
}

class StatusWatchTest : public testing::Test {
 protected:
  // The news until one of that kind, which must come.
  StatusNews await(Kind kind) {
    for (int i = 0; i < 300; ++i) {
      for (StatusNews& news : watch.take()) {
        if (news.kind == kind) return std::move(news);
      }
      watch.wait(100ms);
    }
    ADD_FAILURE() << "the news does not come";
    return {};
  }

  const Participant participant = flexcast::test::join_test_domain();
  StatusWatch watch = StatusWatch::create(participant).value();
  std::optional<Participant> other = flexcast::test::join_test_domain();
  std::optional<Writer<flexcast_Status>> writer = Writer<flexcast_Status>::create(*other).value();
};

TEST_F(StatusWatchTest, AStatusSaysWhoWroteItAndWhen) {
  ASSERT_TRUE(writer->write(*make_status(5)).ok());
  const StatusNews news = await(Kind::status);
  EXPECT_EQ(news.world, "beam");
  EXPECT_EQ(news.status->heartbeat, 5u);
  EXPECT_EQ(news.participant, other->guid());
  EXPECT_GT(news.written, 0);
  EXPECT_EQ(watch.servers(), std::vector<Guid>{other->guid()});
}

TEST_F(StatusWatchTest, AnEndOnPurposeIsAGoodbye) {
  ASSERT_TRUE(writer->write(*make_status(5)).ok());
  await(Kind::status);
  ASSERT_TRUE(writer->dispose(*make_status(0)).ok());
  EXPECT_EQ(await(Kind::goodbye).world, "beam");
}

TEST_F(StatusWatchTest, AnEndWithoutGoodbyeIsNone) {
  ASSERT_TRUE(writer->write(*make_status(5)).ok());
  await(Kind::status);
  writer.reset();
  EXPECT_EQ(await(Kind::vanished).world, "beam");
}

TEST_F(StatusWatchTest, TheCensusKnowsTheOthersAndWhatTheyWrite) {
  const auto census = DomainCensus::create(participant).value();
  const auto knows = [&] {
    const auto writers = census.writers();
    return std::any_of(writers.begin(), writers.end(), [&](const RemoteWriter& one) {
      return one.participant == other->guid() && one.topic == "flexcast/status" && one.type == "flexcast::Status";
    });
  };
  for (int i = 0; i < 1000 && !knows(); ++i) usleep(10'000);
  EXPECT_TRUE(knows());
  const auto participants = census.participants();
  EXPECT_NE(std::find(participants.begin(), participants.end(), other->guid()), participants.end());
  EXPECT_EQ(std::find(participants.begin(), participants.end(), participant.guid()), participants.end());
}

TEST(HostNetwork, KnowsTheLoopbackInterfaceAndGrantsNoMoreThanAsked) {
  const auto interfaces = find_interfaces();
  EXPECT_TRUE(std::any_of(interfaces.begin(), interfaces.end(),
                          [](const NetworkInterface& one) { return one.loopback && one.address == "127.0.0.1"; }));
  EXPECT_GT(grant_receive_buffer(4096), 0u);
  EXPECT_LE(grant_receive_buffer(std::size_t{1} << 30), std::size_t{1} << 30);
}

}  // namespace
}  // namespace flexcast::wire
