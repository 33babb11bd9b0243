#include "core/integrators/linear_motion.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <complex>

#include "core/integrators/lanczos.h"

namespace flexcast {

LinearMotion::LinearMotion(const System& system, const Model& model, const Body& body, const VecX& x) : x_(x) {
  const auto index = static_cast<std::int32_t>(&body - model.bodies.data());
  for (const Force* force : system.active_forces()) {
    if (force->body() == index) forces_.push_back(force);
  }
  const Eigen::Index first = 3 * Eigen::Index{body.particles.first}, count = 3 * Eigen::Index{body.particles.count};
  for (Eigen::Index i = first; i < first + count; ++i) {
    if (system.inverse_masses()[i] > 0.0) free_.push_back(i);
  }
  roots_ = system.inverse_masses()(free_).cwiseSqrt();
  length_ = std::max(system.size(), x.segment(first, count).cwiseAbs().maxCoeff() * 1e-3);
  moved_.setZero(x.size());
}

void LinearMotion::move(const VecX& q) {
  moved_(free_) = roots_.cwiseProduct(q);
}

void LinearMotion::add_damping(double scale, const VecX& q, VecX& y) {
  move(q);
  forward_.setZero(x_.size());
  for (const Force* force : forces_) {
    if (force->has_damping()) force->add_damping(x_, moved_, forward_);
  }
  y -= scale * roots_.cwiseProduct(forward_(free_));
}

// A difference small against the body and large against rounding.
void LinearMotion::add_stiffness(double scale, const VecX& q, VecX& y) {
  move(q);
  const double largest = moved_.cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) return;
  const double step = 1e-6 * length_ / largest;
  calc_force(step, forward_);
  calc_force(-step, backward_);
  backward_ -= forward_;
  y += scale / (2.0 * step) * roots_.cwiseProduct(backward_(free_));
}

void LinearMotion::calc_force(double step, VecX& f) {
  at_ = x_ + step * moved_;
  f.setZero(x_.size());
  for (const Force* force : forces_) force->add_conservative(at_, f);
}

double calc_farthest_mode(LinearMotion& motion, double of_damping, double of_stiffness) {
  return calc_largest_eigenvalue({motion.size(), {}, [&](const VecX& q, VecX& y) {
                                    y.setZero(q.size());
                                    if (of_damping != 0.0) motion.add_damping(of_damping, q, y);
                                    if (of_stiffness != 0.0) motion.add_stiffness(of_stiffness, q, y);
                                  }});
}

VecXc calc_eigenvalues(LinearMotion& motion) {
  constexpr Eigen::Index most = 120;
  const Eigen::Index n = motion.size();
  if (n > most) return {};
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  system.topRightCorner(n, n).setIdentity();
  VecX column(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    column.setZero();
    motion.add_stiffness(-1.0, VecX::Unit(n, i), column);
    system.col(i).tail(n) = column;
    column.setZero();
    motion.add_damping(-1.0, VecX::Unit(n, i), column);
    system.col(n + i).tail(n) = column;
  }
  VecXc lambdas = system.eigenvalues();
  // Differences leave the rigid ones a little beside 0.
  const double fastest = lambdas.cwiseAbs().maxCoeff();
  const auto end = std::remove_if(lambdas.begin(), lambdas.end(),
                                  [=](const std::complex<double>& z) { return std::abs(z) <= 1e-6 * fastest; });
  lambdas.conservativeResize(end - lambdas.begin());
  return lambdas;
}

}  // namespace flexcast
