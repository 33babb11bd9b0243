// Bodies of the linear law without damping: the motion is a sum of the modes of the stiffness, each of which is known.
#pragma once

#include "core/lab/trade/trade_exact.h"

namespace flexcast {
extern const ExactRow linear_modes_row;
}  // namespace flexcast
