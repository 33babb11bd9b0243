#include "core/sim/largest_mode.h"

#include <algorithm>

#include "core/integrators/linear_motion.h"

namespace flexcast {

std::vector<LargestMode> calc_largest_modes(const System& system, const Model& model, const VecX& x) {
  std::vector<LargestMode> modes(model.bodies.size());
  const bool at_rest = x == model.rest_positions;
  for (const Force* force : system.active_forces()) {
    const double of_elements = force->calc_mode_bound().omega_squared;
    for (std::size_t b = 0; b < modes.size(); ++b) {
      if (force->body() >= 0 && static_cast<std::size_t>(force->body()) != b) continue;
      double omega_squared = of_elements;
      if (force->energy_kind() == EnergyKind::elastic && of_elements != 0.0) {
        const Body& body = model.bodies[b];
        LinearMotion motion(system, model, body, x);
        const double found = std::max(0.0, calc_farthest_mode(motion, 0.0, 1.0));
        omega_squared = at_rest || !body.is_fem() ? std::min(found, of_elements) : found;
        modes[b].elastic = omega_squared;
      }
      modes[b].omega_squared += omega_squared;
    }
  }
  return modes;
}

}  // namespace flexcast
