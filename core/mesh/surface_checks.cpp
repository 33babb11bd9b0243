#include "core/mesh/surface_checks.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "core/mesh/cloth_springs.h"
#include "core/mesh/node_checks.h"
#include "core/mesh/offenders.h"
#include "core/mesh/polygon.h"

namespace flexcast {
namespace {

using Face = NumberedSurface::Face;

std::string face_name(const Face& face) {
  return "in line " + std::to_string(face.line);
}

Result<void> check_counts(const NumberedSurface& surface) {
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max() / 4;
  if (surface.nodes.empty()) return Error{surface.file + ": has no nodes"};
  if (surface.faces.empty()) return Error{surface.file + ": has no faces"};
  if (surface.nodes.size() > most || surface.corners.size() > most) {
    return Error{surface.file + ": has more than " + std::to_string(most) + " nodes or corners of faces"};
  }
  return {};
}

// The corners counted from 0, of nodes that exist, none twice in a face.
Result<std::vector<std::int32_t>> make_corners(const NumberedSurface& surface) {
  const auto nodes = static_cast<std::int64_t>(surface.nodes.size());
  std::vector<std::int32_t> corners(surface.corners.size());
  Offenders unknown, twice;
  for (const Face& face : surface.faces) {
    std::vector<std::int64_t> sorted;
    for (std::size_t i = face.first; i < face.first + face.count; ++i) {
      const std::int64_t node = surface.corners[i];
      const bool known = node >= 1 && node <= nodes;
      if (!known) unknown.add(face_name(face) + " (node " + std::to_string(node) + ")");
      corners[i] = known ? static_cast<std::int32_t>(node - 1) : 0;
      sorted.push_back(node);
    }
    std::sort(sorted.begin(), sorted.end());
    const auto same = std::adjacent_find(sorted.begin(), sorted.end());
    if (same != sorted.end()) twice.add(face_name(face) + " (node " + std::to_string(*same) + ")");
  }
  if (unknown.any()) {
    return Error{surface.file + ": nodes that do not exist (numbers go from 1 to " + std::to_string(nodes) +
                 ") are named by " + unknown.text("face")};
  }
  if (twice.any()) return Error{surface.file + ": the same node twice is named by " + twice.text("face")};
  return corners;
}

Polygon corners_of(const std::vector<std::int32_t>& corners, const Face& face) {
  return Polygon(corners).subspan(face.first, face.count);
}

Result<void> check_duplicate_faces(const NumberedSurface& surface, const std::vector<std::int32_t>& corners) {
  std::vector<std::pair<std::vector<std::int32_t>, std::size_t>> sorted;
  for (std::size_t i = 0; i < surface.faces.size(); ++i) {
    const Polygon face = corners_of(corners, surface.faces[i]);
    sorted.emplace_back(std::vector(face.begin(), face.end()), i);
    std::sort(sorted.back().first.begin(), sorted.back().first.end());
  }
  std::sort(sorted.begin(), sorted.end());
  Offenders duplicates;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first != sorted[i - 1].first) continue;
    duplicates.add(face_name(surface.faces[sorted[i].second]) + " (as " +
                   face_name(surface.faces[sorted[i - 1].second]) + ")");
  }
  if (!duplicates.any()) return {};
  return Error{surface.file + ": the nodes of another face are named by " + duplicates.text("face")};
}

Result<void> check_isolated_nodes(const NumberedSurface& surface, const std::vector<std::int32_t>& corners) {
  std::vector<bool> used(surface.nodes.size(), false);
  for (const std::int32_t node : corners) used[static_cast<std::size_t>(node)] = true;
  Offenders isolated;
  for (std::size_t node = 0; node < used.size(); ++node) {
    if (!used[node]) isolated.add(std::to_string(node + 1));
  }
  if (!isolated.any()) return {};
  return Error{surface.file + ": nodes that belong to no face: " + isolated.text("node")};
}

Result<std::vector<Spring>> make_springs(const NumberedSurface& surface, const std::vector<std::int32_t>& corners) {
  ClothSprings springs;
  for (const Face& face : surface.faces) springs.add(corners_of(corners, face));
  if (auto crowded = springs.find_crowded_edges(); crowded.any()) {
    return Error{surface.file + ": more than " + std::to_string(ClothSprings::most_faces_about_edge) +
                 " faces meet at one edge: " + crowded.text("edge")};
  }
  return springs.make();
}

}  // namespace

Result<MeshFile> make_cloth(const NumberedSurface& surface) {
  if (auto counts = check_counts(surface); !counts) return counts.error();
  const auto number = [](std::size_t node) { return std::to_string(node + 1); };
  if (auto nodes = check_node_places(surface.file, surface.nodes, number); !nodes) return nodes.error();
  const auto corners = make_corners(surface);
  if (!corners) return corners.error();
  if (auto unique = check_duplicate_faces(surface, corners.value()); !unique) return unique.error();
  if (auto joined = check_isolated_nodes(surface, corners.value()); !joined) return joined.error();

  MeshFile result;
  Offenders flat;
  for (const Face& face : surface.faces) {
    const auto outline = make_outline(surface.nodes, corners_of(corners.value(), face));
    if (!has_area(outline)) flat.add(face_name(face));
    append_triangles(corners_of(corners.value(), face), outline, result.mesh.triangles);
  }
  if (flat.any()) return Error{surface.file + ": no area: " + flat.text("face")};
  auto springs = make_springs(surface, corners.value());
  if (!springs) return springs.error();
  result.mesh.nodes = surface.nodes;
  result.mesh.springs = std::move(springs).value();
  return result;
}

}  // namespace flexcast
