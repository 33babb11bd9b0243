#include "core/integrators/vbd.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

#include "core/forces/friction.h"
#include "core/integrators/coloring.h"
#include "core/integrators/incremental_potential.h"

namespace flexcast {
namespace {

class Vbd final : public Integrator {
 public:
  Vbd(const System& system, const SolverSettings& settings)
      : settings_(settings),
        colors_(make_colors(static_cast<std::int32_t>(system.dofs() / 3), system.make_couplings())) {}

  void step(const System& system, double h, State& state, StepStatistics& statistics) override {
    stage_.start(system, state, h, 0.0);
    potential_.begin(system, stage_, u_);
    potential_.calc_drift(drifted_);
    // Sweeps only descend, so the better of two starts bounds the energy at any step.
    drifted_ += u_ + h * h * system.inverse_masses().cwiseProduct(potential_.constant_force());
    if (potential_.calc_value(drifted_).value <= potential_.calc_value(u_).value) u_ = drifted_;
    for (int i = 0; i < settings_.iterations; ++i) {
      for (const auto& particles : colors_) update(system, particles);
    }
    finish(system, state, statistics);
  }

 private:
  // One Newton step of each particle; those of one colour do not see each other.
  void update(const System& system, std::span<const std::int32_t> particles) {
    const double h = stage_.length;
    f_.assign(particles.size(), Vec3::Zero());
    K_.assign(particles.size(), Mat3::Zero());
    x_ = stage_.base + u_;
    if (system.has_damping()) velocity_ = u_ / h;
    for (const Force* force : system.active_forces()) {
      if (!force->is_constant()) force->add_blocks(x_, particles, f_, K_);
      if (force->has_damping()) force->add_damping_blocks(stage_.base, velocity_, 1.0 / h, particles, f_, K_);
    }
    for (std::size_t i = 0; i < particles.size(); ++i) move(system, particles[i], f_[i], K_[i]);
  }

  void move(const System& system, std::int32_t particle, Vec3 f, Mat3 K) {
    const double h = stage_.length;
    const Vec3 free = block3(system.free(), particle), inertia = block3(system.masses(), particle) / (h * h);
    const Vec3 drifted = block3(u_, particle) - h * block3(stage_.base_velocity, particle);
    f += block3(potential_.constant_force(), particle) - inertia.cwiseProduct(drifted);
    K.diagonal() += inertia;
    f = f.cwiseProduct(free);
    K = free.asDiagonal() * K * free.asDiagonal();
    K.diagonal() += Vec3::Ones() - free;
    block3(u_, particle) += find_step(particle, free, f, K);
  }

  // The d that minimises d.K d / 2 - f.d + friction(u + d). Friction is convex but has no useful second order where it
  // sets in, so its part is iterated with a line search.
  Vec3 find_step(std::int32_t particle, const Vec3& free, const Vec3& f, const Mat3& K) const {
    const auto& all = potential_.friction_points();  // those of a particle are neighbours
    const auto [first, last] = std::equal_range(all.begin(), all.end(), FrictionPoint{particle},
                                                [](const auto& a, const auto& b) { return a.particle < b.particle; });
    Vec3 d = Vec3::Zero();
    if (first == last) return K.ldlt().solve(f);
    const Vec3 u = block3(u_, particle);
    const auto calc_value = [&](const Vec3& at) {
      double value = 0.5 * at.dot(K * at) - f.dot(at);
      for (auto point = first; point != last; ++point) {
        value += calc_friction_potential(*point, potential_.slip(), u + at).value;
      }
      return value;
    };
    for (int iteration = 0; iteration < 20; ++iteration) {
      Vec3 gradient = K * d - f;
      Mat3 hessian = K;
      for (auto point = first; point != last; ++point) {
        gradient += free.cwiseProduct(calc_friction_potential(*point, potential_.slip(), u + d).gradient);
        hessian += free.asDiagonal() * calc_friction_tangent(*point, potential_.slip(), u + d) * free.asDiagonal();
      }
      const Vec3 step = -hessian.ldlt().solve(gradient);
      const double value = calc_value(d);
      double length = 1.0;
      while (length > 1e-6 && !(calc_value(d + length * step) < value)) length *= 0.5;
      if (length <= 1e-6) break;
      d += length * step;
    }
    return d;
  }

  void finish(const System& system, State& state, StepStatistics& statistics) {
    const double h = stage_.length;
    const double terms = potential_.calc_gradient(u_, gradient_);
    statistics.iterations += settings_.iterations;
    statistics.residual = terms > 0.0 ? gradient_.norm() / terms : 0.0;
    statistics.converged = statistics.converged && statistics.residual <= settings_.newton_tolerance;
    statistics.dissipated += h * potential_.calc_dissipated_power(u_);
    passes_.follow(system, h, {.reach = 1.0, .rate = 1.0 / h, .past = 0.0}, stage_.base, u_, potential_.force(), state,
                   statistics);
  }

  SolverSettings settings_;
  std::vector<std::vector<std::int32_t>> colors_;
  IncrementalPotential potential_;
  ImplicitStage stage_;
  ParticlePasses passes_;
  VecX u_, drifted_, x_, velocity_, gradient_;
  std::vector<Vec3> f_;
  std::vector<Mat3> K_;
};

}  // namespace

const IntegratorRow vbd_row{"vbd",
                            "vertex block descent: fast and stable, a fixed number of iterations",
                            0,
                            true,
                            [](double, double) { return std::numeric_limits<double>::infinity(); },
                            [](const System& system, const SolverSettings& settings) -> std::unique_ptr<Integrator> {
                              return std::make_unique<Vbd>(system, settings);
                            }};

}  // namespace flexcast
