#include "core/sim/mode_region.h"

#include <utility>

namespace flexcast {

ModeRegion::ModeRegion(double most_damping, double most_omega_squared)
    : corners_{{0.0, 0.0}, {most_damping, 0.0}, {most_damping, most_omega_squared}, {0.0, most_omega_squared}} {}

// Source: I. E. Sutherland, G. W. Hodgman, Reentrant polygon clipping, Commun. ACM 17 (1974) 32-42.
void ModeRegion::cut(const Eigen::Vector2d& normal, double offset) {
  std::vector<Eigen::Vector2d> kept;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Eigen::Vector2d &from = corners_[i], &to = corners_[(i + 1) % corners_.size()];
    const double before = normal.dot(from) - offset, after = normal.dot(to) - offset;
    if (before <= 0.0) kept.push_back(from);
    if ((before < 0.0 && after > 0.0) || (before > 0.0 && after < 0.0)) {
      kept.push_back(from + before / (before - after) * (to - from));
    }
  }
  if (!kept.empty()) corners_ = std::move(kept);
}

}  // namespace flexcast
