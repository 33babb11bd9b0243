// A sparse matrix of 3 x 3 blocks, one block row a particle, with a fixed pattern: both triangles and the whole
// diagonal. Rows are stored one after the other with ascending columns.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "core/base/math.h"

namespace flexcast {

class BlockMatrix {
 public:
  BlockMatrix() = default;
  // The pattern: every pair in both directions, and the diagonal. Pairs may repeat.
  BlockMatrix(std::int32_t rows, std::vector<std::pair<std::int32_t, std::int32_t>> pairs);

  std::int32_t rows() const { return static_cast<std::int32_t>(starts_.empty() ? 0 : starts_.size() - 1); }
  std::int64_t block_count() const { return static_cast<std::int64_t>(columns_.size()); }

  void set_zero();
  // The values of a matrix with the same pattern.
  void assign_values(const BlockMatrix& other) { blocks_ = other.blocks_; }
  // Adds to the block (i, j), which the pattern must have.
  void add(std::int32_t i, std::int32_t j, const Mat3& block) { blocks_[find(i, j)] += block; }
  void add_diagonal(const VecX& diagonal);
  // Rows and columns of held degrees of freedom (free[i] = 0) become those of the identity.
  void hold(const VecX& free);

  // Where block (i, j) is, which the pattern must have: 9 doubles from values() + 9 * find(i, j), column by column.
  std::int64_t find(std::int32_t i, std::int32_t j) const;
  double* values() { return blocks_.front().data(); }
  // Of the pattern; copies have the same.
  std::uint64_t pattern_id() const { return pattern_id_; }

  // y = A x.
  void multiply(const VecX& x, VecX& y) const;

  std::span<const std::int32_t> columns(std::int32_t row) const {
    return {columns_.data() + starts_[row], static_cast<std::size_t>(starts_[row + 1] - starts_[row])};
  }
  std::span<const Mat3> blocks(std::int32_t row) const {
    return {blocks_.data() + starts_[row], static_cast<std::size_t>(starts_[row + 1] - starts_[row])};
  }
  const Mat3& diagonal(std::int32_t row) const { return blocks_[diagonals_[row]]; }

 private:
  std::uint64_t pattern_id_ = 0;
  std::vector<std::int64_t> starts_;     // rows + 1
  std::vector<std::int64_t> diagonals_;  // rows: where the diagonal block is
  std::vector<std::int32_t> columns_;
  std::vector<Mat3> blocks_;
};

}  // namespace flexcast
