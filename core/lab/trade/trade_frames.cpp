#include "core/lab/trade/trade_frames.h"

#include <algorithm>
#include <cmath>

#include "core/base/checks.h"

namespace flexcast {

double calc_rms(const VecX& difference) {
  const auto count = static_cast<double>(difference.size() / 3);
  return count > 0.0 ? difference.stableNorm() / std::sqrt(count) : 0.0;
}

double calc_largest(const VecX& difference) {
  double largest = 0.0;
  for (std::int64_t i = 0; i < difference.size() / 3; ++i)
    largest = std::max(largest, block3(difference, i).stableNorm());
  return largest;
}

double calc_motion(const TradeFrames& frames) {
  double motion = 0.0;
  for (const TradeFrame& frame : frames.at)
    motion = std::max(motion, calc_rms(frame.positions - frames.start.positions));
  return motion;
}

void add_frame(const TradeFrame& frame, const TradeFrame& reference, const std::vector<std::int64_t>& probes,
               TradeErrors& errors) {
  FLEXCAST_CHECK(frame.positions.size() == reference.positions.size());
  const VecX difference = frame.positions - reference.positions;
  errors.rms_end = calc_rms(difference);
  errors.rms = std::max(errors.rms, errors.rms_end);
  errors.largest_end = calc_largest(difference);
  errors.largest = std::max(errors.largest, errors.largest_end);
  errors.probes.resize(probes.size(), 0.0);
  errors.probes_end.resize(probes.size(), 0.0);
  for (std::size_t i = 0; i < probes.size(); ++i) {
    errors.probes_end[i] = block3(difference, probes[i]).stableNorm();
    errors.probes[i] = std::max(errors.probes[i], errors.probes_end[i]);
  }
  for (Eigen::Index i = 0; i < reference.volumes.size(); ++i) {
    const double volume = reference.volumes[i];
    if (volume != 0.0) errors.volume = std::max(errors.volume, std::abs((frame.volumes[i] - volume) / volume));
  }
}

double calc_distance(const TradeFrames& a, const TradeFrames& b) {
  FLEXCAST_CHECK(a.at.size() == b.at.size());
  double distance = 0.0;
  for (std::size_t i = 0; i < a.at.size(); ++i)
    distance = std::max(distance, calc_rms(a.at[i].positions - b.at[i].positions));
  return distance;
}

}  // namespace flexcast
