// The amplification matrix of explicit schemes for a whole scene, linearised at rest, as dense matrices.
#pragma once

#include <Eigen/Eigenvalues>
#include <string_view>
#include <vector>

#include "tests/support/dense.h"

namespace flexcast::test {

// x' and v' after one step of x'' = -K x - D v (per unit mass, free degrees of freedom only).
inline Eigen::MatrixXd calc_amplification(std::string_view integrator, const Eigen::MatrixXd& K,
                                          const Eigen::MatrixXd& D, double h) {
  const Eigen::Index n = K.rows();
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd A(2 * n, 2 * n), drift = Eigen::MatrixXd::Identity(2 * n, 2 * n);
  A << Eigen::MatrixXd::Zero(n, n), I, -K, -D;
  drift.topRightCorner(n, n) = h * I;
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(2 * n, 2 * n);
  if (integrator == "forward_euler") return one + h * A;
  if (integrator == "rk4") return one + h * A * (one + h / 2 * A * (one + h / 3 * A * (one + h / 4 * A)));
  if (integrator == "symplectic_euler") {
    Eigen::MatrixXd kick = one;
    kick.bottomRows(n) += h * A.bottomRows(n);
    return drift * kick;
  }
  // velocity_verlet: w = v + h/2 a(x, v + h/2 a(x, v)), x' = x + h w, v' = w + h/2 a(x', w).
  Eigen::MatrixXd w(n, 2 * n), x(n, 2 * n), old_x(n, 2 * n), old_v(n, 2 * n);
  old_x << I, Eigen::MatrixXd::Zero(n, n);
  old_v << Eigen::MatrixXd::Zero(n, n), I;
  w = old_v + h / 2 * A.bottomRows(n);
  w = (old_v - h / 2 * (K * old_x + D * w)).eval();
  x = old_x + h * w;
  Eigen::MatrixXd step(2 * n, 2 * n);
  step << x, w - h / 2 * (K * x + D * w);
  return step;
}

// Stiffness and damping at rest, per unit mass.
struct Linearised {
  Eigen::MatrixXd K, D;
};

inline Linearised linearise(const Model& model) {
  const System system(model);
  BlockMatrix stiffness = system.make_matrix(), damping = system.make_matrix();
  stiffness.set_zero();
  damping.set_zero();
  system.add_stiffness(model.rest_positions, 1.0, Tangent::exact, stiffness);
  system.add_damping_matrix(model.rest_positions, 1.0, damping);
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < system.dofs(); ++i) {
    if (system.free()[i] != 0.0) free.push_back(i);
  }
  const Eigen::VectorXd roots = system.inverse_masses()(free).cwiseSqrt();
  const auto scale = [&](const BlockMatrix& matrix) {
    return Eigen::MatrixXd(roots.asDiagonal() * to_dense(matrix)(free, free) * roots.asDiagonal());
  };
  return {scale(stiffness), scale(damping)};
}

inline bool is_stable(std::string_view integrator, const Linearised& scene, double h) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(calc_amplification(integrator, scene.K, scene.D, h), false);
  return solver.eigenvalues().cwiseAbs().maxCoeff() <= 1.0 + 1e-7;  // rigid modes: double eigenvalues 1
}

}  // namespace flexcast::test
