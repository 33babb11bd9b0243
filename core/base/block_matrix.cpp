#include "core/base/block_matrix.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "core/base/block_product.h"
#include "core/base/checks.h"
#include "core/base/parallel.h"

namespace flexcast {
namespace {

constexpr std::int64_t rows_per_block = 512;  // of sums, and the least a thread takes

std::uint64_t make_pattern_id() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace

// Counting sort by row, then each short row by itself.
BlockPattern::BlockPattern(std::int32_t rows, const Pairs& pairs) : id(make_pattern_id()) {
  const auto n = static_cast<std::size_t>(rows);
  std::vector<std::int64_t> next(n + 1, 0);
  for (std::size_t i = 0; i < n; ++i) next[i + 1] = 1;
  for (const auto& [i, j] : pairs) {
    if (i == j) continue;
    ++next[static_cast<std::size_t>(i) + 1];
    ++next[static_cast<std::size_t>(j) + 1];
  }
  for (std::size_t i = 0; i < n; ++i) next[i + 1] += next[i];
  columns.resize(static_cast<std::size_t>(next[n]));
  starts = next;
  for (std::int32_t i = 0; i < rows; ++i) columns[static_cast<std::size_t>(next[i]++)] = i;
  for (const auto& [i, j] : pairs) {
    if (i == j) continue;
    columns[static_cast<std::size_t>(next[i]++)] = j;
    columns[static_cast<std::size_t>(next[j]++)] = i;
  }

  diagonals.resize(n);
  std::int64_t filled = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto first = columns.begin() + starts[i], end = columns.begin() + starts[i + 1];
    std::sort(first, end);
    const auto unique_end = std::unique(first, end);
    const auto diagonal = std::lower_bound(first, unique_end, static_cast<std::int32_t>(i));
    diagonals[i] = filled + (diagonal - first);
    std::copy(first, unique_end, columns.begin() + filled);
    starts[i] = filled;
    filled += unique_end - first;
  }
  starts[n] = filled;
  columns.resize(static_cast<std::size_t>(filled));
  columns.shrink_to_fit();
}

BlockMatrix::BlockMatrix(std::shared_ptr<const BlockPattern> pattern)
    : pattern_(std::move(pattern)), blocks_(pattern_->columns.size() + 1, Mat3::Zero()) {}

void BlockMatrix::set_zero() {
  parallel_for(static_cast<std::int64_t>(blocks_.size()), 8192,
               [&](std::int64_t first, std::int64_t end) { std::fill(value(first), value(end), 0.0); });
}

void BlockMatrix::assign_values(const BlockMatrix& other) {
  FLEXCAST_CHECK(other.blocks_.size() == blocks_.size());
  parallel_for(static_cast<std::int64_t>(blocks_.size()), 8192, [&](std::int64_t first, std::int64_t end) {
    std::copy(other.value(first), other.value(end), value(first));
  });
}

std::int64_t BlockMatrix::find(std::int32_t i, std::int32_t j) const {
  const auto begin = pattern_->columns.begin() + pattern_->starts[i],
             end = pattern_->columns.begin() + pattern_->starts[i + 1];
  const auto found = std::lower_bound(begin, end, j);
  FLEXCAST_CHECK(found != end && *found == j);
  return found - pattern_->columns.begin();
}

void BlockMatrix::add_diagonal(const VecX& diagonal) {
  for (std::int32_t i = 0; i < rows(); ++i) blocks_[pattern_->diagonals[i]].diagonal() += block3(diagonal, i);
}

// Couplings are symmetric: who is coupled to a held particle stands in that particle's row.
void BlockMatrix::hold(const VecX& free) {
  const auto apply = [&](std::int32_t i, std::int64_t k) {
    const Vec3 row_free = block3(free, i), column_free = block3(free, pattern_->columns[k]);
    blocks_[k] = row_free.asDiagonal() * blocks_[k] * column_free.asDiagonal();
  };
  for (std::int32_t i = 0; i < rows(); ++i) {
    const Vec3 row_free = block3(free, i);
    if (row_free == Vec3::Ones()) continue;
    for (std::int64_t k = pattern_->starts[i]; k < pattern_->starts[i + 1]; ++k) {
      apply(i, k);
      if (pattern_->columns[k] != i) apply(pattern_->columns[k], find(pattern_->columns[k], i));
    }
    blocks_[pattern_->diagonals[i]].diagonal() += Vec3::Ones() - row_free;
  }
}

void BlockMatrix::multiply(const VecX& x, VecX& y) const {
  y.resize(x.size());
  const BlockRows A = block_rows();
  parallel_for(rows(), rows_per_block,
               [&](std::int64_t first, std::int64_t end) { multiply_block_rows(A, first, end, x.data(), y.data()); });
}

double BlockMatrix::multiply_dot(const VecX& x, VecX& y, std::vector<double>& partial) const {
  y.resize(x.size());
  const BlockRows A = block_rows();
  return parallel_sum(rows(), rows_per_block, partial, [&](std::int64_t first, std::int64_t end) {
    return multiply_block_rows(A, first, end, x.data(), y.data());
  });
}

}  // namespace flexcast
