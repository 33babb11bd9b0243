// Force: what acts on the particles. One object per kind of force and body; one virtual call per evaluation, plain
// loops inside. Conservative parts have an energy; damping parts are linear in the velocities, f = -D(x) v with D
// symmetric and positive semidefinite, so that implicit schemes can freeze D at the start of a step.
#pragma once

#include <utility>
#include <vector>

#include "core/base/block_matrix.h"
#include "core/forces/model.h"

namespace flexcast {

// Where a force's energy is booked.
enum class EnergyKind { none, elastic, gravity, external };

// Bounds for the modes of a body, linearised: none is faster, and at that frequency the damping rate 2 zeta omega is
// between the two.
struct ModeBound {
  double omega_squared = 0.0;       // 1/s^2
  double damping_rate = 0.0;        // 1/s
  double least_damping_rate = 0.0;  // 1/s
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

  // f += conservative force at x.
  virtual void add_conservative(const VecX& x, VecX& f) const = 0;
  // f += -D(x) v.
  virtual void add_damping(const VecX& /*x*/, const VecX& /*v*/, VecX& /*f*/) const {}
  // f += both.
  virtual void add_force(const VecX& x, const VecX& v, VecX& f) const {
    add_conservative(x, f);
    if (has_damping()) add_damping(x, v, f);
  }
  // J.
  virtual double calc_energy(const VecX& /*x*/) const { return 0.0; }

  // Pairs of particles that feel each other, for the pattern of the matrices.
  virtual void add_couplings(std::vector<std::pair<std::int32_t, std::int32_t>>& /*pairs*/) const {}
  // A += scale * K(x), K = -df/dx of the conservative part.
  virtual void add_stiffness(const VecX& /*x*/, double /*scale*/, Tangent /*kind*/, BlockMatrix& /*A*/) const {}
  // A += scale * D(x).
  virtual void add_damping_matrix(const VecX& /*x*/, double /*scale*/, BlockMatrix& /*A*/) const {}

  // The body it belongs to, -1: the whole scene. Forces of bodies say how fast and how damped its modes can be.
  virtual std::int32_t body() const { return -1; }
  virtual ModeBound calc_mode_bound() const { return {}; }
};

}  // namespace flexcast
