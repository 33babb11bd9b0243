#include "core/materials/plain_lanes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "core/materials/corotational.h"
#include "core/materials/polar.h"

namespace flexcast {
namespace {

Mat3 read(const double* from, int stride) {
  Mat3 A;
  for (int k = 0; k < 9; ++k) A(k % 3, k / 3) = from[k * stride];
  return A;
}

void write(const Mat3& A, double* to, int stride) {
  for (int k = 0; k < 9; ++k) to[k * stride] = A(k % 3, k / 3);
}

}  // namespace

void calc_plain_rotation(const double* F, double* Q, int stride) {
  write(calc_rotation(read(F, stride)), Q, stride);
}

void calc_plain_twist(double mu, double lambda, bool clamped, const double* S, double* W, int stride) {
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(read(S, stride));
  Vec3 c;
  for (int k = 0; k < 3; ++k) c[k] = calc_twist(Lame{mu, lambda}, clamped, eigen.eigenvalues(), k);
  write(eigen.eigenvectors() * c.asDiagonal() * eigen.eigenvectors().transpose(), W, stride);
}

void calc_plain_stress(const Law& law, double mu, double lambda, const double* F, double* P, int stride) {
  const Mat3 gradient = read(F, stride);
  Mat3 stress;
  law.calc_stress({mu, lambda}, {&gradient, 1}, {&stress, 1});
  write(stress, P, stride);
}

double calc_plain_energy(const Law& law, double mu, double lambda, const double* F, int stride) {
  const Mat3 gradient = read(F, stride);
  double energy = 0.0;
  law.calc_energy({mu, lambda}, {&gradient, 1}, {&energy, 1});
  return energy;
}

}  // namespace flexcast
