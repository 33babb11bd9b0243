// Bodies that fly without a force but gravity and without turning: x0 + v0 t + g t^2 / 2.
#pragma once

#include "core/lab/trade/trade_exact.h"

namespace flexcast {
extern const ExactRow free_flight_row;
}  // namespace flexcast
