// The formats of a stream as a table for people, as CSV and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/lab/stream/stream_trade.h"

namespace flexcast {

// Ends with the cheapest formats for errors of 1e-3, 1e-4 and 1e-6 of the scene's size.
std::string make_stream_trade_text(const StreamTrade& trade);
std::string make_stream_trade_csv(const StreamTrade& trade);
nlohmann::ordered_json make_stream_trade_json(const StreamTrade& trade);

}  // namespace flexcast
