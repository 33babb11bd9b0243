#include "core/lab/trade/trade_exact.h"

#include <array>

#include "core/lab/trade/trade_free_flight.h"
#include "core/lab/trade/trade_linear_modes.h"

namespace flexcast {

std::span<const ExactRow> exact_solutions() {
  static const std::array table{free_flight_row, linear_modes_row};
  return table;
}

const ExactRow* find_exact(std::string_view name) {
  for (const ExactRow& row : exact_solutions()) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

}  // namespace flexcast
