#include "core/mesh/mesh_checks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/mesh/node_checks.h"
#include "core/mesh/offenders.h"
#include "core/mesh/topology.h"

namespace flexcast {
namespace {

// Finds the index of a node by its number in the file.
class NodeIndex {
 public:
  explicit NodeIndex(const std::vector<std::int64_t>& numbers) {
    entries_.reserve(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) entries_.push_back({numbers[i], static_cast<std::int32_t>(i)});
    std::sort(entries_.begin(), entries_.end());
  }

  std::optional<std::int32_t> find(std::int64_t number) const {
    const auto entry = std::lower_bound(entries_.begin(), entries_.end(), Entry{number, 0});
    if (entry == entries_.end() || entry->first != number) return std::nullopt;
    return entry->second;
  }

  Offenders make_repeated() const {
    Offenders repeated;
    for (std::size_t i = 1; i < entries_.size(); ++i) {
      if (entries_[i].first == entries_[i - 1].first) repeated.add(std::to_string(entries_[i].first));
    }
    return repeated;
  }

  std::string range() const {
    return std::to_string(entries_.front().first) + " to " + std::to_string(entries_.back().first);
  }

 private:
  using Entry = std::pair<std::int64_t, std::int32_t>;
  std::vector<Entry> entries_;
};

std::string node_name(const NumberedMesh& numbered, std::size_t node) {
  return std::to_string(numbered.node_numbers[node]);
}

std::string element_name(const NumberedMesh& numbered, std::size_t element) {
  return std::to_string(numbered.element_numbers[element]);
}

Result<void> check_counts(const NumberedMesh& numbered) {
  // Four faces each must be countable too.
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max() / 4;
  if (numbered.nodes.empty()) return Error{numbered.node_file + ": has no nodes"};
  if (numbered.elements.empty()) {
    return Error{numbered.element_file + ": has no tetrahedra; a surface where a volume is needed"};
  }
  if (numbered.nodes.size() > most || numbered.elements.size() > most) {
    return Error{numbered.element_file + ": has more than " + std::to_string(most) + " nodes or elements"};
  }
  return {};
}

Result<std::vector<Tetrahedron>> make_tetrahedra(const NumberedMesh& numbered) {
  const NodeIndex index(numbered.node_numbers);
  const Offenders repeated = index.make_repeated();
  if (repeated.any()) {
    return Error{numbered.node_file + ": numbers given to more than one node: " + repeated.text("node")};
  }

  std::vector<Tetrahedron> tetrahedra(numbered.elements.size());
  Offenders unknown;
  Offenders twice;
  for (std::size_t element = 0; element < tetrahedra.size(); ++element) {
    const auto& names = numbered.elements[element];
    for (std::size_t vertex = 0; vertex < 4; ++vertex) {
      const auto found = index.find(names[vertex]);
      tetrahedra[element][vertex] = found.value_or(0);
      if (!found) unknown.add(element_name(numbered, element) + " (node " + std::to_string(names[vertex]) + ")");
    }
    auto sorted = names;
    std::sort(sorted.begin(), sorted.end());
    const auto same = std::adjacent_find(sorted.begin(), sorted.end());
    if (same != sorted.end()) twice.add(element_name(numbered, element) + " (node " + std::to_string(*same) + ")");
  }
  if (unknown.any()) {
    return Error{numbered.element_file + ": nodes that do not exist (numbers go from " + index.range() +
                 ") are named by " + unknown.text("element")};
  }
  if (twice.any()) {
    return Error{numbered.element_file + ": the same node twice is named by " + twice.text("element")};
  }
  return tetrahedra;
}

Result<void> check_duplicate_elements(const NumberedMesh& numbered, const std::vector<Tetrahedron>& tetrahedra) {
  std::vector<std::pair<Tetrahedron, std::size_t>> sorted;
  sorted.reserve(tetrahedra.size());
  for (std::size_t element = 0; element < tetrahedra.size(); ++element) {
    sorted.emplace_back(tetrahedra[element], element);
    std::sort(sorted.back().first.begin(), sorted.back().first.end());
  }
  std::sort(sorted.begin(), sorted.end());
  Offenders duplicates;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first != sorted[i - 1].first) continue;
    duplicates.add(element_name(numbered, sorted[i].second) + " (as " + element_name(numbered, sorted[i - 1].second) +
                   ")");
  }
  if (!duplicates.any()) return {};
  return Error{numbered.element_file + ": the nodes of another element are named by " + duplicates.text("element")};
}

