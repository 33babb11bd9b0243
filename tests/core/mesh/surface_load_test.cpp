#include "core/mesh/surface_load.h"

#include <gtest/gtest.h>

#include "core/mesh/generators.h"
#include "core/mesh/quadratic.h"

namespace flexcast {
namespace {

const Vec3 force(1.0, -2.0, 5.0);

struct Loaded {
  double area;
  std::vector<Vec3> forces;
};

// Loads what lies at x = 2 of a beam of 2 m x 1 m x 0.5 m.
template <class Select>
Loaded load(const Mesh& mesh, const std::vector<Midsides>& midsides, Select select) {
  std::vector<std::uint8_t> selected;
  for (const Vec3& X : mesh.nodes) selected.push_back(select(X) ? 1 : 0);
  Loaded loaded{0.0, std::vector<Vec3>(mesh.nodes.size(), Vec3::Zero())};
  loaded.area = spread_surface_force(selected, mesh.nodes, mesh.tetrahedra, midsides, force, loaded.forces);
  return loaded;
}
bool is_at_end(const Vec3& X) {
  return X.x() == 2.0;
}

void expect_uniform(const Mesh& mesh, const Loaded& loaded) {
  EXPECT_NEAR(loaded.area, 0.5, 1e-14);
  Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    sum += loaded.forces[i];
    torque += mesh.nodes[i].cross(loaded.forces[i]);
    EXPECT_TRUE(is_at_end(mesh.nodes[i]) || loaded.forces[i] == Vec3::Zero());
  }
  EXPECT_LE((sum - force).norm(), 1e-14 * force.norm());
  // It acts at the centroid of the face.
  EXPECT_LE((torque - Vec3(2.0, 0.5, 0.25).cross(force)).norm(), 1e-13 * force.norm());
}

TEST(SurfaceLoad, SumsUpToTheForceAtTheCentroidOfTheFaces) {
  Mesh mesh = make_beam({2, 3, 2}, {2.0, 1.0, 0.5});
  expect_uniform(mesh, load(mesh, {}, is_at_end));
  const auto midsides = make_quadratic(mesh);
  expect_uniform(mesh, load(mesh, midsides, is_at_end));
}

TEST(SurfaceLoad, ALinearFaceGivesAThirdToEachCornerAQuadraticOneToEachMidsideNode) {
  Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {}, {}};
  const auto is_below = [](const Vec3& X) { return X.z() == 0.0; };
  const Loaded linear = load(mesh, {}, is_below);
  EXPECT_EQ(linear.area, 0.5);
  for (int a = 0; a < 3; ++a) EXPECT_LE((linear.forces[a] - force / 3.0).norm(), 1e-15);
  EXPECT_EQ(linear.forces[3], Vec3::Zero());

  const auto midsides = make_quadratic(mesh);
  const Loaded quadratic = load(mesh, midsides, is_below);
  EXPECT_EQ(quadratic.area, 0.5);
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const bool carries = i >= 4 && is_below(mesh.nodes[i]);
    EXPECT_LE((quadratic.forces[i] - (carries ? Vec3(force / 3.0) : Vec3::Zero())).norm(), 1e-15);
  }
}

TEST(SurfaceLoad, WithoutAFaceOfSelectedCornersNothingIsAdded) {
  Mesh mesh = make_beam({2, 1, 1}, {2.0, 1.0, 0.5});
  const auto is_edge = [](const Vec3& X) { return X.x() == 2.0 && X.y() == 0.0; };
  // The plane x = 1 is inside: its faces belong to two tetrahedra.
  const auto is_inside = [](const Vec3& X) { return X.x() == 1.0; };
  for (const Loaded& loaded : {load(mesh, {}, is_edge), load(mesh, {}, is_inside)}) {
    EXPECT_EQ(loaded.area, 0.0);
    for (const Vec3& nodal : loaded.forces) EXPECT_EQ(nodal, Vec3::Zero());
  }
}

}  // namespace
}  // namespace flexcast
