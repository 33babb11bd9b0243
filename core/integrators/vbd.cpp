#include "core/integrators/vbd.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "core/base/aligned.h"
#include "core/base/parallel.h"
#include "core/forces/friction.h"
#include "core/integrators/coloring.h"
#include "core/integrators/incremental_potential.h"

namespace flexcast {
namespace {

// Four doubles a particle, for BlockRuns.
void copy_to_fours(const VecX& from, AlignedVector<double>& to) {
  to.resize(static_cast<std::size_t>(from.size() / 3 * 4), 0.0);
  for (std::int64_t i = 0; i < from.size() / 3; ++i) std::copy_n(from.data() + 3 * i, 3, to.data() + 4 * i);
}

// L D L^T of a 3 x 3 matrix, from the left upper corner on.
struct Factor {
  Vec3 pivots, inverse;  // D
  double yx, zx, zy;     // below L's diagonal of ones

  explicit Factor(const Mat3& A) {
    pivots[0] = A(0, 0);
    inverse[0] = 1.0 / pivots[0];
    yx = A(1, 0) * inverse[0];
    zx = A(2, 0) * inverse[0];
    pivots[1] = A(1, 1) - yx * A(1, 0);
    inverse[1] = 1.0 / pivots[1];
    const double rest = A(2, 1) - zx * A(1, 0);
    zy = rest * inverse[1];
    pivots[2] = A(2, 2) - zx * A(2, 0) - zy * rest;
    inverse[2] = 1.0 / pivots[2];
  }
  Vec3 solve(const Vec3& b) const {
    const double y = b[1] - yx * b[0], z = (b[2] - zx * b[0] - zy * y) * inverse[2], w = y * inverse[1] - zy * z;
    return {b[0] * inverse[0] - yx * w - zx * z, w, z};
  }
};

class Vbd final : public Integrator {
 public:
  Vbd(const System& system, const SolverSettings& settings)
      : settings_(settings), order_(static_cast<std::int32_t>(system.dofs() / 3), system.make_couplings()) {}

  void step(const System& system, double h, State& state, StepStatistics& statistics) override {
    stage_.start(system, state, h, 0.0);
    potential_.begin(system, stage_, u_);
    potential_.calc_drift(drifted_);
    // Sweeps only descend, so the better of two starts bounds the energy at any step.
    drifted_ += u_ + h * h * system.inverse_masses().cwiseProduct(potential_.constant_force());
    if (potential_.calc_value(drifted_).value <= potential_.calc_value(u_).value) u_ = drifted_;
    find_terms(system);
    x_ = stage_.base + u_;
    copy_to_fours(x_, fours_.x);
    if (system.has_damping()) {
      velocity_ = u_ / h;
      copy_to_fours(velocity_, fours_.v);
      copy_to_fours(stage_.base, fours_.base);
    }
    for (int i = 0; i < sweeps_; ++i) sweep(system);
    finish(system, state, statistics);
  }

  void limit_iterations(int most) override {
    sweeps_ = most > 0 ? std::min(most, settings_.iterations) : settings_.iterations;
  }

 private:
  struct Term {
    const Force* force;
    const BlockRuns* runs;  // null: it has none
  };
  struct OwnedRuns {
    const Force* force;
    std::unique_ptr<BlockRuns> runs;
  };

  // The terms of this step. What they need is made when a force is first seen active.
  void find_terms(const System& system) {
    terms_.clear();
    for (const Force* force : system.active_forces()) {
      if (force->is_constant() && !force->has_damping()) continue;
      auto found = std::find_if(owned_.begin(), owned_.end(), [&](const auto& one) { return one.force == force; });
      if (found == owned_.end()) {
        owned_.push_back({force, force->make_block_runs(order_.visits)});
        found = owned_.end() - 1;
      }
      terms_.push_back({force, found->runs.get()});
    }
  }

  void sweep(const System& system) {
    for (std::size_t color = 0; color + 1 < order_.color_starts.size(); ++color) {
      const std::int32_t start = order_.color_starts[color];
      parallel_for(order_.color_starts[color + 1] - start, 1, [&](std::int64_t first, std::int64_t end) {
        for (std::int64_t run = first; run < end; ++run) update(system, start + static_cast<std::int32_t>(run));
      });
    }
  }

  // One Newton step of each particle of a run.
  void update(const System& system, std::int32_t run) {
    const std::span<const std::int32_t> particles = order_.visits.run(run);
    std::array<Vec3, Visits::most_in_run> all_f;
    std::array<Mat3, Visits::most_in_run> all_K;
    const auto f = std::span(all_f).first(particles.size());
    const auto K = std::span(all_K).first(particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i) start(system, particles[i], f[i], K[i]);
    const double rate = 1.0 / stage_.length;
    for (const auto& [force, runs] : terms_) {
      if (runs != nullptr) {
        runs->add(run, fours_.x.data(), f, K);
        if (force->has_damping()) runs->add_damping(run, fours_.base.data(), fours_.v.data(), rate, f, K);
        continue;
      }
      if (!force->is_constant()) force->add_blocks(x_, particles, f, K);
      if (force->has_damping()) force->add_damping_blocks(stage_.base, velocity_, rate, particles, f, K);
    }
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const Vec3 step = find_step(system, run, static_cast<std::int32_t>(i), f[i], K[i]);
      move(system, particles[i], step);
    }
  }

