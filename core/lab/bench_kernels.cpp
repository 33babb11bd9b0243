#include "core/lab/bench_kernels.h"

#include "core/lab/bench_state.h"

namespace flexcast {

Kernels::Kernels(const Model& model)
    : system_(model),
      plain_loops_(make_plain_loops(model)),
      copy_(calc_touched_bytes(model)),
      x_(make_deformed_positions(model)),
      scalar_f_(x_.size()),
      b_(make_scattered(x_.size()).cwiseProduct(system_.free())),
      tangent_(system_.make_matrix()),
      A_(tangent_) {
  make_matrix();
  choose_tolerance();
}

// M / h^2 + K, positive definite.
void Kernels::make_matrix() {
  constexpr double h = 1.0 / 60.0;  // s
  A_.set_zero();
  A_.add_diagonal(system_.masses() / (h * h));
  system_.add_stiffness(x_, 1.0, Tangent::positive_semidefinite, A_);
  A_.hold(system_.free());
}

void Kernels::choose_tolerance() {
  constexpr int wanted = 20;  // iterations
  for (double tolerance = 0.1; tolerance > 1e-12; tolerance *= 0.1) {
    SolverSettings settings;
    settings.linear = "pcg";
    settings.linear_tolerance = tolerance;
    solver_ = make_linear_solver(settings, system_.rest_positions());
    if (run_long_solve() >= wanted) break;
  }
  solution_ = u_;
}

void Kernels::run_scalar_force() {
  scalar_f_.setZero();
  for (const auto& loop : plain_loops_) loop->add_force(x_, scalar_f_);
}

void Kernels::run_tangent() {
  tangent_.set_zero();
  system_.add_stiffness(x_, 1.0, Tangent::exact, tangent_);
}

int Kernels::run_long_solve() {
  u_.setZero(b_.size());
  return solver_->solve(A_, b_, u_).iterations;
}

int Kernels::run_short_solve() {
  u_ = solution_;
  return solver_->solve(A_, b_, u_).iterations;
}

KernelTurns::KernelTurns(Kernels& kernels, Turns& turns, const std::function<void()>& prepare) : first_(turns.count()) {
  turns.add([&] { kernels.run_force(); }, prepare);
  turns.add([&] { kernels.run_scalar_force(); }, prepare);
  turns.add([&] { kernels.run_copy(); }, prepare);
  turns.add([&] { kernels.run_tangent(); }, prepare);
  turns.add([this, &kernels] { long_iterations_ = kernels.run_long_solve(); }, prepare);
  turns.add([this, &kernels] { short_iterations_ = kernels.run_short_solve(); }, prepare);
}

KernelTimes KernelTurns::calc_times(const std::vector<double>& seconds) const {
  const double* mine = seconds.data() + first_;
  KernelTimes times{mine[0], mine[1], mine[2], mine[3], 0.0};
  // What precedes the first iteration is in both solves.
  const int more = long_iterations_ - short_iterations_;
  if (more > 0 && mine[4] > mine[5]) {
    times.cg_iteration = (mine[4] - mine[5]) / more;
  } else if (long_iterations_ > 0) {
    times.cg_iteration = mine[4] / long_iterations_;
  }
  return times;
}

}  // namespace flexcast
