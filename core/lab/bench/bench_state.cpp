#include "core/lab/bench/bench_state.h"

#include <algorithm>
#include <cmath>

namespace flexcast {
namespace {

constexpr double bend_rate = 0.5;        // rad/m
constexpr double twist_rate = 0.3;       // rad/m
constexpr double most_strain = 0.2;      // that either may cause
constexpr double noise_fraction = 0.02;  // of the spacing

// Of the rest shape, m: the mean length of springs; of tetrahedra the side of a cube that holds six of them.
double calc_spacing(const Model& model, const Body& body) {
  const VecX& X = model.rest_positions;
  double sum = 0.0;
  for (std::int32_t s = body.springs.first; s < body.springs.end(); ++s) {
    const auto [p, q] = model.springs[static_cast<std::size_t>(s)];
    sum += (block3(X, q) - block3(X, p)).norm();
  }
  if (body.springs.count > 0) return sum / body.springs.count;
  for (std::int32_t t = body.tetrahedra.first; t < body.tetrahedra.end(); ++t) {
    const auto [a, b, c, d] = model.tetrahedra[static_cast<std::size_t>(t)];
    const Vec3 x0 = block3(X, a);
    sum += (block3(X, b) - x0).dot((block3(X, c) - x0).cross(block3(X, d) - x0));
  }
  return body.tetrahedra.count > 0 ? std::cbrt(sum / body.tetrahedra.count) : 0.0;
}

void bend_and_twist(const Model& model, const Body& body, VecX& x) {
  const Eigen::Map<const Eigen::Matrix3Xd> rest(model.rest_positions.data() + 3 * body.particles.first, 3,
                                                body.particles.count);
  const Vec3 lo = rest.rowwise().minCoeff(), size = rest.rowwise().maxCoeff() - lo, center = lo + 0.5 * size;
  std::array<Eigen::Index, 3> axes = {0, 1, 2};  // from the longest side to the shortest
  std::stable_sort(axes.begin(), axes.end(), [&](Eigen::Index a, Eigen::Index b) { return size[a] > size[b]; });
  const auto [along, across, up] = axes;
  const double radius = 1.0 / std::min(bend_rate, most_strain / (0.5 * size[up]));
  const double twist = std::min(twist_rate, most_strain / (0.5 * size[across]));
  for (std::int32_t i = body.particles.first; i < body.particles.end(); ++i) {
    const Vec3 X = block3(model.rest_positions, i);
    const double s = X[along] - lo[along], y = X[across] - center[across], z = X[up] - center[up];
    const double turn = twist * s, angle = s / radius;
    const double turned_y = std::cos(turn) * y - std::sin(turn) * z;
    const double arm = radius - (std::sin(turn) * y + std::cos(turn) * z);
    x[3 * i + along] = lo[along] + arm * std::sin(angle);
    x[3 * i + across] = center[across] + turned_y;
    x[3 * i + up] = center[up] + radius - arm * std::cos(angle);
  }
}

}  // namespace

// SplitMix64 (Steele, Lea, Flood, OOPSLA 2014).
VecX make_scattered(std::int64_t count) {
  VecX values(count);
  std::uint64_t state = 0;
  for (double& value : values) {
    state += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    z ^= z >> 31;
    value = 2.0 * static_cast<double>(z >> 11) * 0x1p-53 - 1.0;
  }
  return values;
}

VecX make_deformed_positions(const Model& model) {
  VecX x = model.rest_positions;
  const VecX noise = make_scattered(x.size());
  for (const Body& body : model.bodies) {
    if (body.is_fem()) bend_and_twist(model, body, x);
    const Eigen::Index first = 3 * body.particles.first, count = 3 * body.particles.count;
    x.segment(first, count) += noise_fraction * calc_spacing(model, body) * noise.segment(first, count);
  }
  return x;
}

}  // namespace flexcast
