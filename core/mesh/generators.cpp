#include "core/mesh/generators.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

#include "core/base/checks.h"
#include "core/mesh/topology.h"

namespace flexcast {
namespace {

using Cells = std::array<int, 3>;
using Offset = std::array<int, 3>;

// The nodes of a block of cells; sheets and ropes are blocks with no cells in the other directions.
class NodeGrid {
 public:
  explicit NodeGrid(const Cells& cells) : cells_(cells) {
    const std::int64_t limit = std::numeric_limits<std::int32_t>::max();
    const std::int64_t layer = (std::int64_t{cells[0]} + 1) * (std::int64_t{cells[1]} + 1);
    FLEXCAST_CHECK(layer <= limit && layer <= limit / (std::int64_t{cells[2]} + 1));
  }

  std::int32_t number(int i, int j, int k) const { return i + (cells_[0] + 1) * (j + (cells_[1] + 1) * k); }

  bool contains(int i, int j, int k) const {
    return i >= 0 && i <= cells_[0] && j >= 0 && j <= cells_[1] && k >= 0 && k <= cells_[2];
  }

  // Calls visit(i, j, k) for every node, in the order of the numbers.
  template <class Visit>
  void for_each_node(Visit visit) const {
    for (int k = 0; k <= cells_[2]; ++k) {
      for (int j = 0; j <= cells_[1]; ++j) {
        for (int i = 0; i <= cells_[0]; ++i) visit(i, j, k);
      }
    }
  }

  std::vector<Vec3> make_nodes(const std::array<double, 3>& size) const {
    // Fraction first, so that the last node lies exactly at the given size.
    const auto coordinate = [&](int axis, int step) {
      return cells_[axis] == 0 ? 0.0 : size[axis] * (static_cast<double>(step) / cells_[axis]);
    };
    std::vector<Vec3> nodes;
    for_each_node(
        [&](int i, int j, int k) { nodes.emplace_back(coordinate(0, i), coordinate(1, j), coordinate(2, k)); });
    return nodes;
  }

  // Offsets lead to larger node numbers, each pair of nodes at most once.
  std::vector<Spring> make_springs(std::span<const Offset> offsets) const {
    std::vector<Spring> springs;
    for_each_node([&](int i, int j, int k) {
      for (const auto& [di, dj, dk] : offsets) {
        if (!contains(i + di, j + dj, k + dk)) continue;
        springs.push_back({number(i, j, k), number(i + di, j + dj, k + dk)});
      }
    });
    return springs;
  }

  std::vector<Tetrahedron> make_kuhn_tetrahedra() const {
    std::vector<Tetrahedron> tetrahedra;
    for (int k = 0; k < cells_[2]; ++k) {
      for (int j = 0; j < cells_[1]; ++j) {
        for (int i = 0; i < cells_[0]; ++i) append_kuhn_cell({i, j, k}, tetrahedra);
      }
    }
    return tetrahedra;
  }

 private:
  // Each tetrahedron walks from the cell's first corner to its last along the axes in the permutation's order.
  void append_kuhn_cell(const Offset& cell, std::vector<Tetrahedron>& tetrahedra) const {
    std::array<int, 3> axes = {0, 1, 2};
    do {
      Offset corner = cell;
      Tetrahedron tetrahedron{};
      tetrahedron[0] = number(corner[0], corner[1], corner[2]);
      for (std::size_t step = 0; step < 3; ++step) {
        ++corner[axes[step]];
        tetrahedron[step + 1] = number(corner[0], corner[1], corner[2]);
      }
      const int inversions = (axes[0] > axes[1]) + (axes[0] > axes[2]) + (axes[1] > axes[2]);
      if (inversions % 2 == 1) std::swap(tetrahedron[2], tetrahedron[3]);
      tetrahedra.push_back(tetrahedron);
    } while (std::next_permutation(axes.begin(), axes.end()));
  }

  Cells cells_;
};

constexpr std::array<Offset, 1> rope_offsets = {{{1, 0, 0}}};

// Structural (1, 0) and (0, 1), bend (2, 0) and (0, 2), shear (-1, 1) and (1, 1).
constexpr std::array<Offset, 6> sheet_offsets = {{{1, 0, 0}, {2, 0, 0}, {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}}};

// One of each two opposite neighbours among the 26 around a node: 3 edges, 6 face diagonals, 4 body diagonals.
constexpr std::array<Offset, 13> lattice_offsets = {{{1, 0, 0},
                                                     {-1, 1, 0},
                                                     {0, 1, 0},
                                                     {1, 1, 0},
                                                     {-1, -1, 1},
                                                     {0, -1, 1},
                                                     {1, -1, 1},
                                                     {-1, 0, 1},
                                                     {0, 0, 1},
                                                     {1, 0, 1},
                                                     {-1, 1, 1},
                                                     {0, 1, 1},
                                                     {1, 1, 1}}};

}  // namespace

Mesh make_rope(int cells, double length) {
  const NodeGrid grid({cells, 0, 0});
  Mesh mesh;
  mesh.nodes = grid.make_nodes({length, 0.0, 0.0});
  mesh.springs = grid.make_springs(rope_offsets);
  return mesh;
}

Mesh make_grid(std::array<int, 2> cells, std::array<double, 2> size) {
  const NodeGrid grid({cells[0], cells[1], 0});
  Mesh mesh;
  mesh.nodes = grid.make_nodes({size[0], size[1], 0.0});
  mesh.springs = grid.make_springs(sheet_offsets);
  for (int j = 0; j < cells[1]; ++j) {
    for (int i = 0; i < cells[0]; ++i) {
      const std::int32_t corner = grid.number(i, j, 0);
      const std::int32_t opposite = grid.number(i + 1, j + 1, 0);
      mesh.triangles.push_back({corner, grid.number(i + 1, j, 0), opposite});
      mesh.triangles.push_back({corner, opposite, grid.number(i, j + 1, 0)});
    }
  }
  return mesh;
}

Mesh make_lattice(std::array<int, 3> cells, std::array<double, 3> size) {
  const NodeGrid grid(cells);
  Mesh mesh;
  mesh.nodes = grid.make_nodes(size);
  mesh.springs = grid.make_springs(lattice_offsets);
  mesh.triangles = make_boundary_triangles(grid.make_kuhn_tetrahedra());
  return mesh;
}

Mesh make_beam(std::array<int, 3> cells, std::array<double, 3> size) {
  const NodeGrid grid(cells);
  Mesh mesh;
  mesh.nodes = grid.make_nodes(size);
  mesh.tetrahedra = grid.make_kuhn_tetrahedra();
  mesh.triangles = make_boundary_triangles(mesh.tetrahedra);
  return mesh;
}

}  // namespace flexcast
