#include "core/lab/trade/trade_progress.h"

#include <algorithm>
#include <cstdio>
#include <ostream>

namespace flexcast {

TradeProgress::~TradeProgress() {
  if (shown_) log_ << "\r\x1b[K" << std::flush;
}

void TradeProgress::show(const std::string& doing) {
  if (!active_) return;
  shown_ = true;
  char line[200];
  std::snprintf(line, sizeof line, "\rat most %.0f s remaining: %.120s\x1b[K", std::max(budget_.left(), 0.0),
                doing.c_str());
  log_ << line << std::flush;
}

}  // namespace flexcast
