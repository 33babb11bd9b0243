#include "core/lab/bench/bench_kernels.h"

#include "core/lab/bench/bench_state.h"
#include "core/solvers/block_jacobi.h"
#include "core/solvers/pcg.h"

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
  choose_tolerance(Iterations::plain);
  choose_tolerance(Iterations::chosen);
}

// M / h^2 + K, positive definite.
void Kernels::make_matrix() {
  constexpr double h = 1.0 / 60.0;  // s
  A_.set_zero();
  A_.add_diagonal(system_.masses() / (h * h));
  system_.add_stiffness(x_, 1.0, Tangent::positive_semidefinite, A_);
  A_.hold(system_.free());
}

void Kernels::choose_tolerance(Iterations kind) {
  constexpr int wanted = 20;  // iterations
  Solve& mine = solve(kind);
  for (double tolerance = 0.1; tolerance > 1e-12; tolerance *= 0.1) {
    if (kind == Iterations::plain) {
      mine.solver = std::make_unique<PcgSolver>(tolerance, std::make_unique<BlockJacobi>());
    } else {
      SolverSettings settings;
      settings.linear = "pcg";
      settings.linear_tolerance = tolerance;
      mine.solver = make_linear_solver(settings, system_.rest_positions());
    }
    if (run_long_solve(kind) >= wanted) break;
  }
  mine.solution = u_;
}

void Kernels::run_scalar_force() {
  scalar_f_.setZero();
  for (const auto& loop : plain_loops_) loop->add_force(x_, scalar_f_);
}

void Kernels::run_tangent() {
  tangent_.set_zero();
  system_.add_stiffness(x_, 1.0, Tangent::exact, tangent_);
}

int Kernels::run_long_solve(Iterations kind) {
  u_.setZero(b_.size());
  return solve(kind).solver->solve(A_, b_, u_).iterations;
}

int Kernels::run_short_solve(Iterations kind) {
  u_ = solve(kind).solution;
  return solve(kind).solver->solve(A_, b_, u_).iterations;
}

KernelTurns::KernelTurns(Kernels& kernels, Turns& turns, const std::function<void()>& prepare) : first_(turns.count()) {
  turns.add([&] { kernels.run_force(); }, prepare);
  turns.add([&] { kernels.run_scalar_force(); }, prepare);
  turns.add([&] { kernels.run_copy(); }, prepare);
  turns.add([&] { kernels.run_tangent(); }, prepare);
  using Iterations = Kernels::Iterations;
  turns.add([this, &kernels] { plain_.of_long = kernels.run_long_solve(Iterations::plain); }, prepare);
  turns.add([this, &kernels] { plain_.of_short = kernels.run_short_solve(Iterations::plain); }, prepare);
  turns.add([this, &kernels] { chosen_.of_long = kernels.run_long_solve(Iterations::chosen); }, prepare);
  turns.add([this, &kernels] { chosen_.of_short = kernels.run_short_solve(Iterations::chosen); }, prepare);
}

KernelTimes KernelTurns::calc_times(const std::vector<double>& seconds) const {
  const double* mine = seconds.data() + first_;
  // What precedes the first iteration is in both solves.
  const auto calc_iteration = [](const Counts& counts, double of_long, double of_short) {
    const int more = counts.of_long - counts.of_short;
    if (more > 0 && of_long > of_short) return (of_long - of_short) / more;
    return counts.of_long > 0 ? of_long / counts.of_long : 0.0;
  };
  return {mine[0],
          mine[1],
          mine[2],
          mine[3],
          calc_iteration(plain_, mine[4], mine[5]),
          calc_iteration(chosen_, mine[6], mine[7])};
}

}  // namespace flexcast
