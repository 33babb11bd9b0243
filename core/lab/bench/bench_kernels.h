// The kernels of a scene as things to be timed: forces, tangent, conjugate gradients, and what they are compared with.
#pragma once

#include <memory>
#include <vector>

#include "core/forces/system.h"
#include "core/lab/bench/bench_loops.h"
#include "core/lab/bench/bench_timing.h"
#include "core/solvers/linear_solver.h"

namespace flexcast {

// Every kernel is taken at the deformed state of bench_state.h.
class Kernels {
 public:
  // Keeps a reference to the model.
  explicit Kernels(const Model& model);

  // Forces of the engine, conservative ones: into force().
  void run_force() { system_.calc_conservative(x_, f_); }
  // The elastic ones of them by the plain loop.
  void run_scalar_force();
  // As many bytes as a force evaluation touches at least.
  void run_copy() { copy_.run(); }
  // The exact stiffness of everything, into a matrix of zeros.
  void run_tangent();

  // Conjugate gradients on the matrix of a backward Euler step of 1/60 s: alone, with the diagonal blocks as
  // preconditioner, or with the preconditioner that "pcg" takes. They start from zero and take at least twenty
  // iterations where the scene needs as many, or start from that solution; return their iterations.
  enum class Iterations { plain, chosen };
  int run_long_solve(Iterations kind);
  int run_short_solve(Iterations kind);

  const VecX& force() const { return f_; }                // N
  const VecX& scalar_force() const { return scalar_f_; }  // N

 private:
  struct Solve {
    std::unique_ptr<LinearSolver> solver;
    VecX solution;
  };
  void make_matrix();
  void choose_tolerance(Iterations kind);
  Solve& solve(Iterations kind) { return kind == Iterations::plain ? plain_ : chosen_; }

  System system_;
  std::vector<std::unique_ptr<PlainLoop>> plain_loops_;
  Copy copy_;
  VecX x_, f_, scalar_f_, b_, u_;
  BlockMatrix tangent_, A_;
  Solve plain_, chosen_;
};

// Seconds of one evaluation, medians.
struct KernelTimes {
  double force = 0.0, scalar_force = 0.0, copy = 0.0, tangent = 0.0;
  double cg_iteration = 0.0;      // 0: nothing in the scene can move
  double chosen_iteration = 0.0;  // with the chosen preconditioner
};

// The kernels as tasks that take turns with each other and with others. Stays where it is until they are measured.
class KernelTurns {
 public:
  KernelTurns(Kernels& kernels, Turns& turns, const std::function<void()>& prepare = {});
  KernelTurns(const KernelTurns&) = delete;
  KernelTurns& operator=(const KernelTurns&) = delete;

  // From what Turns::measure returned.
  KernelTimes calc_times(const std::vector<double>& seconds) const;

 private:
  std::size_t first_;
  struct Counts {
    int of_long = 0, of_short = 0;
  };
  Counts plain_, chosen_;
};

}  // namespace flexcast
