#include "core/mesh/surface_load.h"

#include <algorithm>

#include "core/base/checks.h"
#include "core/mesh/topology.h"

namespace flexcast {
namespace {

struct LoadedFace {
  Triangle nodes;  // that carry it, a third each
  double area = 0.0;
};

Triangle make_corners(const Tetrahedron& tetrahedron, std::size_t face) {
  const auto& [a, b, c] = local_faces[face];
  return {tetrahedron[a], tetrahedron[b], tetrahedron[c]};
}

// The midside nodes of the edges whose ends are both on the face: those that do not meet the opposite vertex.
Triangle make_face_midsides(const Midsides& midsides, std::size_t face) {
  Triangle nodes{};
  std::size_t count = 0;
  for (std::size_t e = 0; e < local_edges.size(); ++e) {
    const auto [a, b] = local_edges[e];
    const int opposite = static_cast<int>(face);
    if (a != opposite && b != opposite) nodes[count++] = midsides[e];
  }
  return nodes;
}

double calc_area(const std::vector<Vec3>& nodes, const Triangle& corners) {
  const Vec3& origin = nodes[corners[0]];
  return 0.5 * (nodes[corners[1]] - origin).cross(nodes[corners[2]] - origin).norm();
}

}  // namespace

double spread_surface_force(std::span<const std::uint8_t> selected, const std::vector<Vec3>& nodes,
                            const std::vector<Tetrahedron>& tetrahedra, const std::vector<Midsides>& midsides,
                            const Vec3& force, std::vector<Vec3>& forces) {
  FLEXCAST_CHECK(midsides.empty() || midsides.size() == tetrahedra.size());
  std::vector<LoadedFace> faces;
  double area = 0.0;
  for (const auto& [element, face] : make_boundary_faces(tetrahedra)) {
    const Triangle corners = make_corners(tetrahedra[element], face);
    if (!std::all_of(corners.begin(), corners.end(), [&](std::int32_t node) { return selected[node] != 0; })) continue;
    const Triangle carriers = midsides.empty() ? corners : make_face_midsides(midsides[element], face);
    faces.push_back({carriers, calc_area(nodes, corners)});
    area += faces.back().area;
  }
  if (!(area > 0.0)) return 0.0;
  for (const LoadedFace& face : faces) {
    for (const std::int32_t node : face.nodes) forces[node] += face.area / area / 3.0 * force;
  }
  return area;
}

}  // namespace flexcast
