// How the stiffness blocks of a patch's elements add up to blocks of a matrix. A kernel writes the blocks of node pairs
// a <= b of its elements as rows; each block of the matrix that the patch touches gathers its rows and is written once,
// with its mirror image.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/block_matrix.h"
#include "core/forces/patches.h"

namespace flexcast {

// Rows of nine doubles, column by column: the first eight at entries + 8 row, the ninth at lasts + row. Row number
// ((batch * pairs) + pair) * lanes + lane, pairs in the order 00, 01, ..., 0n, 11, ...
struct BlockRows9 {
  double* entries = nullptr;
  double* lasts = nullptr;
};

class MatrixGather {
 public:
  // `nodes`: particles of an element, nodes_per_element each. Matrices of A's pattern.
  MatrixGather(const Patches& patches, std::span<const std::int32_t> nodes, int nodes_per_element,
               const BlockMatrix& A);

  std::uint64_t pattern_id() const { return pattern_id_; }
  // Of this thread, for any patch; kept for the next.
  BlockRows9 scratch() const;
  // values: of a matrix of the pattern.
  void add(std::size_t patch, const BlockRows9& rows, double* values) const;

 private:
  struct Part {
    std::int64_t first_block = 0, first_row = 0;
    std::int32_t blocks = 0;
  };
  std::uint64_t pattern_id_ = 0;
  std::size_t most_rows_ = 0;
  std::vector<Part> parts_;            // per patch
  std::vector<std::int32_t> places_;   // [block][2] in the matrix: on or above the diagonal, and the mirror image or -1
  std::vector<std::uint16_t> counts_;  // [block][2]: of rows as they are, and of rows to be transposed
  std::vector<std::uint16_t> rows_;
};

}  // namespace flexcast