  // What inertia and constant forces give.
  void start(const System& system, std::int32_t particle, Vec3& f, Mat3& K) const {
    const double h = stage_.length;
    const Vec3 inertia = 1.0 / (h * h) * block3(system.masses(), particle);
    const Vec3 drifted = block3(u_, particle) - h * block3(stage_.base_velocity, particle);
    f = block3(potential_.constant_force(), particle) - inertia.cwiseProduct(drifted);
    K = inertia.asDiagonal();
  }

  void move(const System& system, std::int32_t particle, const Vec3& step) {
    block3(u_, particle) += step;
    const Vec3 x = block3(stage_.base, particle) + block3(u_, particle);
    block3(x_, particle) = x;
    std::copy_n(x.data(), 3, fours_.x.data() + 4 * static_cast<std::int64_t>(particle));
    if (!system.has_damping()) return;
    const Vec3 v = block3(u_, particle) / stage_.length;
    block3(velocity_, particle) = v;
    std::copy_n(v.data(), 3, fours_.v.data() + 4 * static_cast<std::int64_t>(particle));
  }

  static void hold(const Vec3& free, Mat3& K) {
    if (free.minCoeff() == 1.0) return;
    K.array() *= (free * free.transpose()).array();
    K.diagonal() += Vec3::Ones() - free;
  }

  Vec3 find_step(const System& system, std::int32_t run, std::int32_t i, const Vec3& f, const Mat3& whole_K) const {
    const std::int32_t particle = order_.visits.run(run)[static_cast<std::size_t>(i)];
    const Vec3 free = block3(system.free(), particle);
    const Vec3 free_f = f.cwiseProduct(free);
    Mat3 K = whole_K;
    hold(free, K);
    Factor factor(K);
    // Positive semidefinite blocks add to the pivots that inertia alone has.
    const double h = stage_.length;
    const Vec3 least = 0.5 / (h * h) * block3(system.masses(), particle).cwiseProduct(free);
    if (!(factor.pivots.array() > least.array()).all()) {
      K = whole_K;
      for (const auto& [force, runs] : terms_) {
        if (runs != nullptr) runs->make_positive(run, i, fours_.x.data(), K);
      }
      hold(free, K);
      factor = Factor(K);
    }
    if (potential_.friction_points().empty()) return factor.solve(free_f);
    return find_step_with_friction(particle, free, free_f, K, factor.solve(free_f));
  }

  // The d that minimises d.K d / 2 - f.d + friction(u + d). Friction is convex but has no useful second order where it
  // sets in, so its part is iterated with a line search.
  Vec3 find_step_with_friction(std::int32_t particle, const Vec3& free, const Vec3& f, const Mat3& K,
                               const Vec3& without) const {
    const auto& all = potential_.friction_points();  // those of a particle are neighbours
    const auto found = std::equal_range(all.begin(), all.end(), FrictionPoint{particle},
                                        [](const auto& a, const auto& b) { return a.particle < b.particle; });
    const std::span points(found.first, found.second);
    Vec3 d = Vec3::Zero();
    if (points.empty()) return without;
    const Vec3 u = block3(u_, particle);
    const auto calc_value = [&](const Vec3& at) {
      double value = 0.5 * at.dot(K * at) - f.dot(at);
      for (const FrictionPoint& point : points) {
        value += calc_friction_potential(point, potential_.slip(), u + at).value;
      }
      return value;
    };
    for (int iteration = 0; iteration < 20; ++iteration) {
      Vec3 gradient = K * d - f;
      Mat3 hessian = K;
      for (const FrictionPoint& point : points) {
        gradient += free.cwiseProduct(calc_friction_potential(point, potential_.slip(), u + d).gradient);
        hessian += free.asDiagonal() * calc_friction_tangent(point, potential_.slip(), u + d) * free.asDiagonal();
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
    statistics.iterations += sweeps_;
    statistics.residual = terms > 0.0 ? gradient_.norm() / terms : 0.0;
    statistics.converged = statistics.converged && statistics.residual <= settings_.newton_tolerance;
    statistics.dissipated += h * potential_.calc_dissipated_power(u_);
    passes_.follow(system, h, {.reach = 1.0, .time = h, .past = 0.0}, stage_.base, u_, potential_.force(), state,
                   statistics);
  }

  SolverSettings settings_;
  int sweeps_ = settings_.iterations;
  VisitOrder order_;
  std::vector<OwnedRuns> owned_;
  std::vector<Term> terms_;
  IncrementalPotential potential_;
  ImplicitStage stage_;
  ParticlePasses passes_;
  VecX u_, drifted_, x_, velocity_, gradient_;
  struct {
    AlignedVector<double> x, v, base;
  } fours_;  // copies of x_, velocity_ and the stage's base
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
