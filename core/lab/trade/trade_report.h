// A study of trades in words and in JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/lab/trade/trade.h"

namespace flexcast {

// The table and a sentence a level.
std::string make_trade_text(const Trade& trade);

// "1 %: time.integrator=rk4 time.substeps=4 takes 0.012 s a simulated second, error 0.3 %", or that nothing reached it.
std::string make_level_sentence(const Trade& trade, const TradeLevel& level);

// What errors are measured against, and how good that is.
std::string make_reference_sentence(const Trade& trade);

// The object of trade.json and of --json. null: not measured, not finite.
nlohmann::ordered_json make_trade_json(const Trade& trade);

}  // namespace flexcast
