#include "core/integrators/lanczos.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

namespace flexcast {
namespace {

// The largest eigenvalue must have had the time to show before a residual says that it did.
constexpr int least_iterations = 20, most_iterations = 60;

// Entries in -1..1 that no symmetry of a mesh has (a golden ratio sequence).
VecX make_start(Eigen::Index size) {
  VecX start(size);
  double fraction = 0.5;
  for (double& entry : start) {
    fraction += 0.6180339887498949;
    fraction -= std::floor(fraction);
    entry = 2.0 * fraction - 1.0;
  }
  return start;
}

struct Ritz {
  double largest = 0.0, size = 0.0, last_entry = 0.0;  // eigenvalue, largest magnitude, its vector's last entry
};

Ritz calc_ritz(const std::vector<double>& diagonal, const std::vector<double>& off_diagonal) {
  const auto n = static_cast<Eigen::Index>(diagonal.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::Map<const VecX>(diagonal.data(), n),
                                VecX(Eigen::Map<const VecX>(off_diagonal.data(), n - 1)));
  const double largest = solver.eigenvalues()[n - 1];
  return {largest, std::max(std::abs(solver.eigenvalues()[0]), largest), std::abs(solver.eigenvectors()(n - 1, n - 1))};
}

}  // namespace

double calc_largest_eigenvalue(const LanczosOperator& A) {
  if (A.size == 0) return 0.0;
  VecX q = make_start(A.size), last = VecX::Zero(A.size), y, dual;
  std::vector<double> diagonal, off_diagonal;
  // The vector of length 1 and its dual; the length it had.
  const auto normalize = [&](VecX& vector) {
    if (A.weigh) {
      A.weigh(vector, dual);
    } else {
      dual = vector;
    }
    const double norm = std::sqrt(std::max(0.0, vector.dot(dual)));
    if (norm > 0.0) vector /= norm, dual /= norm;
    return norm;
  };
  if (!(normalize(q) > 0.0)) return 0.0;
  for (int k = 1;; ++k) {
    A.apply(dual, y);
    diagonal.push_back(y.dot(dual));
    y -= diagonal.back() * q;
    if (k > 1) y -= off_diagonal.back() * last;
    last.swap(q);
    q.swap(y);
    const double norm = normalize(q);
    const Ritz ritz = calc_ritz(diagonal, off_diagonal);
    const double residual = norm * ritz.last_entry;
    const bool close = k >= least_iterations && residual <= 1e-3 * ritz.size;
    if (close || k == most_iterations || !(norm > 1e-12 * ritz.size)) return ritz.largest + residual + 1e-6 * ritz.size;
    off_diagonal.push_back(norm);
  }
}

}  // namespace flexcast
