#include "core/forces/system.h"

#include "core/forces/force_table.h"

namespace flexcast {

System::System(const Model& model) : model_(model) {
  for (const ForceRow& row : force_rows()) row.make(model, forces_);
  refresh();
}

void System::refresh() {
  active_.clear();
  has_damping_ = false;
  for (const auto& force : forces_) {
    if (!force->is_active()) continue;
    active_.push_back(force.get());
    has_damping_ = has_damping_ || force->has_damping();
  }
  const std::int64_t n = model_.particle_count();
  dof_masses_.resize(3 * n);
  inverse_masses_.resize(3 * n);
  free_.resize(3 * n);
  for (std::int64_t i = 0; i < 3 * n; ++i) {
    const bool fixed = model_.fixed[static_cast<std::size_t>(i)] != 0;
    dof_masses_[i] = model_.masses[i / 3];
    inverse_masses_[i] = fixed ? 0.0 : 1.0 / model_.masses[i / 3];
    free_[i] = fixed ? 0.0 : 1.0;
  }
}

void System::calc_force(const VecX& x, const VecX& v, VecX& f) const {
  f.setZero(dofs());
  for (const Force* force : active_) force->add_force(x, v, f);
}

void System::calc_conservative(const VecX& x, VecX& f) const {
  f.setZero(dofs());
  for (const Force* force : active_) force->add_conservative(x, f);
}

void System::calc_damping(const VecX& x, const VecX& v, VecX& f) const {
  f.setZero(dofs());
  for (const Force* force : active_) {
    if (force->has_damping()) force->add_damping(x, v, f);
  }
}

void System::calc_position_dependent(const VecX& x, VecX& f) const {
  f.setZero(dofs());
  for (const Force* force : active_) {
    if (!force->is_constant()) force->add_conservative(x, f);
  }
}

void System::calc_constant(VecX& f) const {
  f.setZero(dofs());
  for (const Force* force : active_) {
    if (force->is_constant()) force->add_conservative(dof_masses_, f);  // any positions will do
  }
}

double System::calc_energy(EnergyKind kind, const VecX& x) const {
  double energy = 0.0;
  for (const Force* force : active_) {
    if (force->energy_kind() == kind) energy += force->calc_energy(x);
  }
  return energy;
}

double System::calc_kinetic(const VecX& v) const {
  return 0.5 * v.dot(dof_masses_.cwiseProduct(v));
}

double System::calc_position_dependent_energy(const VecX& x) const {
  double energy = 0.0;
  for (const Force* force : active_) {
    if (!force->is_constant()) energy += force->calc_energy(x);
  }
  return energy;
}

BlockMatrix System::make_matrix() const {
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (const auto& force : forces_) force->add_couplings(pairs);
  return BlockMatrix(static_cast<std::int32_t>(model_.particle_count()), std::move(pairs));
}

void System::add_stiffness(const VecX& x, double scale, Tangent kind, BlockMatrix& A) const {
  for (const Force* force : active_) force->add_stiffness(x, scale, kind, A);
}

void System::add_damping_matrix(const VecX& x, double scale, BlockMatrix& A) const {
  for (const Force* force : active_) {
    if (force->has_damping()) force->add_damping_matrix(x, scale, A);
  }
}

std::vector<ModeBound> System::calc_mode_bounds() const {
  // A body has one elastic force; what damps acts on top of it.
  std::vector<ModeBound> bounds(model_.bodies.size());
  for (const Force* force : active_) {
    if (force->body() < 0) continue;
    ModeBound& bound = bounds[static_cast<std::size_t>(force->body())];
    const ModeBound one = force->calc_mode_bound();
    bound.omega_squared += one.omega_squared;
    bound.damping_rate += one.damping_rate;
    bound.least_damping_rate += one.least_damping_rate;
  }
  return bounds;
}

}  // namespace flexcast
