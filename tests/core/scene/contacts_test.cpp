// [[contact]]: what the file says is what the model's obstacles are.
#include "tests/core/scene/scene_text.h"

namespace flexcast::test {
namespace {

Obstacle obstacle(const std::string& lines) {
  const Scene scene = loaded(with_spring_lines("[[contact]]\nname = \"it\"\n" + lines));
  const auto& obstacles = scene.simulation->model().obstacles;
  EXPECT_EQ(obstacles.size(), 1u);
  return obstacles.empty() ? Obstacle{} : obstacles[0];
}

TEST(Contact, PlaneHasPointAndNormal) {
  const Obstacle plane = obstacle("shape = \"plane\"\npoint = [1, 2, 3]\nnormal = [0, 0, 2]\n");
  EXPECT_EQ(plane.name, "it");
  EXPECT_EQ(plane.shape, Obstacle::Shape::plane);
  EXPECT_EQ(plane.point, Vec3(1, 2, 3));
  EXPECT_EQ(plane.normal, Vec3(0, 0, 2));
}

TEST(Contact, SphereHasCenterAndRadius) {
  const Obstacle sphere = obstacle("shape = \"sphere\"\ncenter = [1, 2, 9]\nradius = 0.5\n");
  EXPECT_EQ(sphere.shape, Obstacle::Shape::sphere);
  EXPECT_EQ(sphere.center, Vec3(1, 2, 9));
  EXPECT_EQ(sphere.radius, 0.5);
}

TEST(Contact, BoxHasTwoCorners) {
  const Obstacle box = obstacle("shape = \"box\"\nlo = [5, 5, 5]\nhi = [6, 7, 8]\n");
  EXPECT_EQ(box.shape, Obstacle::Shape::box);
  EXPECT_EQ(box.lo, Vec3(5, 5, 5));
  EXPECT_EQ(box.hi, Vec3(6, 7, 8));
}

TEST(Contact, IsSmoothAndAsStiffAsTheEngineLikesUnlessToldOtherwise) {
  const std::string plane = "shape = \"plane\"\npoint = [0, 0, -1]\nnormal = [0, 0, 1]\n";
  EXPECT_EQ(obstacle(plane).friction, 0.0);
  EXPECT_EQ(obstacle(plane).stiffness, 0.0);
  const Obstacle told = obstacle(plane + "friction = 0.25\nstiffness = 1e4\n");
  EXPECT_EQ(told.friction, 0.25);
  EXPECT_EQ(told.stiffness, 1e4);
}

TEST(Contact, SeveralKeepTheirOrder) {
  const Scene scene = loaded(
      with_spring_lines("[[contact]]\nname = \"b\"\nshape = \"sphere\"\ncenter = [9, 0, 0]\nradius = 1.0\n"
                        "[[contact]]\nname = \"a\"\nshape = \"plane\"\npoint = [0, 0, -1]\nnormal = [0, 0, 1]\n"));
  const auto& obstacles = scene.simulation->model().obstacles;
  ASSERT_EQ(obstacles.size(), 2u);
  EXPECT_EQ(obstacles[0].name, "b");
  EXPECT_EQ(obstacles[1].name, "a");
}

}  // namespace
}  // namespace flexcast::test
