// ModeRegion: where the modes of a body can be, in the plane of damping rate d (1/s) and omega^2 k (1/s^2).
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace flexcast {

// Every mode x'' = -k x - d x' of M x'' + D x' + K x = 0 has k = v.K v and d = v.D v, v its vector with v.M v = 1, and
// all such pairs lie in a convex set (Hausdorff 1919: the numerical range of D + i K). This is a polygon around that
// set.
class ModeRegion {
 public:
  // 0 <= d <= most_damping, 0 <= k <= most_omega_squared.
  ModeRegion(double most_damping, double most_omega_squared);

  // What lies between given corners, counterclockwise; two make a straight line.
  explicit ModeRegion(std::vector<Eigen::Vector2d> corners) : corners_(std::move(corners)) {}

  // Keeps what has normal.(d, k) <= offset. Where that would leave nothing, nothing is cut.
  void cut(const Eigen::Vector2d& normal, double offset);

  // Its corners, counterclockwise.
  const std::vector<Eigen::Vector2d>& corners() const { return corners_; }

 private:
  std::vector<Eigen::Vector2d> corners_;
};

}  // namespace flexcast
