#include "core/integrators/handle_work.h"

#include <limits>

#include "core/state/state.h"

namespace flexcast {

double calc_handle_power(const System& system, const VecX& F, const VecX& v) {
  double power = 0.0;
  for (const Handle& handle : system.handles()) {
    for (const std::int32_t particle : handle.particles) power += block3(F, particle).dot(block3(v, particle));
  }
  return power;
}

void move_handles(const System& system, double time, double h, const VecX& F, VecX& x, VecX& v,
                  StepStatistics& statistics) {
  for (const Handle& handle : system.handles()) {
    const HandleMotion motion = system.calc_motion(handle, time);
    for (std::size_t i = 0; i < handle.particles.size(); ++i) {
      const std::int32_t particle = handle.particles[i];
      const Vec3 v0 = block3(v, particle), v1 = motion.calc_velocity(handle.base[i]);
      const Vec3 place = motion.calc_position(handle.base[i]);
      const Vec3 impulse = h * block3(F, particle);
      const Vec3 added = block3(system.masses(), particle).cwiseProduct(v1 - v0) - impulse;
      statistics.handle_work += 0.5 * added.dot(v0 + v1);
      statistics.force_work += 0.5 * impulse.dot(v1 - v0);
      block3(x, particle) = place;
      block3(v, particle) = v1;
      const bool good =
          (place.array().abs() <= largest_magnitude).all() && (v1.array().abs() <= largest_magnitude).all();
      if (!good) statistics.handle_work = std::numeric_limits<double>::quiet_NaN();
    }
  }
}

}  // namespace flexcast
