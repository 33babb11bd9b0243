// One damped spring between p and q with rest length r: energy, force and tangent. d = x_q - x_p, l = |d|, n = d / l:
//   f_p = [ k_s (l/r - 1) + k_d ((v_q - v_p) . n) / r ] n,   f_q = -f_p.
// k_s in N, k_d in N.s: the stiffness is k_s / r, the damping coefficient k_d / r. Coincident ends have no direction
// and feel no force.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/materials/law.h"

namespace flexcast {

struct SpringDirection {
  Vec3 n = Vec3::Zero();  // zero where l = 0
  double l = 0.0;         // m
};

// The square of a length below 1e-140 or above 1e140 m leaves the range of a double: those take the careful way.
inline SpringDirection calc_spring_direction(const Vec3& d) {
  const double squared = d.squaredNorm();
  const double l = squared > 1e-280 && squared < 1e280 ? std::sqrt(squared) : d.stableNorm();
  if (l == 0.0) return {};
  return {d / l, l};
}

// J.
inline double calc_spring_energy(const Vec3& d, double r, double k_s) {
  const double extension = calc_spring_direction(d).l - r;
  return 0.5 * k_s / r * extension * extension;
}

// N, on p; v = v_q - v_p.
inline Vec3 calc_spring_force(const Vec3& d, const Vec3& v, double r, double k_s, double k_d) {
  const SpringDirection direction = calc_spring_direction(d);
  return (k_s * (direction.l / r - 1.0) + k_d * v.dot(direction.n) / r) * direction.n;
}

// The damping part alone.
inline Vec3 calc_spring_damping_force(const Vec3& d, const Vec3& v, double r, double k_d) {
  const Vec3 n = calc_spring_direction(d).n;
  return k_d * v.dot(n) / r * n;
}

// N/m, -df_p/dx_p: axial k_s/r, transverse k_s (1/r - 1/l), which is negative in compressed springs and cut at zero
// when a positive semidefinite tangent is asked for.
inline Mat3 calc_spring_tangent(const Vec3& d, double r, double k_s, Tangent kind) {
  const SpringDirection direction = calc_spring_direction(d);
  const double axial = k_s / r;
  if (direction.l == 0.0) return kind == Tangent::exact ? Mat3::Zero() : Mat3(axial * Mat3::Identity());
  double transverse = axial - k_s / direction.l;
  if (kind == Tangent::positive_semidefinite) transverse = std::max(transverse, 0.0);
  return transverse * Mat3::Identity() + (axial - transverse) * direction.n * direction.n.transpose();
}

}  // namespace flexcast
