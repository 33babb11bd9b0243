#include "core/lab/trade/trade_linear_modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/forces/system.h"
#include "core/lab/trade/trade_refusals.h"

namespace flexcast {
namespace {

constexpr Eigen::Index most_dofs = 1500;  // of a dense eigenvalue problem that takes seconds

double calc_sinc(double x) {
  return std::abs(x) < 1e-4 ? 1.0 - x * x / 6.0 : std::sin(x) / x;
}

// M^-1/2 K M^-1/2, dense, over the numbered degrees of freedom.
Eigen::MatrixXd make_scaled_stiffness(const System& system, const VecX& x, const std::vector<Eigen::Index>& free) {
  BlockMatrix K = system.make_matrix();
  K.set_zero();
  system.add_stiffness(x, 1.0, Tangent::exact, K);
  std::vector<Eigen::Index> number(static_cast<std::size_t>(x.size()), -1);
  for (std::size_t i = 0; i < free.size(); ++i)
    number[static_cast<std::size_t>(free[i])] = static_cast<Eigen::Index>(i);
  const VecX roots = system.inverse_masses().cwiseSqrt();
  const auto count = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(count, count);
  for (std::int32_t row = 0; row < K.rows(); ++row) {
    for (std::size_t k = 0; k < K.columns(row).size(); ++k) {
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
          const Eigen::Index i = 3 * row + a, j = 3 * K.columns(row)[k] + b;
          const Eigen::Index to = number[static_cast<std::size_t>(i)], from = number[static_cast<std::size_t>(j)];
          if (to >= 0 && from >= 0) A(to, from) += roots[i] * K.blocks(row)[k](a, b) * roots[j];
        }
      }
    }
  }
  return A;
}

// With u = x - x0: M u'' + K u = f(x0). In a mode q'' + omega^2 q = g, q(0) = 0, q'(0) = v:
//   q = g t^2/2 sinc^2(omega t / 2) + v t sinc(omega t),
// which holds for omega = 0 too.
class LinearModes : public ExactSolution {
 public:
  LinearModes(const Simulation& simulation, std::vector<Eigen::Index> free)
      : start_(simulation.state().positions), free_(std::move(free)) {
    const System system(simulation.model());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(make_scaled_stiffness(system, start_, free_));
    const VecX roots = system.inverse_masses().cwiseSqrt();
    VecX forces(start_.size());
    system.calc_conservative(start_, forces);
    omegas_ = modes.eigenvalues().cwiseMax(0.0).cwiseSqrt();
    scale_ = roots(free_);
    shapes_ = modes.eigenvectors();
    pushes_ = shapes_.transpose() * forces(free_).cwiseProduct(scale_);
    velocities_ = shapes_.transpose() * simulation.state().velocities(free_).cwiseQuotient(scale_);
  }

  VecX calc_positions(double time) const override {
    VecX q(omegas_.size());
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      const double half = calc_sinc(0.5 * omegas_[i] * time);
      q[i] = 0.5 * time * time * half * half * pushes_[i] + time * calc_sinc(omegas_[i] * time) * velocities_[i];
    }
    VecX x = start_;
    x(free_) += (shapes_ * q).cwiseProduct(scale_);
    return x;
  }

 private:
  VecX start_;
  std::vector<Eigen::Index> free_;
  VecX omegas_, scale_, pushes_, velocities_;  // 1/s, 1/sqrt(kg), and of the modes
  Eigen::MatrixXd shapes_;
};

std::vector<Eigen::Index> list_free(const Model& model) {
  std::vector<Eigen::Index> free;
  for (std::size_t i = 0; i < model.fixed.size(); ++i) {
    if (!model.fixed[i]) free.push_back(static_cast<Eigen::Index>(i));
  }
  return free;
}

std::string find_refusal(const Model& model, std::size_t free) {
  for (const Body& body : model.bodies) {
    if (!body.law || body.law->name != "linear") return "body \"" + body.name + "\" does not have the law linear";
  }
  if (const std::string damping = find_damping(model); !damping.empty()) return damping;
  if (const std::string guidance = find_guidance(model); !guidance.empty()) return guidance;
  if (free == 0) return "nothing is free to move";
  if (static_cast<Eigen::Index>(free) > most_dofs) return std::to_string(free) + " degrees of freedom are too many";
  return "";
}

Result<std::unique_ptr<ExactSolution>> make_linear_modes(const Simulation& simulation) {
  std::vector<Eigen::Index> free = list_free(simulation.model());
  const std::string refusal = find_refusal(simulation.model(), free.size());
  if (!refusal.empty())
    return Error{"exact = \"linear_modes\" does not hold: " + refusal +
                 " (allowed: bodies of the law linear, at most 1500 degrees of freedom, no damping, drag, contacts or "
                 "handles)"};
  return std::unique_ptr<ExactSolution>(std::make_unique<LinearModes>(simulation, std::move(free)));
}

}  // namespace

constinit const ExactRow linear_modes_row = {
    "linear_modes", "the sum of the modes of the linear stiffness and the masses", make_linear_modes};

}  // namespace flexcast
