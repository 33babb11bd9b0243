// A multigrid V-cycle as preconditioner: what smoothing leaves of the error is smooth enough for a coarser grid.
// The grids are lattices in the rest shape (grid_hierarchy.h), their matrices A_c = P^T A P (galerkin.h), smoothers
// Gauss-Seidel forwards before and backwards after the coarser grid, so that the cycle is symmetric and positive
// definite (gauss_seidel.h). A piece's coarsest matrix is factored.
// Source: U. Trottenberg, C. Oosterlee, A. Schueller, Multigrid, Academic Press 2001, chapters 2 and 7.
#pragma once

#include <optional>
#include <vector>

#include "core/solvers/galerkin.h"
#include "core/solvers/gauss_seidel.h"
#include "core/solvers/grid_hierarchy.h"
#include "core/solvers/preconditioner.h"

namespace flexcast {

class Multigrid final : public Preconditioner {
 public:
  explicit Multigrid(VecX rest_positions) : rest_positions_(std::move(rest_positions)) {}
  bool setup(const BlockMatrix& A) override;
  void apply(const VecX& r, VecX& z) override;

  // Block rows of every level, the particles' first.
  std::vector<std::int64_t> level_sizes() const;

 private:
  struct Level {
    const BlockMatrix* A = nullptr;
    BlockMatrix coarse;  // A, but for the first level
    GaussSeidel smoother;
    std::optional<GalerkinProduct> galerkin;  // to the next level
    VecX r, x, residual, correction;
  };

  void make_levels(const BlockMatrix& A);
  void factor_pieces(const BlockMatrix& A);
  void cycle(std::size_t level, const VecX& r, VecX& z);

  VecX rest_positions_;
  std::uint64_t pattern_id_ = 0;
  GridHierarchy hierarchy_;
  std::vector<Level> levels_;
  std::vector<double> factors_;  // of the pieces' coarsest matrices, one after the other
  std::vector<double> scratch_;
};

}  // namespace flexcast