Result<void> check_isolated_nodes(const NumberedMesh& numbered, const std::vector<Tetrahedron>& tetrahedra) {
  std::vector<bool> used(numbered.nodes.size(), false);
  for (const Tetrahedron& tetrahedron : tetrahedra) {
    for (std::int32_t node : tetrahedron) used[node] = true;
  }
  Offenders isolated;
  for (std::size_t node = 0; node < used.size(); ++node) {
    if (!used[node]) isolated.add(node_name(numbered, node));
  }
  if (!isolated.any()) return {};
  return Error{numbered.node_file + ": nodes that belong to no tetrahedron: " + isolated.text("node")};
}

// -1, 0 or 1. Zero when the volume is no more than rounding makes of four coplanar points: relative to the longest
// edge L, and to the coordinates M, which were rounded when they were written. Independent of the unit of length.
int calc_orientation(const std::vector<Vec3>& nodes, const Tetrahedron& tetrahedron) {
  double largest = 0.0;
  for (std::int32_t node : tetrahedron) largest = std::max(largest, nodes[node].cwiseAbs().maxCoeff());
  // A power of two changes no digit, and cubes of what remains neither overflow nor vanish.
  const int exponent = std::ilogb(largest);
  std::vector<Vec3> scaled;
  scaled.reserve(4);
  for (std::int32_t node : tetrahedron) {
    scaled.push_back(nodes[node].unaryExpr([&](double x) { return std::ldexp(x, -exponent); }));
  }
  const double six_volumes = calc_six_volumes(scaled, {0, 1, 2, 3});

  double longest = 0.0;
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < a; ++b) longest = std::max(longest, (scaled[a] - scaled[b]).norm());
  }
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const double coordinate = std::ldexp(largest, -exponent);
  const double rounding = (1e-12 * longest + 8.0 * epsilon * coordinate) * longest * longest;
  return six_volumes > rounding ? 1 : six_volumes < -rounding ? -1 : 0;
}

}  // namespace

Result<MeshFile> check_mesh(const NumberedMesh& numbered) {
  if (auto counts = check_counts(numbered); !counts) return counts.error();
  const auto number = [&](std::size_t node) { return node_name(numbered, node); };
  if (auto nodes = check_node_places(numbered.node_file, numbered.nodes, number); !nodes) return nodes.error();
  auto tetrahedra = make_tetrahedra(numbered);
  if (!tetrahedra) return tetrahedra.error();
  if (auto unique = check_duplicate_elements(numbered, tetrahedra.value()); !unique) return unique.error();
  if (auto joined = check_isolated_nodes(numbered, tetrahedra.value()); !joined) return joined.error();

  Offenders flat;
  Offenders inverted;
  for (std::size_t element = 0; element < tetrahedra.value().size(); ++element) {
    Tetrahedron& tetrahedron = tetrahedra.value()[element];
    const int orientation = calc_orientation(numbered.nodes, tetrahedron);
    if (orientation == 0) flat.add(element_name(numbered, element));
    if (orientation >= 0) continue;
    inverted.add(element_name(numbered, element));
    std::swap(tetrahedron[2], tetrahedron[3]);
  }
  if (flat.any()) {
    return Error{numbered.element_file + ": no volume, the four nodes lie in one plane: " + flat.text("element")};
  }

  MeshFile result;
  if (inverted.any()) {
    result.repairs.push_back(
        numbered.element_file +
        ": turned inverted elements round by swapping their last two nodes: " + inverted.text("element"));
  }
  result.mesh.nodes = numbered.nodes;
  result.mesh.tetrahedra = std::move(tetrahedra.value());
  result.mesh.triangles = make_boundary_triangles(result.mesh.tetrahedra);
  return result;
}

}  // namespace flexcast
