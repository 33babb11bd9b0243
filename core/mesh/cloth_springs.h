// ClothSprings: the springs of a surface of polygons (see make_cloth() for the rules).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/math.h"
#include "core/mesh/offenders.h"
#include "core/mesh/polygon.h"

namespace flexcast {

class ClothSprings {
 public:
  // More faces about one edge would make more springs than anybody means.
  static constexpr std::size_t most_faces_about_edge = 64;

  void add(Polygon face);

  // Edges that are not to be made springs of, as "P-Q" with numbers from 1.
  Offenders find_crowded_edges();

  // Each pair once, as (smaller, larger) node number, sorted. Nothing may be added afterwards.
  std::vector<Spring> make();

 private:
  // A face beside an edge: the neighbours of edge[0] and edge[1] in the face.
  struct Side {
    Spring edge;
    std::int32_t beside_first = 0, beside_second = 0;
  };

  void sort_sides();
  template <class Visit>
  void for_each_edge(Visit visit);  // gets the sides of one edge

  std::vector<Spring> springs_;
  std::vector<Side> sides_;
  bool sorted_ = false;
};

}  // namespace flexcast
