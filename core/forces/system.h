// System: everything an integrator needs to know of a scene: inertia, what is held or moved, and the forces acting now.
// A force that the parameters make idle is not called.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/forces/force.h"
#include "core/forces/handle.h"
#include "core/state/step_statistics.h"

namespace flexcast {

class System {
 public:
  // Keeps a reference to the model.
  explicit System(const Model& model);

  // To be called after any change of the model: masses and the list of active forces follow.
  void refresh();

  std::int64_t dofs() const { return inverse_masses_.size(); }
  const VecX& rest_positions() const { return model_.rest_positions; }  // m, 3 n
  const VecX& masses() const { return dof_masses_; }                    // kg, 3 n
  const VecX& inverse_masses() const { return inverse_masses_; }        // 1/kg, 3 n, 0 where held
  const VecX& free() const { return free_; }  // 3 n: 1 where free, 0 where held or moved by a handle
  bool has_damping() const { return has_damping_; }
  bool has_handles() const { return !model_.handles.empty(); }
  bool has_friction() const { return has_friction_; }
  double size() const { return size_; }  // m, diagonal of the box around all rest positions

  // f = ..., at every particle, held or not; f is not x or v. What damps returns the power it takes, W.
  double calc_force(const VecX& x, const VecX& v, VecX& f) const;
  void calc_conservative(const VecX& x, VecX& f) const;
  double calc_damping(const VecX& x, const VecX& v, VecX& f) const;
  // The conservative force in two parts: what depends on positions, and what does not.
  void calc_position_dependent(const VecX& x, VecX& f) const;
  void calc_constant(VecX& f) const { f = constant_; }
  const VecX& constant_force() const { return constant_; }

  double calc_energy(EnergyKind kind, const VecX& x) const;  // J
  double calc_potential(const VecX& x) const;                // J, of every kind
  double calc_kinetic(const VecX& v) const;                  // J
  // J, of the position-dependent forces.
  double calc_position_dependent_energy(const VecX& x) const;

  // The pattern of all couplings, zero values. All matrices of a system share the pattern.
  BlockMatrix make_matrix() const;
  void add_stiffness(const VecX& x, double scale, Tangent kind, BlockMatrix& A) const;
  void add_damping_matrix(const VecX& x, double scale, BlockMatrix& A) const;
  // Every pair of particles that feel each other, as often as they do.
  std::vector<std::pair<std::int32_t, std::int32_t>> make_couplings() const;

  // Puts the handles' particles where they are at `time`, with their velocities. Nothing in a scene without handles.
  void prescribe(double time, VecX& x, VecX& v) const;
  // One per handle.
  const std::vector<Handle>& handles() const { return model_.handles; }
  HandleMotion calc_motion(const Handle& handle, double time) const {
    return calc_handle_motion(handle, time, model_.jump_time);
  }

  // What explicit schemes do about friction once they have changed the velocities by h F / m and booked that change:
  // sliding is slowed by at most the limit times h, and stops rather than turns. Exact for what rests: it sticks.
  void apply_friction(double h, std::span<const FrictionPoint> points, const VecX& F, VecX& v,
                      StepStatistics& statistics) const;
  // Replaces `points`; those of a particle are neighbours.
  void find_friction_points(const VecX& x, std::vector<FrictionPoint>& points) const;

  // Bodies that nothing holds or can hold: no fixed, moved or grabbed particle, no obstacle in the scene.
  void find_free_bodies(std::vector<const Body*>& bodies) const;

  // For position-based schemes: the active forces themselves.
  const std::vector<const Force*>& active_forces() const { return active_; }

  // One per body.
  std::vector<ModeBound> calc_mode_bounds() const;
  // N/m, norm over all degrees of freedom of mass times the largest omega^2: forces that move everything by a length.
  double stiffness_norm() const;

 private:
  void refresh_inertia();
  void refresh_forces();
  double calc_stiffness_norm() const;

  const Model& model_;
  mutable std::shared_ptr<const BlockPattern> pattern_;  // made when first asked for
  std::vector<std::unique_ptr<Force>> forces_;
  std::vector<const Force*> active_, varying_;  // varying: those of the active ones that depend on the state
  VecX dof_masses_, inverse_masses_, free_;
  VecX constant_;  // N, of the active forces that do not
  bool has_damping_ = false, has_friction_ = false;
  double size_ = 0.0;
  mutable std::optional<double> stiffness_norm_;  // made when first asked for
};

}  // namespace flexcast
