#include "core/scene/selectors.h"

#include <algorithm>

#include "core/mesh/topology.h"

namespace flexcast {
namespace {

constexpr Quantity meters{ranges::any, "m"};
constexpr Quantity radius{ranges::non_negative, "m"};
constexpr Quantity node_number{ranges::non_negative, ""};

BoxSelector read_box(const TableReader& reader) {
  const auto corners = *reader.rows("box", 2, 3, meters);
  const BoxSelector box{Vec3(corners[0].data()), Vec3(corners[1].data())};
  for (int axis = 0; axis < 3; ++axis)
    if (box.lower[axis] > box.upper[axis])
      reader.refuse_value("box", std::string("has its first corner above its second along ") + "xyz"[axis]);
  return box;
}

SphereSelector read_sphere(const TableReader& reader) {
  const auto values = *reader.numbers("sphere", 4, meters);
  if (!radius.range.contains(values[3])) reader.refuse_value("sphere", "has a negative radius");
  return {Vec3(values[0], values[1], values[2]), values[3]};
}

bool contains(const AllSelector&, const Vec3&) {
  return true;
}
bool contains(const BoxSelector& box, const Vec3& x) {
  return (x.array() >= box.lower.array()).all() && (x.array() <= box.upper.array()).all();
}
bool contains(const SphereSelector& sphere, const Vec3& x) {
  return (x - sphere.center).stableNorm() <= sphere.radius;
}

template <class Region>
std::vector<std::int32_t> find_inside(const Region& region, const std::vector<Vec3>& rest, IndexRange particles) {
  std::vector<std::int32_t> found;
  for (std::int32_t i = particles.first; i < particles.end(); ++i)
    if (contains(region, rest[static_cast<std::size_t>(i)])) found.push_back(i);
  return found;
}

void sort_unique(std::vector<std::int32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

std::vector<std::int32_t> find_nodes(const Selector& selector, const NodeSelector& list, IndexRange particles) {
  std::vector<std::int32_t> found;
  for (std::int64_t node : list.nodes) {
    if (node >= particles.count)
      refuse(selector.place, "names node " + std::to_string(node) + ", which the body does not have (allowed: 0 to " +
                                 std::to_string(particles.count - 1) + ")");
    found.push_back(particles.first + static_cast<std::int32_t>(node));
  }
  sort_unique(found);
  return found;
}

// The midside nodes between two of the found ones.
void add_midsides(std::span<const Tetrahedron> tetrahedra, std::span<const Midsides> midsides,
                  std::vector<std::int32_t>& found) {
  const std::vector<std::int32_t> ends = found;
  const auto is_end = [&](std::int32_t node) { return std::binary_search(ends.begin(), ends.end(), node); };
  for (std::size_t t = 0; t < midsides.size(); ++t) {
    std::array<bool, 4> listed{};
    for (std::size_t corner = 0; corner < 4; ++corner) listed[corner] = is_end(tetrahedra[t][corner]);
    for (std::size_t edge = 0; edge < local_edges.size(); ++edge) {
      const auto [a, b] = local_edges[edge];
      if (listed[static_cast<std::size_t>(a)] && listed[static_cast<std::size_t>(b)])
        found.push_back(midsides[t][edge]);
    }
  }
  sort_unique(found);
}

}  // namespace

Selector read_selector(const TableEntry& entry) {
  const TableReader reader(entry, {"box", "sphere", "nodes", "all"});
  if (entry.table->size() != 1)
    refuse(entry.place,
           "has " + std::to_string(entry.table->size()) + " keys; expected exactly one of box, sphere, nodes, all");
  Selector selector{AllSelector{}, entry.place};
  if (reader.has("box")) selector.what = read_box(reader);
  if (reader.has("sphere")) selector.what = read_sphere(reader);
  if (auto nodes = reader.integers("nodes", node_number)) selector.what = NodeSelector{std::move(*nodes)};
  if (reader.has("all")) reader.require_true("all");
  return selector;
}

std::vector<std::int32_t> select(const Selector& selector, const std::vector<Vec3>& rest_positions,
                                 IndexRange particles, std::span<const Tetrahedron> tetrahedra,
                                 std::span<const Midsides> midsides) {
  const auto find = [&](const auto& what) {
    if constexpr (std::is_same_v<std::decay_t<decltype(what)>, NodeSelector>)
      return find_nodes(selector, what, particles);
    else
      return find_inside(what, rest_positions, particles);
  };
  std::vector<std::int32_t> found = std::visit(find, selector.what);
  if (std::holds_alternative<NodeSelector>(selector.what)) add_midsides(tetrahedra, midsides, found);
  if (found.empty()) refuse(selector.place, "selects no particle of the body");
  return found;
}

}  // namespace flexcast
