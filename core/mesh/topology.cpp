#include "core/mesh/topology.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <tuple>

namespace flexcast {
namespace {

struct CornerFace {
  Triangle sorted;     // what makes two faces the same
  std::size_t number;  // 4 * element + face of the element

  friend bool operator<(const CornerFace& a, const CornerFace& b) {
    return std::tie(a.sorted, a.number) < std::tie(b.sorted, b.number);
  }
};

Triangle make_face(const Tetrahedron& tetrahedron, std::size_t face) {
  const auto& [a, b, c] = local_faces[face];
  return {tetrahedron[a], tetrahedron[b], tetrahedron[c]};
}

std::vector<CornerFace> make_sorted_faces(const std::vector<Tetrahedron>& tetrahedra) {
  std::vector<CornerFace> faces;
  faces.reserve(4 * tetrahedra.size());
  for (std::size_t element = 0; element < tetrahedra.size(); ++element) {
    for (std::size_t face = 0; face < 4; ++face) {
      Triangle sorted = make_face(tetrahedra[element], face);
      std::sort(sorted.begin(), sorted.end());
      faces.push_back({sorted, 4 * element + face});
    }
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

}  // namespace

std::vector<BoundaryFace> make_boundary_faces(const std::vector<Tetrahedron>& tetrahedra) {
  const std::vector<CornerFace> faces = make_sorted_faces(tetrahedra);
  std::vector<std::size_t> outer;
  for (std::size_t first = 0; first < faces.size();) {
    std::size_t end = first + 1;
    while (end < faces.size() && faces[end].sorted == faces[first].sorted) ++end;
    if (end == first + 1) outer.push_back(faces[first].number);
    first = end;
  }
  std::sort(outer.begin(), outer.end());

  std::vector<BoundaryFace> boundary;
  boundary.reserve(outer.size());
  for (const std::size_t number : outer) boundary.push_back({number / 4, number % 4});
  return boundary;
}

std::vector<Triangle> make_boundary_triangles(const std::vector<Tetrahedron>& tetrahedra) {
  std::vector<Triangle> triangles;
  for (const auto& [element, face] : make_boundary_faces(tetrahedra)) {
    triangles.push_back(make_face(tetrahedra[element], face));
  }
  return triangles;
}

std::vector<Spring> make_edges(const std::vector<Tetrahedron>& tetrahedra) {
  std::vector<Spring> edges;
  edges.reserve(6 * tetrahedra.size());
  for (const Tetrahedron& tetrahedron : tetrahedra) {
    for (const auto& [a, b] : local_edges) {
      const auto [smaller, larger] = std::minmax(tetrahedron[a], tetrahedron[b]);
      edges.push_back({smaller, larger});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

double calc_six_volumes(const std::vector<Vec3>& nodes, const Tetrahedron& tetrahedron) {
  const Vec3& origin = nodes[tetrahedron[0]];
  const Vec3 a = nodes[tetrahedron[1]] - origin;
  const Vec3 b = nodes[tetrahedron[2]] - origin;
  const Vec3 c = nodes[tetrahedron[3]] - origin;
  return a.cross(b).dot(c);
}

}  // namespace flexcast
