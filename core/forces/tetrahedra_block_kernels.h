// The loops of vertex block descent over the elements that meet at particles, a lane a particle (block_groups.h).
#pragma once

#include "core/forces/block_groups.h"
#include "core/forces/tetrahedra_kernels.h"

namespace flexcast {

// Elements in rows, their nodes permuted so that the lane's particle is node 1, or node 4 in groups of kind 1.
struct ElementRows {
  bool quadratic = false;
  const std::int32_t* nodes = nullptr;  // [row][other node][lane], of the world
  const double* rest = nullptr;  // [row][10][lane]: entries of the inverse edges, column by column (1/m), and the
                                 // rest volume of a quadrature point (m^3), 0: no element
};

// f[3 place] -= sum w P g, K[9 place] += sum w g . dP/dF . g with g the gradient of the particle's shape function. The
// law has code in lanes. Exact tangents, but for corotational-inl.h's.
void add_element_blocks(const ElementRows& elements, const BlockGroup* groups, std::int64_t count,
                        const ElementLaw& law, const double* x, double* f, double* K);
// The same for damping, with the blocks times `scale`.
void add_element_damping_blocks(const ElementRows& elements, const BlockGroup* groups, std::int64_t count,
                                const ElementLaw& law, double scale, const double* x, const double* v, double* f,
                                double* K);

}  // namespace flexcast
