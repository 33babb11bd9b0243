// The loops of vertex block descent over the springs that meet at particles, a lane a particle (block_groups.h).
#pragma once

#include "core/forces/block_groups.h"

namespace flexcast {

struct SpringRows {
  const std::int32_t* others = nullptr;  // [row][lane], the other end, of the world
  const double* rest = nullptr;          // [row][2][lane]: rest length (m) and its inverse (1/m), 0: no spring
};

// f[3 place] += elastic forces, K[9 place] += the positive semidefinite tangents of spring.h. k_s in N.
void add_spring_blocks(const SpringRows& springs, const BlockGroup* groups, std::int64_t count, double k_s,
                       const double* x, double* f, double* K);
// The same for damping, with the blocks times `scale`. k_d in N.s.
void add_spring_damping_blocks(const SpringRows& springs, const BlockGroup* groups, std::int64_t count, double k_d,
                               double scale, const double* x, const double* v, double* f, double* K);

}  // namespace flexcast
