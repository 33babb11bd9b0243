#include "core/solvers/linear_solver.h"

#include "core/solvers/block_jacobi.h"
#include "core/solvers/ldlt.h"
#include "core/solvers/pcg.h"

namespace flexcast {

std::unique_ptr<LinearSolver> make_linear_solver(const SolverSettings& settings, std::int64_t particles) {
  // Filling in makes a factor of a volume's matrix grow much faster than the work of the iteration.
  constexpr std::int64_t largest_direct = 1000;
  const bool direct = settings.linear == "ldlt" || (settings.linear == "auto" && particles <= largest_direct);
  if (direct) return std::make_unique<LdltSolver>();
  return std::make_unique<PcgSolver>(settings.linear_tolerance, std::make_unique<BlockJacobi>());
}

}  // namespace flexcast
