// The front, the cheapest for a demand, and the sentences about them.
#include "core/lab/trade/trade_front.h"

#include <gtest/gtest.h>

#include "core/lab/trade/trade_report.h"
#include "tests/core/lab/trade/trade_case.h"

namespace flexcast::test {
namespace {

TradeResult make_result(double cost, double error, const char* label = "") {
  TradeResult result;
  result.status = TradeResult::Status::done;
  result.cost = cost;
  result.error = error;
  result.setting.label = label;
  return result;
}

std::vector<bool> fronts(std::vector<TradeResult> results) {
  mark_front(results);
  std::vector<bool> on;
  for (const TradeResult& result : results) on.push_back(result.on_front);
  return on;
}

TEST(TradeFront, IsWhatNothingBeatsInTimeAndAccuracy) {
  EXPECT_EQ(fronts({make_result(1, 0.1), make_result(2, 0.2), make_result(2, 0.01), make_result(0.5, 0.3)}),
            (std::vector<bool>{true, false, true, true}));
}

TEST(TradeFront, KeepsEqualsAndLeavesOutWhatFailed) {
  std::vector<TradeResult> results = {make_result(1, 0.1), make_result(1, 0.1), make_result(0.1, 0.0)};
  results[2].status = TradeResult::Status::failed;
  EXPECT_EQ(fronts(results), (std::vector<bool>{true, true, false}));
}

TEST(TradeLevels, NameTheCheapestThatIsAccurateEnoughWithTheReferencesErrorOnTop) {
  const std::vector<TradeResult> results = {make_result(3, 0.0005), make_result(1, 0.05), make_result(2, 0.0095)};
  const auto exact = find_cheapest(results, 0.0);
  EXPECT_EQ(exact[0].cheapest, 1);
  EXPECT_EQ(exact[1].cheapest, 2);
  EXPECT_EQ(exact[2].cheapest, 0);
  const auto rough = find_cheapest(results, 0.002);
  EXPECT_EQ(rough[1].cheapest, 0);
  EXPECT_EQ(rough[2].cheapest, -1);
  EXPECT_TRUE(rough[1].decidable);
  EXPECT_FALSE(rough[2].decidable);
}

TEST(TradeSentence, NamesSettingTimeAndErrorOrThatNothingReachedIt) {
  Trade trade;
  trade.motion = 1.0;
  trade.results = {make_result(0.25, 0.05, "time.integrator=rk4 time.substeps=4")};
  trade.reference.error = 0.002;
  const auto levels = find_cheapest(trade.results, trade.own_error());
  EXPECT_EQ(make_level_sentence(trade, levels[0]),
            "10 %: time.integrator=rk4 time.substeps=4 takes 0.25 s a simulated second, error 5 %");
  EXPECT_EQ(make_level_sentence(trade, levels[1]),
            "1 %: no setting reached it, the closest is time.integrator=rk4 time.substeps=4 with 5 %");
  EXPECT_EQ(make_level_sentence(trade, levels[2]), "0.1 %: cannot be told, the reference's own error is 0.2 %");
  trade.results.clear();
  EXPECT_EQ(make_level_sentence(trade, levels[1]), "1 %: no setting reached it, none came to its end");
}

}  // namespace
}  // namespace flexcast::test
