// Functions of 3 x 3 matrices that several laws need.
#pragma once

#include "core/base/math.h"

namespace flexcast {

// dJ/dF = cof F, J = det F, for every F: no division by J.
inline Mat3 calc_cofactor(const Mat3& F) {
  Mat3 cofactor;
  cofactor.col(0) = F.col(1).cross(F.col(2));
  cofactor.col(1) = F.col(2).cross(F.col(0));
  cofactor.col(2) = F.col(0).cross(F.col(1));
  return cofactor;
}

// [a], with [a] b = a x b.
inline Mat3 make_cross_matrix(const Vec3& a) {
  Mat3 cross;
  cross << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return cross;
}

}  // namespace flexcast
