#include "core/mesh/cloth_springs.h"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

namespace flexcast {
namespace {

Spring make_spring(std::int32_t p, std::int32_t q) {
  return p < q ? Spring{p, q} : Spring{q, p};
}

}  // namespace

void ClothSprings::add(Polygon face) {
  const std::size_t count = face.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t before = face[(i + count - 1) % count], p = face[i];
    const std::int32_t q = face[(i + 1) % count], after = face[(i + 2) % count];
    springs_.push_back(make_spring(p, q));
    if (count > 3) springs_.push_back(make_spring(p, after));
    sides_.push_back(p < q ? Side{{p, q}, before, after} : Side{{q, p}, after, before});
  }
  sorted_ = false;
}

void ClothSprings::sort_sides() {
  if (std::exchange(sorted_, true)) return;
  std::stable_sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) { return a.edge < b.edge; });
}

template <class Visit>
void ClothSprings::for_each_edge(Visit visit) {
  sort_sides();
  for (std::size_t first = 0, end = 0; first < sides_.size(); first = end) {
    while (end < sides_.size() && sides_[end].edge == sides_[first].edge) ++end;
    visit(std::span<const Side>(sides_).subspan(first, end - first));
  }
}

Offenders ClothSprings::find_crowded_edges() {
  Offenders crowded;
  for_each_edge([&](std::span<const Side> sides) {
    const Spring& edge = sides.front().edge;
    if (sides.size() > most_faces_about_edge) {
      crowded.add(std::to_string(edge[0] + 1) + "-" + std::to_string(edge[1] + 1));
    }
  });
  return crowded;
}

std::vector<Spring> ClothSprings::make() {
  // An edge of three faces or more joins each two of them.
  for_each_edge([&](std::span<const Side> sides) {
    for (std::size_t i = 0; i < sides.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const auto join = [&](std::int32_t p, std::int32_t q) {
          if (p != q) springs_.push_back(make_spring(p, q));
        };
        join(sides[i].beside_first, sides[j].beside_first);
        join(sides[i].beside_second, sides[j].beside_second);
      }
    }
  });
  std::sort(springs_.begin(), springs_.end());
  springs_.erase(std::unique(springs_.begin(), springs_.end()), springs_.end());
  return std::move(springs_);
}

}  // namespace flexcast
