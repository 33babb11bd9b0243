// Sums of rows of a patch (patches.h), in lanes.
#pragma once

#include <cstdint>

namespace flexcast {

// For each slot the sum of its rows added minus those subtracted: sums [slot][3], counts [slot][2] of the numbers in
// `list`, rows of four doubles.
void gather_rows(std::int32_t slots, const std::uint16_t* counts, const std::uint16_t* list, const double* rows,
                 double* sums);

// The 3 x 3 blocks of a matrix += sums of rows: see matrix_gather.h.
void gather_blocks(std::int32_t blocks, const std::int32_t* places, const std::uint16_t* counts,
                   const std::uint16_t* list, const double* entries, const double* lasts, double* values);

}  // namespace flexcast
