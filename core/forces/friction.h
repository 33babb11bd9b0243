// Coulomb friction at a point: at most `limit` newtons against sliding.
#pragma once

#include <algorithm>

#include "core/forces/force.h"

namespace flexcast {

inline Vec3 calc_tangential(const FrictionPoint& point, const Vec3& v) {
  return v - point.normal.dot(v) * point.normal;
}

// For implicit schemes, as a potential of the displacement u of a step. Sliding less than `slip` (m) meets a force that
// rises smoothly from 0: limit f(|t| / slip), t the tangential part of u, f(y) = 2 y - y^2 below 1 and 1 from there on.
// Source: M. Li et al., Incremental Potential Contact, ACM TOG 39(4), 2020, section 4.3.
struct FrictionPotential {
  double value = 0.0;            // J
  Vec3 gradient = Vec3::Zero();  // N
};

inline FrictionPotential calc_friction_potential(const FrictionPoint& point, double slip, const Vec3& u) {
  const Vec3 t = calc_tangential(point, u);
  const double length = t.norm();
  const double y = length / slip;
  if (y >= 1.0) return {point.limit * (length - slip / 3.0), point.limit / length * t};
  return {point.limit * slip * y * y * (1.0 - y / 3.0), point.limit * (2.0 - y) / slip * t};
}

// N/m, positive semidefinite.
inline Mat3 calc_friction_tangent(const FrictionPoint& point, double slip, const Vec3& u) {
  const Mat3 T = Mat3::Identity() - point.normal * point.normal.transpose();
  const Vec3 t = calc_tangential(point, u);
  const double length = t.norm();
  const double y = length / slip;
  const double across = y >= 1.0 ? point.limit / length : point.limit * (2.0 - y) / slip;  // force over |t|
  const double along = y >= 1.0 ? 0.0 : point.limit * 2.0 * (1.0 - y) / slip;              // slope of the force
  if (length == 0.0) return across * T;
  const Vec3 n = t / length;
  return across * (T - n * n.transpose()) + along * n * n.transpose();
}

}  // namespace flexcast
