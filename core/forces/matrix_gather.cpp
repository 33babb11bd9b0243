#include "core/forces/matrix_gather.h"

#include <algorithm>

#include "core/base/checks.h"
#include "core/forces/patch_kernels.h"

namespace flexcast {

MatrixGather::MatrixGather(const Patches& patches, std::span<const std::int32_t> nodes, int nodes_per_element,
                           const BlockMatrix& A)
    : pattern_id_(A.pattern_id()) {
  FLEXCAST_CHECK(A.block_count() < (std::int64_t{1} << 31));
  const auto n = static_cast<std::size_t>(nodes_per_element);
  const std::size_t pairs = n * (n + 1) / 2, lanes = Patches::lanes;
  struct Term {
    std::uint64_t key = 0;  // place, then whether transposed, then row
    std::int32_t mirror = -1;
  };
  std::vector<Term> terms;
  for (const Patch& patch : patches.patches()) {
    terms.clear();
    for (std::size_t k = 0; k < static_cast<std::size_t>(patch.batches) * lanes; ++k) {
      const std::int32_t e = patches.elements()[static_cast<std::size_t>(patch.first_batch) * lanes + k];
      if (e < 0) continue;
      const auto mine = nodes.subspan(static_cast<std::size_t>(e) * n, n);
      std::size_t row = k / lanes * pairs * lanes + k % lanes;
      for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = a; b < n; ++b, row += lanes) {
          const bool transposed = mine[a] > mine[b];
          const auto [i, j] = std::minmax(mine[a], mine[b]);
          const auto place = static_cast<std::uint64_t>(A.find(i, j));
          terms.push_back({place << 17 | static_cast<std::uint64_t>(transposed) << 16 | row,
                           i == j ? -1 : static_cast<std::int32_t>(A.find(j, i))});
        }
      }
    }
    most_rows_ = std::max(most_rows_, static_cast<std::size_t>(patch.batches) * pairs * lanes);
    std::sort(terms.begin(), terms.end(), [](const Term& one, const Term& other) { return one.key < other.key; });
    Part part{static_cast<std::int64_t>(counts_.size()) / 2, static_cast<std::int64_t>(rows_.size()), 0};
    for (std::size_t k = 0; k < terms.size(); ++k) {
      const auto place = static_cast<std::int32_t>(terms[k].key >> 17);
      if (k == 0 || place != static_cast<std::int32_t>(terms[k - 1].key >> 17)) {
        places_.insert(places_.end(), {place, terms[k].mirror});
        counts_.insert(counts_.end(), {0, 0});
        ++part.blocks;
      }
      ++*(counts_.end() - ((terms[k].key >> 16 & 1) != 0 ? 1 : 2));
      rows_.push_back(static_cast<std::uint16_t>(terms[k].key & 0xffff));
    }
    parts_.push_back(part);
  }
  FLEXCAST_CHECK(most_rows_ <= 65536);
  places_.shrink_to_fit();
  counts_.shrink_to_fit();
  rows_.shrink_to_fit();
}

BlockRows9 MatrixGather::scratch() const {
  thread_local AlignedVector<double> values;
  if (values.size() < 9 * most_rows_) values.resize(9 * most_rows_);
  return {values.data(), values.data() + 8 * most_rows_};
}

void MatrixGather::add(std::size_t patch, const BlockRows9& rows, double* values) const {
  const Part& part = parts_[patch];
  gather_blocks(part.blocks, places_.data() + 2 * part.first_block, counts_.data() + 2 * part.first_block,
                rows_.data() + part.first_row, rows.entries, rows.lasts, values);
}

}  // namespace flexcast
