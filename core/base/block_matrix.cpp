#include "core/base/block_matrix.h"

#include <algorithm>
#include <atomic>

#include "core/base/checks.h"

namespace flexcast {

BlockMatrix::BlockMatrix(std::int32_t rows, std::vector<std::pair<std::int32_t, std::int32_t>> pairs) {
  static std::atomic<std::uint64_t> last{0};
  pattern_id_ = ++last;
  const std::size_t given = pairs.size();
  pairs.reserve(2 * given + static_cast<std::size_t>(rows));
  for (std::size_t k = 0; k < given; ++k) pairs.emplace_back(pairs[k].second, pairs[k].first);
  for (std::int32_t i = 0; i < rows; ++i) pairs.emplace_back(i, i);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());

  starts_.assign(static_cast<std::size_t>(rows) + 1, 0);
  diagonals_.resize(static_cast<std::size_t>(rows));
  columns_.reserve(pairs.size());
  for (const auto& [i, j] : pairs) {
    if (i == j) diagonals_[i] = static_cast<std::int64_t>(columns_.size());
    columns_.push_back(j);
    ++starts_[i + 1];
  }
  for (std::int32_t i = 0; i < rows; ++i) starts_[i + 1] += starts_[i];
  blocks_.assign(columns_.size(), Mat3::Zero());
}

void BlockMatrix::set_zero() {
  std::fill(blocks_.begin(), blocks_.end(), Mat3::Zero());
}

std::int64_t BlockMatrix::find(std::int32_t i, std::int32_t j) const {
  const auto begin = columns_.begin() + starts_[i], end = columns_.begin() + starts_[i + 1];
  const auto found = std::lower_bound(begin, end, j);
  FLEXCAST_CHECK(found != end && *found == j);
  return found - columns_.begin();
}

void BlockMatrix::add_diagonal(const VecX& diagonal) {
  for (std::int32_t i = 0; i < rows(); ++i) blocks_[diagonals_[i]].diagonal() += block3(diagonal, i);
}

void BlockMatrix::hold(const VecX& free) {
  for (std::int32_t i = 0; i < rows(); ++i) {
    const Vec3 row_free = block3(free, i);
    for (std::int64_t k = starts_[i]; k < starts_[i + 1]; ++k) {
      const Vec3 column_free = block3(free, columns_[k]);
      if (row_free == Vec3::Ones() && column_free == Vec3::Ones()) continue;
      blocks_[k] = row_free.asDiagonal() * blocks_[k] * column_free.asDiagonal();
      if (columns_[k] == i) blocks_[k].diagonal() += Vec3::Ones() - row_free;
    }
  }
}

void BlockMatrix::multiply(const VecX& x, VecX& y) const {
  y.resize(x.size());
  for (std::int32_t i = 0; i < rows(); ++i) {
    Vec3 sum = Vec3::Zero();
    for (std::int64_t k = starts_[i]; k < starts_[i + 1]; ++k) sum += blocks_[k] * block3(x, columns_[k]);
    block3(y, i) = sum;
  }
}

}  // namespace flexcast
