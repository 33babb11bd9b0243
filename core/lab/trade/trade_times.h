// The times at which runs are compared: some of the scene's frames, the same for every setting.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/result.h"

namespace flexcast {

struct TradeTimes {
  double frame = 0.0;                  // s, time.step of the scene
  std::vector<std::int64_t> compared;  // numbers of frames, rising; the last is the end

  std::int64_t frames() const { return compared.back(); }
  double duration() const { return static_cast<double>(frames()) * frame; }  // s
};

// Up to `most` evenly spaced frames and the last, until `until` (s), every one a multiple of `common`: the number of
// frames that the steps of all settings have in common. Errors: no such frame before the end, more than 1e15 frames.
Result<TradeTimes> make_trade_times(double frame, double until, std::int64_t common, int most = 200);

}  // namespace flexcast
