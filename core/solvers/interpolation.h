// P: values at coarse nodes become values at fine ones, each a weighted mean of few parents; the same for x, y and z.
#pragma once

#include <vector>

#include "core/base/math.h"

namespace flexcast {

struct Interpolation {
  // By fine row: its parents and their weights.
  std::vector<std::int64_t> starts = {0};
  std::vector<std::int32_t> parents;
  std::vector<double> weights;
  // By coarse row: its children and their weights; P transposed.
  std::vector<std::int64_t> child_starts = {0};
  std::vector<std::int32_t> children;
  std::vector<double> child_weights;

  std::int64_t fine_count() const { return static_cast<std::int64_t>(starts.size()) - 1; }
  std::int64_t coarse_count() const { return static_cast<std::int64_t>(child_starts.size()) - 1; }

  // Fills the transposed half.
  void transpose(std::int64_t coarse_count);
  // coarse = P^T fine.
  void apply_transposed(const VecX& fine, VecX& coarse) const;
  // fine += P coarse.
  void add(const VecX& coarse, VecX& fine) const;
};

}  // namespace flexcast
