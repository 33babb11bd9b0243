#include "core/forces/grabs.h"

#include <algorithm>

namespace flexcast {
namespace {

class Grabs final : public Force {
 public:
  explicit Grabs(const Model& model) : model_(model) {}

  bool is_active() const override { return !model_.grabs.empty(); }
  EnergyKind energy_kind() const override { return EnergyKind::external; }

  void add_conservative(const VecX& x, VecX& f) const override {
    for (const Grab& grab : model_.grabs) {
      block3(f, grab.particle) += grab.stiffness * (grab.target - block3(x, grab.particle));
    }
  }
  double calc_energy(const VecX& x) const override {
    double energy = 0.0;
    for (const Grab& grab : model_.grabs) {
      energy += 0.5 * grab.stiffness * (grab.target - block3(x, grab.particle)).squaredNorm();
    }
    return energy;
  }
  void add_stiffness(const VecX&, double scale, Tangent, BlockMatrix& A) const override {
    for (const Grab& grab : model_.grabs) {
      A.add(grab.particle, grab.particle, scale * grab.stiffness * Mat3::Identity());
    }
  }
  void add_blocks(const VecX& x, std::span<const std::int32_t> particles, std::span<Vec3> f,
                  std::span<Mat3> K) const override {
    for (const Grab& grab : model_.grabs) {
      const auto found = std::find(particles.begin(), particles.end(), grab.particle);
      if (found == particles.end()) continue;
      const auto i = static_cast<std::size_t>(found - particles.begin());
      f[i] += grab.stiffness * (grab.target - block3(x, grab.particle));
      K[i] += grab.stiffness * Mat3::Identity();
    }
  }

  // Each axis is a constraint of its own: C = x - target, stiffness k.
  std::int64_t constraint_count() const override { return 3 * static_cast<std::int64_t>(model_.grabs.size()); }
  void sweep_constraints(const ConstraintSweep& sweep, std::span<double> lambda, VecX& u) const override {
    for (std::size_t g = 0; g < model_.grabs.size(); ++g) {
      const Grab& grab = model_.grabs[g];
      const double s = sweep.h * sweep.h * grab.stiffness;
      for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t dof = 3 * static_cast<std::int64_t>(grab.particle) + axis;
        const double w = sweep.inverse_masses[dof];
        double& multiplier = lambda[3 * g + static_cast<std::size_t>(axis)];
        const double change = (s * (grab.target[axis] - sweep.start[dof] - u[dof]) - multiplier) / (s * w + 1.0);
        multiplier += change;
        u[dof] += w * change;
      }
    }
  }

  ModeBound calc_mode_bound() const override {
    ModeBound bound;
    for (const Grab& grab : model_.grabs) {
      bound.omega_squared = std::max(bound.omega_squared, grab.stiffness / model_.masses[grab.particle]);
    }
    return bound;
  }

 private:
  const Model& model_;
};

}  // namespace

void make_grabs(const Model& model, std::vector<std::unique_ptr<Force>>& forces) {
  forces.push_back(std::make_unique<Grabs>(model));
}

}  // namespace flexcast
