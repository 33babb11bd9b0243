#include "core/lab/trade/trade_volume.h"

namespace flexcast {
namespace {

using Barycentric = std::array<double, 4>;
constexpr std::array<std::array<int, 2>, 6> edges = {{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

double calc_linear(const VecX& x, const Tetrahedron& t) {
  const Vec3 a = block3(x, t[1]) - block3(x, t[0]), b = block3(x, t[2]) - block3(x, t[0]),
             c = block3(x, t[3]) - block3(x, t[0]);
  return a.dot(b.cross(c)) / 6.0;
}

// The derivative of the quadratic map by the barycentric coordinates 1 to 3, the first following from them.
Mat3 calc_jacobian(const VecX& x, const Tetrahedron& corners, const Midsides& midsides, const Barycentric& l) {
  Eigen::Matrix<double, 3, 4> by_all = Eigen::Matrix<double, 3, 4>::Zero();
  for (int i = 0; i < 4; ++i) by_all.col(i) = (4.0 * l[i] - 1.0) * block3(x, corners[i]);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [i, j] = edges[e];
    by_all.col(i) += 4.0 * l[j] * block3(x, midsides[e]);
    by_all.col(j) += 4.0 * l[i] * block3(x, midsides[e]);
  }
  return by_all.rightCols<3>().colwise() - by_all.col(0);
}

// The determinant is of third degree, for which five points are enough (P. Keast, Comput. Methods Appl. Mech. Eng. 55
// (1986) 339-348).
double calc_quadratic(const VecX& x, const Tetrahedron& corners, const Midsides& midsides) {
  const auto det = [&](const Barycentric& l) { return calc_jacobian(x, corners, midsides, l).determinant(); };
  double sum = -0.8 * det({0.25, 0.25, 0.25, 0.25});
  for (std::size_t i = 0; i < 4; ++i) {
    Barycentric l = {1.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0};
    l[i] = 0.5;
    sum += 0.45 * det(l);
  }
  return sum / 6.0;
}

}  // namespace

double calc_volume(const Model& model, const Body& body, const VecX& positions) {
  double volume = 0.0;
  for (std::int32_t i = 0; i < body.tetrahedra.count; ++i) {
    const Tetrahedron& corners = model.tetrahedra[static_cast<std::size_t>(body.tetrahedra.first + i)];
    volume += body.is_quadratic() ? calc_quadratic(positions, corners,
                                                   model.midsides[static_cast<std::size_t>(body.midsides.first + i)])
                                  : calc_linear(positions, corners);
  }
  return volume;
}

VecX calc_volumes(const Model& model, const VecX& positions) {
  VecX volumes(static_cast<Eigen::Index>(model.bodies.size()));
  for (Eigen::Index i = 0; i < volumes.size(); ++i)
    volumes[i] = calc_volume(model, model.bodies[static_cast<std::size_t>(i)], positions);
  return volumes;
}

}  // namespace flexcast
