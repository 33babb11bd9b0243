// A sparse matrix of 3 x 3 blocks, one block row a particle, with a fixed pattern: both triangles and the whole
// diagonal. Rows are stored one after the other with ascending columns, blocks column by column, without gaps.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/base/math.h"

namespace flexcast {

// The arrays of a matrix as kernels want them.
struct BlockRows {
  const std::int64_t* starts = nullptr;     // rows + 1
  const std::int64_t* diagonals = nullptr;  // rows: where the diagonal block is
  const std::int32_t* columns = nullptr;
  const double* values = nullptr;  // 9 a block; three more may be read behind the last one
};

// Which blocks there are. Matrices share it.
struct BlockPattern {
  using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

  // Every pair in both directions, and the diagonal. Pairs may repeat.
  BlockPattern(std::int32_t rows, const Pairs& pairs);

  std::uint64_t id = 0;                 // of all patterns ever made, this one's number
  std::vector<std::int64_t> starts;     // rows + 1
  std::vector<std::int64_t> diagonals;  // rows: where the diagonal block is
  std::vector<std::int32_t> columns;
};

class BlockMatrix {
 public:
  using Pairs = BlockPattern::Pairs;

  BlockMatrix() : BlockMatrix(0, {}) {}
  explicit BlockMatrix(std::shared_ptr<const BlockPattern> pattern);
  BlockMatrix(std::int32_t rows, const Pairs& pairs) : BlockMatrix(std::make_shared<BlockPattern>(rows, pairs)) {}

  std::int32_t rows() const { return static_cast<std::int32_t>(pattern_->diagonals.size()); }
  std::int64_t block_count() const { return static_cast<std::int64_t>(pattern_->columns.size()); }
  std::uint64_t pattern_id() const { return pattern_->id; }

  void set_zero();
  // The values of a matrix with the same pattern.
  void assign_values(const BlockMatrix& other);
  // The number of the block (i, j), which the pattern must have.
  std::int64_t find(std::int32_t i, std::int32_t j) const;
  // 9 doubles a block, by number, column by column.
  double* values() { return blocks_.data()->data(); }
  const double* values() const { return blocks_.data()->data(); }
  double* value(std::int64_t index) { return values() + 9 * index; }
  const double* value(std::int64_t index) const { return values() + 9 * index; }

  // Adds to the block (i, j), which the pattern must have.
  void add(std::int32_t i, std::int32_t j, const Mat3& block) {
    blocks_[static_cast<std::size_t>(find(i, j))] += block;
  }
  void add_diagonal(const VecX& diagonal);
  // Rows and columns of held degrees of freedom (free[i] = 0) become those of the identity.
  void hold(const VecX& free);

  // y = A x.
  void multiply(const VecX& x, VecX& y) const;
  // The same; returns x.y. `partial` is scratch to be kept.
  double multiply_dot(const VecX& x, VecX& y, std::vector<double>& partial) const;

  std::span<const std::int32_t> columns(std::int32_t row) const {
    return {pattern_->columns.data() + pattern_->starts[row],
            static_cast<std::size_t>(pattern_->starts[row + 1] - pattern_->starts[row])};
  }
  std::span<const Mat3> blocks(std::int32_t row) const {
    return {blocks_.data() + pattern_->starts[row],
            static_cast<std::size_t>(pattern_->starts[row + 1] - pattern_->starts[row])};
  }
  std::int64_t start(std::int32_t row) const { return pattern_->starts[row]; }
  const Mat3& diagonal(std::int32_t row) const { return blocks_[pattern_->diagonals[row]]; }
  BlockRows block_rows() const {
    return {pattern_->starts.data(), pattern_->diagonals.data(), pattern_->columns.data(), values()};
  }

 private:
  std::shared_ptr<const BlockPattern> pattern_;  // copies and matrices of the same scene have it in common
  std::vector<Mat3> blocks_;                     // and one more, so that kernels may read behind the last
};

}  // namespace flexcast
