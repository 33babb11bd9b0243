// What statuses, their absence and their end say of a world.
#include "clients/ctl/health.h"

#include <gtest/gtest.h>

namespace flexcast::ctl {
namespace {

using namespace std::chrono_literals;
using Kind = wire::StatusNews::Kind;

class HealthJudgement : public testing::Test {
 protected:
  // A status written and heard so long after the start.
  void hear(std::chrono::milliseconds when, std::uint64_t heartbeat, std::uint64_t server = 1,
            double step_seconds = 0.0) {
    const auto status = std::make_shared<wire::Owned<flexcast_Status>>();
    (*status)->heartbeat = heartbeat;
    (*status)->server_id = server;
    (*status)->step_seconds = step_seconds;
    judge.see({Kind::status, "beam", {status, &**status}, {}, std::chrono::nanoseconds(when).count(), at(when)});
  }
  void hear_end(std::chrono::milliseconds when, Kind kind) { judge.see({kind, "beam", {}, {}, 0, at(when)}); }
  Health health(std::chrono::milliseconds when) const { return judge.judge(at(when)); }
  static HealthJudge::Clock::time_point at(std::chrono::milliseconds when) {
    return HealthJudge::Clock::time_point(1h) + when;
  }

  HealthJudge judge;
};

TEST_F(HealthJudgement, NothingHeardIsNotFound) {
  EXPECT_EQ(health(0ms), Health::not_found);
}

TEST_F(HealthJudgement, AHeartbeatThatMovesIsOkAndAPulse) {
  hear(0ms, 1);
  EXPECT_FALSE(judge.has_pulse());
  hear(250ms, 40);
  EXPECT_TRUE(judge.has_pulse());
  EXPECT_EQ(health(260ms), Health::ok);
}

TEST_F(HealthJudgement, TheSameHeartbeatForHalfASecondIsHungUntilItMoves) {
  for (const auto when : {0ms, 240ms}) hear(when, 7);
  EXPECT_EQ(health(250ms), Health::ok) << "not yet";
  hear(480ms, 7);
  EXPECT_EQ(health(490ms), Health::hung);
  EXPECT_NE(describe(Health::hung, judge, at(490ms)).find("stands still: heartbeat 7"), std::string::npos);
  hear(720ms, 8);
  EXPECT_EQ(health(730ms), Health::ok);
}

TEST_F(HealthJudgement, AWorldOfLongStepsIsGivenThreeOfThem) {
  for (const auto when : {0ms, 500ms, 1000ms, 2900ms}) hear(when, 7, 1, 1.0);
  EXPECT_EQ(health(2900ms), Health::ok);
  hear(3100ms, 7, 1, 1.0);
  EXPECT_EQ(health(3100ms), Health::hung);
}

TEST_F(HealthJudgement, SilenceIsGone) {
  hear(0ms, 1);
  EXPECT_EQ(health(1400ms), Health::ok);
  EXPECT_EQ(health(1600ms), Health::gone);
  hear(1700ms, 2);
  EXPECT_EQ(health(1700ms), Health::ok);
}

TEST_F(HealthJudgement, AGoodbyeIsNoDeathAndBothEndWithTheNextStatus) {
  hear(0ms, 1);
  hear_end(10ms, Kind::goodbye);
  EXPECT_EQ(health(20ms), Health::ended);
  EXPECT_EQ(health(9000ms), Health::ended);
  hear(9100ms, 1, 2);
  EXPECT_EQ(health(9100ms), Health::ok);
  hear_end(9200ms, Kind::vanished);
  EXPECT_EQ(health(9200ms), Health::gone);
}

TEST_F(HealthJudgement, AnotherServersHeartbeatIsNotCompared) {
  hear(0ms, 7, 1);
  hear(600ms, 7, 2);
  EXPECT_EQ(health(600ms), Health::ok);
  EXPECT_FALSE(judge.has_pulse());
}

}  // namespace
}  // namespace flexcast::ctl
