#include "core/sim/largest_mode.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

namespace flexcast {
namespace {

// The largest eigenvalue must have had the time to show before a residual says that it did.
constexpr int least_iterations = 20, most_iterations = 60;

// Entries in -1..1 that no symmetry of a mesh has (a golden ratio sequence).
VecX make_start(Eigen::Index size) {
  VecX start(size);
  double fraction = 0.5;
  for (double& entry : start) {
    fraction += 0.6180339887498949;
    fraction -= std::floor(fraction);
    entry = 2.0 * fraction - 1.0;
  }
  return start;
}

// y = K d or D d by the body's forces: K by a difference small against the body and large against rounding.
void multiply(const System& system, const Body& body, std::int32_t index, const VecX& x, bool damping, const VecX& d,
              VecX& y) {
  const auto own = [&](const Force& force) { return force.body() == index; };
  y.setZero(x.size());
  if (damping) {
    for (const Force* force : system.active_forces()) {
      if (own(*force) && force->has_damping()) force->add_damping(x, d, y);
    }
    y = -y;
    return;
  }
  const auto part = x.segment(3 * body.particles.first, 3 * body.particles.count);
  const double size = std::max(system.size(), part.cwiseAbs().maxCoeff() * 1e-3);
  const double largest = d.cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) return;
  const double step = 1e-6 * size / largest;
  VecX moved = x + step * d, backward = VecX::Zero(x.size());
  for (const Force* force : system.active_forces()) {
    if (own(*force)) force->add_conservative(moved, y);
  }
  moved = x - step * d;
  for (const Force* force : system.active_forces()) {
    if (own(*force)) force->add_conservative(moved, backward);
  }
  y = (backward - y) / (2.0 * step);
}

double calc_largest_eigenvalue(const System& system, const Model& model, const Body& body, const VecX& x,
                               bool damping) {
  const auto index = static_cast<std::int32_t>(&body - model.bodies.data());
  const VecX roots = system.inverse_masses().cwiseSqrt();
  const Eigen::Index first = 3 * body.particles.first, count = 3 * body.particles.count;
  VecX q = VecX::Zero(x.size()), last = q, y;
  q.segment(first, count) = make_start(count).cwiseProduct(roots.segment(first, count).cwiseSign());
  if (!(q.norm() > 0.0)) return 0.0;
  q /= q.norm();

  std::vector<double> diagonal, off_diagonal;
  for (int k = 0; k < most_iterations; ++k) {
    multiply(system, body, index, x, damping, roots.cwiseProduct(q), y);
    y = roots.cwiseProduct(y);
    diagonal.push_back(y.dot(q));
    y -= diagonal.back() * q;
    if (k > 0) y -= off_diagonal.back() * last;
    const double norm = y.norm();
    const auto n = static_cast<Eigen::Index>(diagonal.size());
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
    ritz.computeFromTridiagonal(Eigen::Map<const VecX>(diagonal.data(), n),
                                VecX(Eigen::Map<const VecX>(off_diagonal.data(), n - 1)));
    const double largest = ritz.eigenvalues()[n - 1];
    const double residual = norm * std::abs(ritz.eigenvectors()(n - 1, n - 1));
    const bool close = k + 1 >= least_iterations && residual <= 1e-3 * largest;
    if (close || k + 1 == most_iterations || !(norm > 1e-12 * std::abs(largest))) {
      return std::max(largest + residual, 0.0) * (1.0 + 1e-6);
    }
    off_diagonal.push_back(norm);
    last = q;
    q = y / norm;
  }
  return 0.0;
}

}  // namespace

std::vector<ModeBound> calc_largest_modes(const System& system, const Model& model, const VecX& x) {
  std::vector<ModeBound> modes(model.bodies.size());
  const bool at_rest = x == model.rest_positions;
  for (const Force* force : system.active_forces()) {
    const ModeBound bound = force->calc_mode_bound();
    for (std::size_t b = 0; b < modes.size(); ++b) {
      if (force->body() >= 0 && static_cast<std::size_t>(force->body()) != b) continue;
      const Body& body = model.bodies[b];
      const bool iterates = force->energy_kind() == EnergyKind::elastic;
      const bool holds = at_rest || !body.is_fem();
      const auto refine = [&](double of_elements, bool damping) {
        if (!iterates || of_elements == 0.0) return of_elements;
        const double found = calc_largest_eigenvalue(system, model, body, x, damping);
        return holds ? std::min(found, of_elements) : found;
      };
      const double omega_squared = refine(bound.omega_squared, false);
      modes[b].omega_squared += omega_squared;
      modes[b].damping_rate += refine(bound.damping_rate, true);
      // The damping inside a body goes with its stiffness: at least as much less as that is less than its bound.
      const bool shrinks = iterates && bound.omega_squared > 0.0;
      modes[b].least_damping_rate +=
          bound.least_damping_rate * (shrinks ? std::min(1.0, omega_squared / bound.omega_squared) : 1.0);
    }
  }
  return modes;
}

}  // namespace flexcast
