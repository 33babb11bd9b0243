// Force: what acts on the particles. One object per kind of force and body; one virtual call per evaluation, plain
// loops inside. Conservative parts have an energy; damping parts are linear in the velocities, f = -D(x) v with D
// symmetric and positive semidefinite, so that implicit schemes can freeze D at the start of a step.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/base/block_matrix.h"
#include "core/forces/block_runs.h"
#include "core/forces/model.h"

namespace flexcast {

// Where a force's energy is booked.
enum class EnergyKind { none, elastic, gravity, contact, external };

// Bounds for the modes of a body, linearised: none is faster, and at that frequency the damping rate 2 zeta omega is
// between the two.
struct ModeBound {
  double omega_squared = 0.0;       // 1/s^2
  double damping_rate = 0.0;        // 1/s
  double least_damping_rate = 0.0;  // 1/s
};

// A particle that touches something rough: it resists sliding with at most `limit`.
struct FrictionPoint {
  std::int32_t particle = 0;
  Vec3 normal = Vec3::Zero();  // of unit length, out of the obstacle
  double limit = 0.0;          // N, friction coefficient times normal force
};

// One Gauss-Seidel sweep of position-based dynamics over a force's constraints; see xpbd.h.
struct ConstraintSweep {
  double h = 0.0;              // s
  const VecX& start;           // m, positions at the start of the step
  const VecX& inverse_masses;  // 1/kg, 3 n, 0 where held
};

class Force {
 public:
  virtual ~Force() = default;

  // Whether it does anything with the parameters now in force. Asked after every change of a parameter; a force that is
  // not active costs nothing.
  virtual bool is_active() const = 0;
  virtual bool has_damping() const { return false; }
  virtual EnergyKind energy_kind() const { return EnergyKind::none; }
  // True for forces that do not depend on the state: their energy is linear in the positions.
  virtual bool is_constant() const { return false; }
  // Called after every change of a parameter, before is_active, with the bounds of what is elastic in each body.
  virtual void follow_parameters(std::span<const ModeBound> /*elastic*/) {}

  // f += conservative force at x.
  virtual void add_conservative(const VecX& x, VecX& f) const = 0;
  // f += -D(x) v. Returns the power that it takes, v . D v, in W.
  virtual double add_damping(const VecX& /*x*/, const VecX& /*v*/, VecX& /*f*/) const { return 0.0; }
  // f += both.
  virtual double add_force(const VecX& x, const VecX& v, VecX& f) const {
    add_conservative(x, f);
    return has_damping() ? add_damping(x, v, f) : 0.0;
  }
  // J.
  virtual double calc_energy(const VecX& /*x*/) const { return 0.0; }

  // Pairs of particles that feel each other, for the pattern of the matrices.
  virtual void add_couplings(std::vector<std::pair<std::int32_t, std::int32_t>>& /*pairs*/) const {}
  // A += scale * K(x), K = -df/dx of the conservative part.
  virtual void add_stiffness(const VecX& /*x*/, double /*scale*/, Tangent /*kind*/, BlockMatrix& /*A*/) const {}
  // A += scale * D(x).
  virtual void add_damping_matrix(const VecX& /*x*/, double /*scale*/, BlockMatrix& /*A*/) const {}

  // For vertex block descent, at the particles of a list: f[i] += conservative force on particles[i], K[i] += the 3 x 3
  // diagonal block there of the positive semidefinite stiffness.
  virtual void add_blocks(const VecX& /*x*/, std::span<const std::int32_t> /*particles*/, std::span<Vec3> /*f*/,
                          std::span<Mat3> /*K*/) const {}
  // The same for damping: f[i] += (-D(x) v)_i, K[i] += scale D_ii.
  virtual void add_damping_blocks(const VecX& /*x*/, const VecX& /*v*/, double /*scale*/,
                                  std::span<const std::int32_t> /*particles*/, std::span<Vec3> /*f*/,
                                  std::span<Mat3> /*K*/) const {}
  // Both in lanes, for visits to be made many times. Null: the functions above will do.
  virtual std::unique_ptr<BlockRuns> make_block_runs(const Visits& /*visits*/) const { return nullptr; }

  // For position-based dynamics: how many multipliers of compliant constraints there are, and one sweep over these that
  // changes the displacements u from the start of the step and the multipliers.
  virtual std::int64_t constraint_count() const { return 0; }
  virtual void sweep_constraints(const ConstraintSweep& /*sweep*/, std::span<double> /*lambda*/, VecX& /*u*/) const {}

  // Where friction acts at x.
  virtual bool has_friction() const { return false; }
  virtual void add_friction_points(const VecX& /*x*/, std::vector<FrictionPoint>& /*points*/) const {}

  // The body it belongs to, -1: the whole scene. Forces say how fast and how damped modes can be.
  virtual std::int32_t body() const { return -1; }
  virtual ModeBound calc_mode_bound() const { return {}; }
};

}  // namespace flexcast
