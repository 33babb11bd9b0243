#include "core/solvers/linear_solver.h"

#include "core/solvers/block_jacobi.h"
#include "core/solvers/ldlt.h"
#include "core/solvers/multigrid.h"
#include "core/solvers/pcg.h"

namespace flexcast {
namespace {

// Below that many block rows coarser grids have nothing to gain.
constexpr std::int32_t least_multigrid = 100;
// Beyond that many the order of elimination alone takes longer to find than a few iterative solutions.
constexpr std::int32_t most_direct = 20000;

// s, of setting multigrid up and of as many iterations as it usually takes.
double predict_pcg_time(const BlockMatrix& A) {
  constexpr double setup = 30e-9, iteration = 12e-9;  // s a block
  constexpr double iterations = 20.0;
  return (setup + iterations * iteration) * static_cast<double>(A.block_count());
}

// Chooses at the first matrix, by its pattern alone.
class ChosenSolver final : public LinearSolver {
 public:
  ChosenSolver(const SolverSettings& settings, const VecX& rest_positions)
      : may_be_direct_(settings.linear == "auto"),
        tolerance_(settings.linear_tolerance),
        rest_positions_(rest_positions) {}

  LinearResult solve(const BlockMatrix& A, const VecX& b, VecX& x) override {
    if (!solver_) choose(A);
    return solver_->solve(A, b, x);
  }

 private:
  // Finding the order of elimination takes longer than some steps. A changed parameter makes a new solver for the same
  // pattern: that it is not worth it is remembered.
  void choose(const BlockMatrix& A) {
    thread_local std::uint64_t last_not_direct = 0;
    if (may_be_direct_ && A.rows() <= most_direct && A.pattern_id() != last_not_direct) {
      auto direct = std::make_unique<LdltSolver>();
      if (direct->predict_time(A) <= predict_pcg_time(A)) {
        solver_ = std::move(direct);
        return;
      }
      last_not_direct = A.pattern_id();
    }
    std::unique_ptr<Preconditioner> preconditioner;
    if (A.rows() >= least_multigrid && rest_positions_.size() == 3 * A.rows()) {
      preconditioner = std::make_unique<Multigrid>(rest_positions_);
    } else {
      preconditioner = std::make_unique<BlockJacobi>();
    }
    solver_ = std::make_unique<PcgSolver>(tolerance_, std::move(preconditioner));
  }

  bool may_be_direct_;
  double tolerance_;
  VecX rest_positions_;
  std::unique_ptr<LinearSolver> solver_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_linear_solver(const SolverSettings& settings, const VecX& rest_positions) {
  if (settings.linear == "ldlt") return std::make_unique<LdltSolver>();
  return std::make_unique<ChosenSolver>(settings, rest_positions);
}

}  // namespace flexcast
