// The tetrahedron of the one-element cases: E = 1.3e5 Pa, nu = 0.3, so mu = 5e4 and lambda = 7.5e4 exactly.
#pragma once

#include "tests/support/model.h"
#include "tests/support/reference.h"

namespace flexcast::test {

inline const Json& tet_vectors() {
  static const Json json = load_reference("tet_vectors.json");
  return json;
}

inline Points golden_points() {
  Points points;
  for (const Json& point : tet_vectors()["X"]) points.push_back(to_vector(point));
  return points;
}

inline Model make_golden_tet(std::string_view law) {
  return make_tet_model(golden_points(), {{0, 1, 2, 3}}, {.law = law});
}

inline constexpr double young = 1.3e5;  // Pa; lengths are about 1 m, so this is also E L^2 in N and E L^3 in J

inline Vec3 calc_sum(const VecX& forces) {
  Vec3 sum = Vec3::Zero();
  for (std::int64_t i = 0; i < forces.size() / 3; ++i) sum += block3(forces, i);
  return sum;
}

inline Vec3 calc_torque(const VecX& positions, const VecX& forces) {
  Vec3 torque = Vec3::Zero();
  for (std::int64_t i = 0; i < forces.size() / 3; ++i) torque += block3(positions, i).cross(block3(forces, i));
  return torque;
}

}  // namespace flexcast::test
