#include "core/scene/placement.h"

#include <cmath>

#include "core/forces/handle.h"
#include "core/mesh/topology.h"
#include "core/scene/value_text.h"

namespace flexcast {
namespace {

// rest = R X + origin, for the already scaled mesh.
void place_nodes(const BodyDescription& body, std::vector<Vec3>& nodes) {
  const Mat3 R = calc_rotation_matrix(body.rotation);
  for (Vec3& node : nodes) {
    node = (R * node + body.origin).eval();
    if (!node.allFinite())
      refuse_owner(body.place, "mesh, rotation and origin give rest positions that are not finite");
  }
}

void check_springs(const BodyDescription& body, const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.springs.size(); ++i) {
    const auto [p, q] = mesh.springs[i];
    const double length =
        (mesh.nodes[static_cast<std::size_t>(q)] - mesh.nodes[static_cast<std::size_t>(p)]).stableNorm();
    if (length > 0.0 && std::isfinite(length)) continue;
    refuse_owner(body.place, "spring " + std::to_string(i) + " (nodes " + std::to_string(p) + " and " +
                                 std::to_string(q) + ") has the rest length " + number_text(length) +
                                 "; its law divides by it");
  }
}

void check_tetrahedra(const BodyDescription& body, const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
    const double volume = calc_six_volumes(mesh.nodes, mesh.tetrahedra[i]) / 6.0;
    if (volume > 0.0 && std::isfinite(volume)) continue;
    refuse_owner(body.place, "tetrahedron " + std::to_string(i) + " has the volume " + number_text(volume) +
                                 " m^3 in double precision; expected > 0 and finite");
  }
}

}  // namespace

void place_mesh(const BodyDescription& body, Mesh& mesh) {
  place_nodes(body, mesh.nodes);
  check_springs(body, mesh);
  check_tetrahedra(body, mesh);
}

}  // namespace flexcast
