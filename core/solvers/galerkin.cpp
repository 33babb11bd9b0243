#include "core/solvers/galerkin.h"

#include <algorithm>

#include "core/base/parallel.h"
#include "core/solvers/galerkin_kernel.h"

namespace flexcast {
namespace {

constexpr std::int64_t most_slabs = 32;
constexpr std::int64_t least_rows = 256;  // of a slab

}  // namespace

GalerkinProduct::GalerkinProduct(const BlockMatrix& A, const Interpolation& P)
    : P_(P), coarse_rows_(static_cast<std::int32_t>(P.coarse_count())) {
  std::vector<std::int32_t> marked(static_cast<std::size_t>(coarse_rows_), -1);
  for (std::int32_t c = 0; c < coarse_rows_; ++c) {
    for (std::int64_t n = P.child_starts[c]; n < P.child_starts[c + 1]; ++n) {
      for (const std::int32_t j : A.columns(P.children[n])) {
        for (std::int64_t q = P.starts[j]; q < P.starts[j + 1]; ++q) {
          const std::int32_t to = P.parents[q];
          if (to <= c || marked[to] == c) continue;
          marked[to] = c;
          coarse_pairs_.emplace_back(c, to);
        }
      }
    }
  }
}

void GalerkinProduct::make_maps(const BlockMatrix& A, const BlockMatrix& coarse) {
  coarse_pairs_ = {};
  const auto rows = static_cast<std::size_t>(A.rows());
  slot_counts_.assign(rows, 0);
  slot_starts_.assign(rows, 0);
  target_starts_.assign(rows, 0);
  std::size_t slot_total = 0;
  for (std::int32_t i = 0; i < A.rows(); ++i) {
    if (P_.starts[i] == P_.starts[i + 1]) continue;
    for (const std::int32_t j : A.columns(i)) slot_total += static_cast<std::size_t>(P_.starts[j + 1] - P_.starts[j]);
  }
  slots_.reserve(slot_total);
  own_slots_.assign(P_.parents.size(), 0);
  std::vector<std::int32_t> nodes;
  for (std::int32_t i = 0; i < A.rows(); ++i) {
    slot_starts_[i] = static_cast<std::int64_t>(slots_.size());
    target_starts_[i] = static_cast<std::int64_t>(targets_.size());
    if (P_.starts[i] == P_.starts[i + 1]) continue;
    nodes.clear();
    for (const std::int32_t j : A.columns(i)) {
      for (std::int64_t q = P_.starts[j]; q < P_.starts[j + 1]; ++q) nodes.push_back(P_.parents[q]);
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    slot_counts_[i] = static_cast<std::int32_t>(nodes.size());
    most_slots_ = std::max(most_slots_, slot_counts_[i]);
    for (const std::int32_t j : A.columns(i)) {
      for (std::int64_t q = P_.starts[j]; q < P_.starts[j + 1]; ++q) {
        const auto at = std::lower_bound(nodes.begin(), nodes.end(), P_.parents[q]) - nodes.begin();
        slots_.push_back(static_cast<std::uint16_t>(at));
      }
    }
    for (std::int64_t p = P_.starts[i]; p < P_.starts[i + 1]; ++p) {
      const auto own = std::lower_bound(nodes.begin(), nodes.end(), P_.parents[p]);
      own_slots_[static_cast<std::size_t>(p)] = static_cast<std::uint16_t>(own - nodes.begin());
      for (auto node = own; node != nodes.end(); ++node) {
        targets_.push_back(static_cast<std::int32_t>(coarse.find(P_.parents[p], *node)));
      }
    }
  }
  targets_.shrink_to_fit();
  mirrors_.reserve(static_cast<std::size_t>(coarse.block_count() - coarse.rows()) / 2);
  mirror_starts_.assign(1, 0);
  for (std::int32_t c = 0; c < coarse.rows(); ++c) {
    for (const std::int32_t d : coarse.columns(c)) {
      if (d < c) mirrors_.push_back(static_cast<std::int32_t>(coarse.find(d, c)));
    }
    mirror_starts_.push_back(static_cast<std::int64_t>(mirrors_.size()));
  }
  make_slabs();
}

// Slabs of which every other one shares no coarse row: as many as that allows.
void GalerkinProduct::make_slabs() {
  const std::int64_t rows = P_.fine_count();
  const auto first_parent = [&](std::int32_t i) {
    return P_.starts[i] == P_.starts[i + 1] ? -1 : P_.parents[static_cast<std::size_t>(P_.starts[i])];
  };
  order_.resize(static_cast<std::size_t>(rows));
  for (std::int64_t i = 0; i < rows; ++i) order_[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(i);
  std::stable_sort(order_.begin(), order_.end(),
                   [&](std::int32_t a, std::int32_t b) { return first_parent(a) < first_parent(b); });
  std::int64_t count = std::clamp<std::int64_t>(rows / least_rows, 1, most_slabs);
  for (bool apart = false; !apart; count /= 2) {
    slab_starts_.clear();
    for (std::int64_t s = 0; s <= count; ++s) slab_starts_.push_back(s * rows / count);
    std::vector<std::int32_t> low(static_cast<std::size_t>(count), coarse_rows_);
    std::vector<std::int32_t> high(static_cast<std::size_t>(count), -1);
    for (std::int64_t s = 0; s < count; ++s) {
      for (std::int64_t n = slab_starts_[s]; n < slab_starts_[s + 1]; ++n) {
        const std::int32_t i = order_[n];
        for (std::int64_t p = P_.starts[i]; p < P_.starts[i + 1]; ++p) {
          low[s] = std::min(low[s], P_.parents[p]);
          high[s] = std::max(high[s], P_.parents[p]);
        }
      }
    }
    apart = true;
    for (std::int64_t s = 0; s + 2 < count; ++s) apart = apart && high[s] < low[s + 2];
  }
  // Within a slab in the order of the matrix: that is how memory likes to be read.
  for (std::size_t s = 0; s + 1 < slab_starts_.size(); ++s) {
    std::sort(order_.begin() + slab_starts_[s], order_.begin() + slab_starts_[s + 1]);
  }
  scratch_.assign(slab_starts_.size() - 1, std::vector<double>(12 * static_cast<std::size_t>(most_slots_)));
}

void GalerkinProduct::calc(const BlockMatrix& A, BlockMatrix& coarse) {
  coarse.set_zero();
  const GalerkinMaps maps{P_.starts.data(),    P_.parents.data(),     P_.weights.data(), slot_counts_.data(),
                          slot_starts_.data(), target_starts_.data(), slots_.data(),     own_slots_.data(),
                          targets_.data(),     order_.data()};
  const BlockRows rows = A.block_rows();
  const auto slabs = static_cast<std::int64_t>(scratch_.size());
  for (const std::int64_t parity : {0, 1}) {
    parallel_for((slabs + 1 - parity) / 2, 1, [&](std::int64_t first, std::int64_t end) {
      for (std::int64_t k = first; k < end; ++k) {
        const std::int64_t s = 2 * k + parity;
        add_galerkin_rows(rows, maps, slab_starts_[s], slab_starts_[s + 1], scratch_[s].data(), coarse.values());
      }
    });
  }
  parallel_for(coarse.rows(), least_rows, [&](std::int64_t first, std::int64_t end) {
    for (std::int64_t c = first; c < end; ++c) {
      double* block = coarse.value(coarse.start(static_cast<std::int32_t>(c)));
      for (std::int64_t k = mirror_starts_[c]; k < mirror_starts_[c + 1]; ++k, block += 9) {
        const double* other = coarse.value(mirrors_[k]);
        for (int m = 0; m < 9; ++m) block[m] = other[3 * (m % 3) + m / 3];
      }
    }
  });
}

}  // namespace flexcast
