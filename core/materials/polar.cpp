#include "core/materials/polar.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

#include "core/materials/tensors.h"

namespace flexcast {
namespace {

// Signed SVD: the sign comes from the factors, not from det F, whose rounding is arbitrary where F is flat.
Mat3 calc_rotation_by_svd(const Mat3& F) {
  const Eigen::JacobiSVD<Mat3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 U = svd.matrixU();
  if (U.determinant() * svd.matrixV().determinant() < 0.0) U.col(2) = -U.col(2);
  return U * svd.matrixV().transpose();
}

// Newton's iteration X <- (X + X^-T) / 2 squares the error of each singular value. It is taken for well conditioned F
// with det F > 0, where it ends after four to seven rounds; 0 rounds left means it did not.
bool iterate_newton(Mat3& X) {
  for (int round = 0; round < 10; ++round) {
    const Mat3 cofactor = calc_cofactor(X);
    const double determinant = X.col(0).dot(cofactor.col(0));
    const Mat3 next = 0.5 * (X + cofactor / determinant);
    const double change = (next - X).squaredNorm();
    X = next;
    if (change < 1e-17) return true;  // the next change would be of the order of this one squared
  }
  return false;
}

}  // namespace

Mat3 calc_rotation(const Mat3& F) {
  const double largest = F.cwiseAbs().maxCoeff();
  if (!(largest > 0.0) || !std::isfinite(largest)) return Mat3::Identity();
  // A power of two: Q(2^k F) = Q(F) to the last bit.
  const int exponent = std::ilogb(largest);
  const Mat3 scaled = F.unaryExpr([exponent](double value) { return std::ldexp(value, -exponent); });

  const double mean = scaled.squaredNorm() / 3.0;
  if (scaled.determinant() > 0.1 * mean * std::sqrt(mean)) {
    Mat3 X = scaled / std::sqrt(mean);
    if (iterate_newton(X)) return X;
  }
  return calc_rotation_by_svd(scaled);
}

Polar calc_polar(const Mat3& F) {
  const Mat3 Q = calc_rotation(F);
  const Mat3 S = Q.transpose() * F;
  return {Q, 0.5 * (S + S.transpose())};
}

}  // namespace flexcast
