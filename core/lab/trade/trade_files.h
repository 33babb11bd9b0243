// The files of a study of trades: trade.csv, trade.json, trade.svg, order.svg.
#pragma once

#include <filesystem>

#include "core/lab/trade/trade.h"

namespace flexcast {

// Errors: a folder that cannot be made, a file that cannot be written.
Result<void> make_folder(const std::filesystem::path& folder);
Result<void> write_trade_files(const Trade& trade, const std::filesystem::path& folder);

// A row a setting, numbers with all their digits; what was not measured is an empty field.
std::string make_trade_csv(const Trade& trade);

}  // namespace flexcast
