// A study of trades as pictures.
#pragma once

#include "core/lab/plot/plot.h"
#include "core/lab/trade/trade.h"

namespace flexcast {

// Error over the motion's size against wall seconds per simulated second: a line a group, the front, the levels and the
// reference's own error.
Plot make_trade_plot(const Trade& trade);

// Error against the time step, with the slopes of the orders 1, 2 and 4.
Plot make_order_plot(const Trade& trade);

}  // namespace flexcast
