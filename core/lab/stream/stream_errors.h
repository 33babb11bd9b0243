// How far what a viewer shows is from the simulation: for every precision of the stream, and for streams of every n-th
// step, whose viewer moves particles in straight lines from one published frame to the next.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "core/sim/frame_payload.h"

namespace flexcast {

struct StreamPrecisionRow {
  StreamPrecision precision;
  std::string_view name;  // as in scene files
};
inline constexpr std::array stream_precisions{StreamPrecisionRow{StreamPrecision::float32, "float32"},
                                              StreamPrecisionRow{StreamPrecision::float64, "float64"},
                                              StreamPrecisionRow{StreamPrecision::quantized16, "quantized16"}};

class StreamErrors {
 public:
  // `everies`: the n of every n-th step, each >= 1.
  explicit StreamErrors(std::vector<int> everies);

  // The positions of the run's steps one after the other, those of step 0 first.
  void add(const VecX& positions);

  // m, the longest way between a particle and where it is shown, over all steps up to the last published one.
  double calc_largest(StreamPrecision precision, int every) const;

 private:
  struct Viewer {
    StreamPrecision precision;
    int every = 1;
    VecX shown;            // the last published frame
    double squared = 0.0;  // m^2, of the largest error
  };
  void follow(Viewer& viewer, const VecX& decoded);
  const VecX& find_past(std::int64_t step) const { return past_[static_cast<std::size_t>(step) % past_.size()]; }

  std::vector<Viewer> viewers_;
  std::vector<VecX> past_;  // the last steps, by their number modulo the largest n
  std::int64_t step_ = -1;
  FramePayload payload_;
};

}  // namespace flexcast
