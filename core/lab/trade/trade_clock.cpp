#include "core/lab/trade/trade_clock.h"

#include <chrono>
#include <ctime>

namespace flexcast {
namespace {

class WallClock : public TradeClock {
 public:
  double now() const override {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
  double processor() const override { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
};

}  // namespace

std::unique_ptr<TradeClock> make_wall_clock() {
  return std::make_unique<WallClock>();
}

}  // namespace flexcast
