// The books of a change of the velocities by an impulse h F: what it adds to the kinetic energy, (v0 + v1)/2 . h F, and
// what handles had to put in to move as prescribed, (v0 + v1)/2 . (m (v1 - v0) - h F) over their particles.
#pragma once

#include "core/forces/system.h"

namespace flexcast {

class VelocityChange {
 public:
  // Before the change; keeps references. F at every particle, held or not.
  VelocityChange(const System& system, double h, const VecX& F, const VecX& v, StepStatistics& statistics)
      : system_(system), h_(h), F_(F), statistics_(statistics) {
    statistics_.force_work += 0.5 * h_ * F_.dot(v);
    for (const Handle& handle : system_.handles()) {
      for (const std::int32_t particle : handle.particles) before_.push_back(block3(v, particle));
    }
  }

  // After it, with the velocities as they are now.
  void close(const VecX& v) {
    statistics_.force_work += 0.5 * h_ * F_.dot(v);
    std::size_t i = 0;
    for (const Handle& handle : system_.handles()) {
      for (const std::int32_t particle : handle.particles) {
        const Vec3 v0 = before_[i++], v1 = block3(v, particle);
        const Vec3 impulse = block3(system_.masses(), particle).cwiseProduct(v1 - v0) - h_ * block3(F_, particle);
        statistics_.handle_work += 0.5 * impulse.dot(v0 + v1);
      }
    }
  }

 private:
  const System& system_;
  double h_;
  const VecX& F_;
  StepStatistics& statistics_;
  std::vector<Vec3> before_;  // m/s, of the handles' particles
};

}  // namespace flexcast
