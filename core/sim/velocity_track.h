// The velocities at the ends of the last integrator steps, and how fast they change: what errors of steps are estimated
// from.
#pragma once

#include <array>
#include <vector>

#include "core/base/math.h"

namespace flexcast {

// RMS over the particles of the k-th time derivative of the velocities, m/s^(k+1), by divided differences at the last
// point; of the velocities themselves without their mean, so that a world that flies past as a whole is none the worse.
struct VelocityDerivatives {
  int known = 0;  // so many of them, from 0 up
  std::array<double, 4> rms = {};
};

class VelocityTrack {
 public:
  static constexpr int most = 4;  // points are kept

  // Anew, with one point; `time` in s.
  void begin(double time, const VecX& velocities);
  // The next point, later than the ones before; of the same size.
  void observe(double time, const VecX& velocities);
  VelocityDerivatives calc_derivatives() const;

  // What is kept, as numbers; and back. False: these are none.
  VecX save() const;
  bool restore(const VecX& saved, Eigen::Index dofs);

 private:
  static constexpr auto size = static_cast<std::size_t>(most);
  struct Point {
    double time = 0.0;
    VecX velocities;
  };
  const Point& point(std::size_t age) const { return points_[(newest_ + size - age) % size]; }

  std::array<Point, size> points_;
  std::size_t newest_ = 0, count_ = 0;
  mutable std::vector<std::array<double, size>> partial_;  // of blocks
};

}  // namespace flexcast
