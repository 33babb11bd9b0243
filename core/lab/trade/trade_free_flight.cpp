#include "core/lab/trade/trade_free_flight.h"

#include <algorithm>

#include "core/lab/trade/trade_refusals.h"

namespace flexcast {
namespace {

class FreeFlight : public ExactSolution {
 public:
  explicit FreeFlight(const Simulation& simulation)
      : start_(simulation.state().positions),
        velocities_(simulation.state().velocities),
        gravity_(simulation.model().gravity.replicate(start_.size() / 3, 1)) {}

  VecX calc_positions(double time) const override { return start_ + time * velocities_ + 0.5 * time * time * gravity_; }

 private:
  VecX start_, velocities_, gravity_;
};

// All particles of a body have the same of it, to rounding.
bool is_uniform(const VecX& values, const Body& body, double size) {
  const Vec3 first = block3(values, body.particles.first);
  for (std::int64_t i = body.particles.first; i < body.particles.end(); ++i) {
    if ((block3(values, i) - first).norm() > 1e-12 * size) return false;
  }
  return true;
}

std::string find_refusal(const Simulation& simulation) {
  const Model& model = simulation.model();
  if (std::ranges::find(model.fixed, 1) != model.fixed.end()) return "particles are pinned";
  if (const std::string damping = find_damping(model); !damping.empty()) return damping;
  if (const std::string guidance = find_guidance(model); !guidance.empty()) return guidance;
  if (model.external_forces.size() > 0 && !model.external_forces.isZero(0.0)) return "the scene has dead forces";
  const VecX displacement = simulation.state().positions - model.rest_positions;
  for (const Body& body : model.bodies) {
    const std::string of = "of body \"" + body.name + "\" differ from particle to particle";
    const double size = model.rest_positions.cwiseAbs().maxCoeff();
    if (!is_uniform(displacement, body, size)) return "the displacements " + of;
    const VecX& velocities = simulation.state().velocities;
    if (!is_uniform(velocities, body, velocities.cwiseAbs().maxCoeff())) return "the velocities " + of;
  }
  return "";
}

Result<std::unique_ptr<ExactSolution>> make_free_flight(const Simulation& simulation) {
  const std::string refusal = find_refusal(simulation);
  if (!refusal.empty())
    return Error{"exact = \"free_flight\" does not hold: " + refusal +
                 " (allowed: bodies that start undeformed at one velocity, with no force but gravity)"};
  return std::unique_ptr<ExactSolution>(std::make_unique<FreeFlight>(simulation));
}

}  // namespace

constinit const ExactRow free_flight_row = {"free_flight", "rigid translation under gravity: x0 + v0 t + g t^2 / 2",
                                            make_free_flight};

}  // namespace flexcast
