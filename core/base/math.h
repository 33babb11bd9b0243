// The linear algebra types of the engine: double precision, SI units.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>  // cross products
#include <array>
#include <cstdint>

namespace flexcast {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Mat9 = Eigen::Matrix<double, 9, 9>;
using VecX = Eigen::VectorXd;  // per-particle vectors are flat: x0, y0, z0, x1, ...

using Tetrahedron = std::array<std::int32_t, 4>;
using Midsides = std::array<std::int32_t, 6>;  // nodes amid a tetrahedron's edges 01, 02, 03, 12, 13, 23
using Triangle = std::array<std::int32_t, 3>;
using Spring = std::array<std::int32_t, 2>;

// The particle's three entries of a flat per-particle vector.
inline auto block3(VecX& v, std::int64_t particle) {
  return v.segment<3>(3 * particle);
}
inline auto block3(const VecX& v, std::int64_t particle) {
  return v.segment<3>(3 * particle);
}

// A run of consecutive indices.
struct IndexRange {
  std::int32_t first = 0;
  std::int32_t count = 0;
  std::int32_t end() const { return first + count; }
};

}  // namespace flexcast
