#include "core/forces/dead_load.h"

namespace flexcast {
namespace {

class DeadLoad final : public Force {
 public:
  explicit DeadLoad(const Model& model) : model_(model) {}

  bool is_active() const override { return true; }
  EnergyKind energy_kind() const override { return EnergyKind::external; }
  bool is_constant() const override { return true; }
  void add_conservative(const VecX&, VecX& f) const override { f += model_.external_forces; }
  double calc_energy(const VecX& x) const override { return -model_.external_forces.dot(x); }

 private:
  const Model& model_;
};

}  // namespace

void make_dead_load(const Model& model, std::vector<std::unique_ptr<Force>>& forces) {
  if (model.external_forces.size() > 0) forces.push_back(std::make_unique<DeadLoad>(model));
}

}  // namespace flexcast
