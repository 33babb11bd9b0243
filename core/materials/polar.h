// Polar decomposition F = Q S with Q a rotation (det Q = +1), S symmetric, for every finite F: also inverted, flat and
// collapsed ones. Q is the rotation nearest to F: it maximises tr(Q^T F).
// Source: N. J. Higham, Functions of Matrices, SIAM 2008, chapter 8.
#pragma once

#include "core/base/math.h"

namespace flexcast {

struct Polar {
  Mat3 Q;
  Mat3 S;  // Q^T F, symmetrised
};

// Relative accuracy of Q is that of the problem itself: rounding times s1 / (s2 + s3) of F's signed singular values.
// Where s2 + s3 = 0 the rotation is not unique and any nearest one is returned; F = 0 gives the identity.
Mat3 calc_rotation(const Mat3& F);
Polar calc_polar(const Mat3& F);

}  // namespace flexcast
