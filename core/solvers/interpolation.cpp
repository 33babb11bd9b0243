#include "core/solvers/interpolation.h"

#include "core/base/parallel.h"

namespace flexcast {
namespace {

constexpr std::int64_t grain = 1024;  // rows

}  // namespace

void Interpolation::transpose(std::int64_t count) {
  child_starts.assign(static_cast<std::size_t>(count) + 1, 0);
  for (const std::int32_t parent : parents) ++child_starts[static_cast<std::size_t>(parent) + 1];
  for (std::size_t c = 0; c < static_cast<std::size_t>(count); ++c) child_starts[c + 1] += child_starts[c];
  children.resize(parents.size());
  child_weights.resize(parents.size());
  std::vector<std::int64_t> next = child_starts;
  for (std::size_t i = 0; i + 1 < starts.size(); ++i) {
    for (std::int64_t k = starts[i]; k < starts[i + 1]; ++k) {
      const std::int64_t to = next[static_cast<std::size_t>(parents[k])]++;
      children[to] = static_cast<std::int32_t>(i);
      child_weights[to] = weights[k];
    }
  }
}

void Interpolation::apply_transposed(const VecX& fine, VecX& coarse) const {
  coarse.resize(3 * coarse_count());
  parallel_for(coarse_count(), grain, [&](std::int64_t first, std::int64_t end) {
    for (std::int64_t c = first; c < end; ++c) {
      Vec3 sum = Vec3::Zero();
      for (std::int64_t k = child_starts[c]; k < child_starts[c + 1]; ++k) {
        sum += child_weights[k] * block3(fine, children[k]);
      }
      block3(coarse, c) = sum;
    }
  });
}

void Interpolation::add(const VecX& coarse, VecX& fine) const {
  parallel_for(fine_count(), grain, [&](std::int64_t first, std::int64_t end) {
    for (std::int64_t i = first; i < end; ++i) {
      Vec3 sum = block3(fine, i);
      for (std::int64_t k = starts[i]; k < starts[i + 1]; ++k) sum += weights[k] * block3(coarse, parents[k]);
      block3(fine, i) = sum;
    }
  });
}

}  // namespace flexcast
