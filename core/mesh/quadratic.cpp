#include "core/mesh/quadratic.h"

#include <algorithm>
#include <utility>

#include "core/base/checks.h"
#include "core/mesh/topology.h"

namespace flexcast {
namespace {

// The midside nodes, numbered on from the corner nodes.
class EdgeNodes {
 public:
  EdgeNodes(std::vector<Spring> edges, std::size_t corners) : edges_(std::move(edges)), corners_(corners) {}

  std::int32_t find(std::int32_t a, std::int32_t b) const {
    const auto [smaller, larger] = std::minmax(a, b);
    const Spring edge = {smaller, larger};
    const auto found = std::lower_bound(edges_.begin(), edges_.end(), edge);
    FLEXCAST_CHECK(found != edges_.end() && *found == edge);
    return static_cast<std::int32_t>(corners_ + static_cast<std::size_t>(found - edges_.begin()));
  }

 private:
  std::vector<Spring> edges_;  // sorted
  std::size_t corners_;
};

std::vector<Triangle> split(const std::vector<Triangle>& triangles, const EdgeNodes& midsides) {
  std::vector<Triangle> quarters;
  quarters.reserve(4 * triangles.size());
  for (const auto& [a, b, c] : triangles) {
    const std::int32_t ab = midsides.find(a, b), bc = midsides.find(b, c), ca = midsides.find(c, a);
    quarters.insert(quarters.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return quarters;
}

}  // namespace

std::vector<Midsides> make_quadratic(Mesh& mesh) {
  const std::vector<Spring> edges = make_edges(mesh.tetrahedra);
  const EdgeNodes nodes(edges, mesh.nodes.size());
  mesh.nodes.reserve(mesh.nodes.size() + edges.size());
  for (const auto& [a, b] : edges) mesh.nodes.push_back(0.5 * (mesh.nodes[a] + mesh.nodes[b]));

  std::vector<Midsides> midsides(mesh.tetrahedra.size());
  for (std::size_t t = 0; t < midsides.size(); ++t) {
    for (std::size_t e = 0; e < local_edges.size(); ++e) {
      const auto [a, b] = local_edges[e];
      midsides[t][e] = nodes.find(mesh.tetrahedra[t][a], mesh.tetrahedra[t][b]);
    }
  }
  mesh.triangles = split(mesh.triangles, nodes);
  return midsides;
}

}  // namespace flexcast
