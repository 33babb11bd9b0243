#include "core/solvers/multigrid.h"

#include "core/base/checks.h"
#include "core/solvers/dense_factor.h"

namespace flexcast {
namespace {

constexpr std::int32_t largest_factored = 30;  // nodes of a piece

}  // namespace

void Multigrid::make_levels(const BlockMatrix& A) {
  FLEXCAST_CHECK(rest_positions_.size() == 3 * A.rows());
  hierarchy_ = make_grid_hierarchy(A, rest_positions_, largest_factored);
  pattern_id_ = A.pattern_id();
  levels_ = std::vector<Level>(hierarchy_.levels.size() + 1);
  levels_[0].A = &A;
  for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
    Level& fine = levels_[l];
    Level& next = levels_[l + 1];
    fine.galerkin.emplace(*fine.A, hierarchy_.levels[l]);
    next.coarse = fine.galerkin->make_coarse();
    next.A = &next.coarse;
    fine.galerkin->make_maps(*fine.A, next.coarse);
  }
}

bool Multigrid::setup(const BlockMatrix& A) {
  if (A.pattern_id() != pattern_id_ || levels_.empty()) make_levels(A);
  levels_[0].A = &A;
  if (!levels_[0].smoother.setup(A)) return false;
  for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
    levels_[l].galerkin->calc(*levels_[l].A, levels_[l + 1].coarse);
    if (l + 2 < levels_.size()) levels_[l + 1].smoother.setup(levels_[l + 1].coarse);
  }
  factor_pieces(levels_.back().coarse);
  return true;
}

void Multigrid::factor_pieces(const BlockMatrix& A) {
  const std::vector<std::int32_t>& starts = hierarchy_.piece_starts;
  std::size_t total = 0;
  for (std::size_t p = 0; p + 1 < starts.size(); ++p) {
    const auto n = static_cast<std::size_t>(3 * (starts[p + 1] - starts[p]));
    total += n * n;
  }
  factors_.assign(total, 0.0);
  scratch_.resize(static_cast<std::size_t>(3 * largest_factored));
  double* factor = factors_.data();
  for (std::size_t p = 0; p + 1 < starts.size(); ++p) {
    const int n = 3 * (starts[p + 1] - starts[p]);
    for (std::int32_t i = starts[p]; i < starts[p + 1]; ++i) {
      const auto columns = A.columns(i);
      const auto blocks = A.blocks(i);
      for (std::size_t k = 0; k < columns.size(); ++k) {
        for (int c = 0; c < 3; ++c) {
          for (int r = 0; r < 3; ++r) {
            factor[n * (3 * (columns[k] - starts[p]) + c) + 3 * (i - starts[p]) + r] = blocks[k](r, c);
          }
        }
      }
    }
    factor_dense(factor, n, scratch_.data());
    factor += n * n;
  }
}

void Multigrid::cycle(std::size_t l, const VecX& r, VecX& z) {
  Level& level = levels_[l];
  if (l + 1 == levels_.size()) {
    z = r;
    const double* factor = factors_.data();
    for (std::size_t p = 0; p + 1 < hierarchy_.piece_starts.size(); ++p) {
      const int n = 3 * (hierarchy_.piece_starts[p + 1] - hierarchy_.piece_starts[p]);
      solve_dense(factor, n, z.data() + 3 * hierarchy_.piece_starts[p]);
      factor += n * n;
    }
    return;
  }
  Level& next = levels_[l + 1];
  const Interpolation& P = hierarchy_.levels[l];
  level.smoother.smooth_forwards(*level.A, r, level.x, level.residual);
  P.apply_transposed(level.residual, next.r);
  cycle(l + 1, next.r, next.correction);
  P.add(next.correction, level.x);
  level.smoother.smooth_backwards(*level.A, r, level.x, z);
}

void Multigrid::apply(const VecX& r, VecX& z) {
  cycle(0, r, z);
}

std::vector<std::int64_t> Multigrid::level_sizes() const {
  std::vector<std::int64_t> sizes;
  for (const Level& level : levels_) sizes.push_back(level.A->rows());
  return sizes;
}

}  // namespace flexcast
