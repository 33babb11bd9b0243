// System: everything an integrator needs to know of a scene: inertia, what is held, and the forces acting now. A force
// that the parameters make idle is not called.
#pragma once

#include <memory>
#include <vector>

#include "core/forces/force.h"

namespace flexcast {

class System {
 public:
  // Keeps a reference to the model.
  explicit System(const Model& model);

  // To be called after any change of the model: masses and the list of active forces follow.
  void refresh();

  std::int64_t dofs() const { return inverse_masses_.size(); }
  const VecX& masses() const { return dof_masses_; }              // kg, 3 n
  const VecX& inverse_masses() const { return inverse_masses_; }  // 1/kg, 3 n, 0 where held
  const VecX& free() const { return free_; }                      // 3 n: 1 where free, 0 where held
  bool has_damping() const { return has_damping_; }

  // f = ..., at every particle, held or not.
  void calc_force(const VecX& x, const VecX& v, VecX& f) const;
  void calc_conservative(const VecX& x, VecX& f) const;
  void calc_damping(const VecX& x, const VecX& v, VecX& f) const;
  // The conservative force in two parts: what depends on positions, and what does not.
  void calc_position_dependent(const VecX& x, VecX& f) const;
  void calc_constant(VecX& f) const;

  double calc_energy(EnergyKind kind, const VecX& x) const;  // J
  double calc_kinetic(const VecX& v) const;                  // J
  // J, of the position-dependent forces.
  double calc_position_dependent_energy(const VecX& x) const;

  // The pattern of all couplings, zero values.
  BlockMatrix make_matrix() const;
  void add_stiffness(const VecX& x, double scale, Tangent kind, BlockMatrix& A) const;
  void add_damping_matrix(const VecX& x, double scale, BlockMatrix& A) const;

  // One per body.
  std::vector<ModeBound> calc_mode_bounds() const;

 private:
  const Model& model_;
  std::vector<std::unique_ptr<Force>> forces_;
  std::vector<const Force*> active_;
  VecX dof_masses_, inverse_masses_, free_;
  bool has_damping_ = false;
};

}  // namespace flexcast
