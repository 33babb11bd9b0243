#include "core/mesh/polygon.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace flexcast {
namespace {

Vec3 calc_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b - a).cross(c - a);
}

// Twice the vector area: the sum over any fan.
Vec3 calc_normal(const std::vector<Vec3>& outline) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) sum += calc_normal(outline[0], outline[i], outline[i + 1]);
  return sum;
}

// Whether every triangle of the fan about this corner looks the way the face does.
bool is_fan_upright(const std::vector<Vec3>& outline, const Vec3& normal, std::size_t corner) {
  const std::size_t count = outline.size();
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const Vec3 part = calc_normal(outline[corner], outline[(corner + i) % count], outline[(corner + i + 1) % count]);
    if (!(part.dot(normal) > 0.0)) return false;
  }
  return true;
}

// The corner about which a fan covers the face: the first if none of the first ones does, as in a face with several
// bays.
std::size_t find_fan_corner(const std::vector<Vec3>& outline) {
  constexpr std::size_t most_tried = 64;
  const Vec3 normal = calc_normal(outline);
  for (std::size_t corner = 0; corner < std::min(outline.size(), most_tried); ++corner) {
    if (is_fan_upright(outline, normal, corner)) return corner;
  }
  return 0;
}

}  // namespace

std::vector<Vec3> make_outline(const std::vector<Vec3>& nodes, Polygon polygon) {
  double largest = 0.0;
  for (const std::int32_t node : polygon) {
    largest = std::max(largest, nodes[static_cast<std::size_t>(node)].cwiseAbs().maxCoeff());
  }
  const int exponent = largest > 0.0 ? std::ilogb(largest) + 1 : 0;
  const auto scaled = [&](std::int32_t node) {
    return Vec3(nodes[static_cast<std::size_t>(node)].unaryExpr([&](double x) { return std::ldexp(x, -exponent); }));
  };
  const Vec3 origin = scaled(polygon[0]);
  std::vector<Vec3> outline;
  double size = 0.0;
  for (const std::int32_t node : polygon) {
    outline.push_back(scaled(node) - origin);
    size = std::max(size, outline.back().cwiseAbs().maxCoeff());
  }
  for (Vec3& point : outline) point /= size;  // no two nodes lie at one place
  return outline;
}

bool has_area(const std::vector<Vec3>& outline) {
  constexpr double rounding = 1e-12;
  return calc_normal(outline).norm() > rounding;
}

void append_triangles(Polygon polygon, const std::vector<Vec3>& outline, std::vector<Triangle>& triangles) {
  const std::size_t corner = find_fan_corner(outline);
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    triangles.push_back(
        {polygon[corner], polygon[(corner + i) % polygon.size()], polygon[(corner + i + 1) % polygon.size()]});
  }
}

}  // namespace flexcast
