#include "core/lab/stream/stream_errors.h"

#include <algorithm>
#include <cmath>

#include "core/base/checks.h"

namespace flexcast {
namespace {

// m^2, of the particle that is farthest from (1 - t) from + t to.
double calc_largest_squared(const VecX& positions, const VecX& from, const VecX& to, double t) {
  double largest = 0.0;
  for (std::int64_t i = 0; i < positions.size() / 3; ++i) {
    const Vec3 shown = block3(from, i) + t * (block3(to, i) - block3(from, i));
    largest = std::max(largest, (shown - block3(positions, i)).squaredNorm());
  }
  return largest;
}

}  // namespace

StreamErrors::StreamErrors(std::vector<int> everies) {
  FLEXCAST_CHECK(!everies.empty());
  for (const StreamPrecisionRow& row : stream_precisions) {
    for (const int every : everies) viewers_.push_back({row.precision, every, {}, 0.0});
  }
  past_.resize(static_cast<std::size_t>(*std::max_element(everies.begin(), everies.end())));
}

void StreamErrors::add(const VecX& positions) {
  ++step_;
  past_[static_cast<std::size_t>(step_) % past_.size()] = positions;
  for (const StreamPrecisionRow& row : stream_precisions) {
    fill_payload({positions, positions, positions, positions}, {.precision = row.precision}, payload_);
    const VecX decoded = decode_positions(payload_);
    for (Viewer& viewer : viewers_) {
      if (viewer.precision == row.precision && step_ % viewer.every == 0) follow(viewer, decoded);
    }
  }
}

// The published frame itself, and the steps since the one before it.
void StreamErrors::follow(Viewer& viewer, const VecX& decoded) {
  const int between = step_ == 0 ? 0 : viewer.every - 1;
  for (int i = 1; i <= between; ++i) {
    const double t = static_cast<double>(i) / viewer.every;
    const VecX& truth = find_past(step_ - viewer.every + i);
    viewer.squared = std::max(viewer.squared, calc_largest_squared(truth, viewer.shown, decoded, t));
  }
  viewer.squared = std::max(viewer.squared, calc_largest_squared(find_past(step_), decoded, decoded, 0.0));
  viewer.shown = decoded;
}

double StreamErrors::calc_largest(StreamPrecision precision, int every) const {
  const auto found = std::find_if(viewers_.begin(), viewers_.end(),
                                  [&](const Viewer& v) { return v.precision == precision && v.every == every; });
  FLEXCAST_CHECK(found != viewers_.end());
  return std::sqrt(found->squared);
}

}  // namespace flexcast
