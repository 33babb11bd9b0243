#include "core/forces/gravity.h"

#include "core/base/parallel.h"

namespace flexcast {
namespace {

class Gravity final : public Force {
 public:
  explicit Gravity(const Model& model) : model_(model) {}

  bool is_active() const override { return model_.gravity != Vec3::Zero(); }
  EnergyKind energy_kind() const override { return EnergyKind::gravity; }
  bool is_constant() const override { return true; }

  void add_conservative(const VecX&, VecX& f) const override {
    const Vec3 g = model_.gravity;
    for (std::int64_t i = 0; i < model_.masses.size(); ++i) block3(f, i) += model_.masses[i] * g;
  }

  double calc_energy(const VecX& x) const override {
    const Vec3 g = model_.gravity;
    return parallel_sum(model_.masses.size(), 1024, partial_, [&](std::int64_t first, std::int64_t end) {
      double energy = 0.0;
      for (std::int64_t i = first; i < end; ++i) energy -= model_.masses[i] * g.dot(block3(x, i));
      return energy;
    });
  }

 private:
  const Model& model_;
  mutable std::vector<double> partial_;  // J, of blocks
};

}  // namespace

void make_gravity(const Model& model, std::vector<std::unique_ptr<Force>>& forces) {
  forces.push_back(std::make_unique<Gravity>(model));
}

}  // namespace flexcast
