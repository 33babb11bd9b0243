#include "core/solvers/grid_hierarchy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace flexcast {
namespace {

constexpr std::int32_t most_cells = 8191;  // along an axis: 13 bits of a key
constexpr double coarsening = 2.0;         // the first grid's spacing over the particles'

// A node's place in its piece's lattice, the longest axis first: by this they are numbered, so that a range of numbers
// is a slice of the body.
struct Place {
  std::int32_t piece = 0;
  std::array<std::int32_t, 3> at = {0, 0, 0};
  std::uint64_t key() const {
    return (static_cast<std::uint64_t>(piece) << 39) | (static_cast<std::uint64_t>(at[0]) << 26) |
           (static_cast<std::uint64_t>(at[1]) << 13) | static_cast<std::uint64_t>(at[2]);
  }
};

struct Piece {
  std::vector<std::int32_t> particles;
  bool is_final = false;
};

std::vector<Piece> find_pieces(const BlockMatrix& A) {
  std::vector<Piece> pieces;
  std::vector<char> seen(static_cast<std::size_t>(A.rows()), 0);
  for (std::int32_t seed = 0; seed < A.rows(); ++seed) {
    if (seen[seed] || A.columns(seed).size() < 2) continue;
    std::vector<std::int32_t> found = {seed};
    seen[seed] = 1;
    for (std::size_t k = 0; k < found.size(); ++k) {
      for (const std::int32_t j : A.columns(found[k])) {
        if (!seen[j]) {
          seen[j] = 1;
          found.push_back(j);
        }
      }
    }
    std::sort(found.begin(), found.end());
    pieces.push_back({std::move(found), false});
  }
  return pieces;
}

// m: mean over particles of the shortest coupled distance.
double calc_spacing(const BlockMatrix& A, const VecX& rest, const Piece& piece) {
  double sum = 0.0;
  for (const std::int32_t i : piece.particles) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const std::int32_t j : A.columns(i)) {
      if (j != i) shortest = std::min(shortest, (block3(rest, i) - block3(rest, j)).norm());
    }
    sum += shortest;
  }
  return sum / static_cast<double>(piece.particles.size());
}

// Fine rows with the places and weights of their parents, before these have numbers.
struct Links {
  std::vector<std::uint64_t> keys;
  std::vector<Place> places;  // of the distinct keys, once numbered
};

void add_link(Links& links, Interpolation& P, const Place& place, double weight) {
  links.keys.push_back(place.key());
  P.weights.push_back(weight);
}

Place place_of(std::uint64_t key) {
  const auto part = [&](int shift) { return static_cast<std::int32_t>((key >> shift) & 8191U); };
  return {static_cast<std::int32_t>(key >> 39), {part(26), part(13), part(0)}};
}

// Numbers the parents by their keys; those are `places` afterwards.
void number(Links& links, Interpolation& P) {
  std::vector<std::uint64_t> sorted = links.keys;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  P.parents.reserve(links.keys.size());
  for (const std::uint64_t key : links.keys) {
    P.parents.push_back(
        static_cast<std::int32_t>(std::lower_bound(sorted.begin(), sorted.end(), key) - sorted.begin()));
  }
  links.places.reserve(sorted.size());
  for (const std::uint64_t key : sorted) links.places.push_back(place_of(key));
  P.transpose(static_cast<std::int64_t>(sorted.size()));
}

// A particle's lattice coordinates, the longest axis first.
struct Lattice {
  Vec3 origin = Vec3::Zero();
  double spacing = 1.0;
  std::array<int, 3> axes = {0, 1, 2};
  std::array<double, 3> calc(const Vec3& position) const {
    std::array<double, 3> at;
    for (std::size_t a = 0; a < 3; ++a) {
      const double exact = (position[axes[a]] - origin[axes[a]]) / spacing;
      const double round = std::round(4.0 * exact) / 4.0;  // regular meshes: no parents of next to no weight
      at[a] = std::max(0.0, std::abs(exact - round) < 1e-6 ? round : exact);
    }
    return at;
  }
};

Lattice make_lattice(const BlockMatrix& A, const VecX& rest, const Piece& piece) {
  Vec3 low = block3(rest, piece.particles[0]), high = low;
  for (const std::int32_t i : piece.particles) {
    low = low.cwiseMin(block3(rest, i));
    high = high.cwiseMax(block3(rest, i));
  }
  const Vec3 size = high - low;
  Lattice lattice;
  lattice.origin = low;
  lattice.spacing = std::max(coarsening * calc_spacing(A, rest, piece), size.maxCoeff() / (most_cells - 1));
  std::stable_sort(lattice.axes.begin(), lattice.axes.end(), [&](int a, int b) { return size[a] > size[b]; });
  return lattice;
}

template <class Call>
void for_corners(const std::array<double, 3>& at, const Call& call) {
  std::array<std::int32_t, 3> cell;
  std::array<std::array<double, 2>, 3> w;
  for (std::size_t a = 0; a < 3; ++a) {
    cell[a] = static_cast<std::int32_t>(at[a]);
    w[a] = {1.0 - (at[a] - cell[a]), at[a] - cell[a]};
  }
  for (int corner = 0; corner < 8; ++corner) {
    const std::array<int, 3> bit = {corner >> 2, (corner >> 1) & 1, corner & 1};
    const double weight = w[0][bit[0]] * w[1][bit[1]] * w[2][bit[2]];
    if (weight > 0.0) call({cell[0] + bit[0], cell[1] + bit[1], cell[2] + bit[2]}, weight);
  }
}

std::size_t count_nodes(const VecX& rest, const Piece& piece, const Lattice& lattice) {
  std::vector<std::uint64_t> keys;
  for (const std::int32_t i : piece.particles) {
    for_corners(lattice.calc(block3(rest, i)), [&](const std::array<std::int32_t, 3>& at, double) {
      keys.push_back(Place{0, at}.key());
    });
  }
  std::sort(keys.begin(), keys.end());
  return static_cast<std::size_t>(std::unique(keys.begin(), keys.end()) - keys.begin());
}

// Sheets and ropes that lie askew fill few of the cells around them: those need wider ones.
Lattice choose_lattice(const BlockMatrix& A, const VecX& rest, const Piece& piece) {
  Lattice lattice = make_lattice(A, rest, piece);
  if (!(lattice.spacing > 0.0 && std::isfinite(lattice.spacing))) return lattice;
  while (2 * count_nodes(rest, piece, lattice) > piece.particles.size() && piece.particles.size() > 16) {
    lattice.spacing *= 1.5;
  }
  return lattice;
}

Interpolation make_first(const BlockMatrix& A, const VecX& rest, std::vector<Piece>& pieces, std::int32_t largest,
                         std::vector<Place>& places) {
  std::vector<std::int32_t> piece_of(static_cast<std::size_t>(A.rows()), -1);
  std::vector<std::int32_t> number_in(static_cast<std::size_t>(A.rows()), 0);
  std::vector<Lattice> lattices(pieces.size());
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    Piece& piece = pieces[p];
    for (std::size_t k = 0; k < piece.particles.size(); ++k) {
      piece_of[piece.particles[k]] = static_cast<std::int32_t>(p);
      number_in[piece.particles[k]] = static_cast<std::int32_t>(k);
    }
    piece.is_final = static_cast<std::int32_t>(piece.particles.size()) <= largest;
    if (!piece.is_final) lattices[p] = choose_lattice(A, rest, piece);
  }
  Links links;
  Interpolation P;
  P.starts.reserve(static_cast<std::size_t>(A.rows()) + 1);
  for (std::int32_t i = 0; i < A.rows(); ++i) {
    const std::int32_t p = piece_of[i];
    if (p >= 0 && pieces[p].is_final) {
      add_link(links, P, {p, {number_in[i], 0, 0}}, 1.0);
    } else if (p >= 0 && lattices[p].spacing > 0.0 && std::isfinite(lattices[p].spacing)) {
      for_corners(lattices[p].calc(block3(rest, i)), [&](const std::array<std::int32_t, 3>& at, double weight) {
        add_link(links, P, {p, at}, weight);
      });
    }
    P.starts.push_back(static_cast<std::int64_t>(P.weights.size()));
  }
  number(links, P);
  places = std::move(links.places);
  return P;
}

Interpolation make_next(const std::vector<Piece>& pieces, std::vector<Place>& places) {
  Links links;
  Interpolation P;
  for (const Place& place : places) {
    if (pieces[static_cast<std::size_t>(place.piece)].is_final) {
      add_link(links, P, place, 1.0);
    } else {
      const std::array<double, 3> half = {0.5 * place.at[0], 0.5 * place.at[1], 0.5 * place.at[2]};
      for_corners(half, [&](const std::array<std::int32_t, 3>& at, double weight) {
        add_link(links, P, {place.piece, at}, weight);
      });
    }
    P.starts.push_back(static_cast<std::int64_t>(P.weights.size()));
  }
  number(links, P);
  places = std::move(links.places);
  return P;
}

std::vector<std::int32_t> find_piece_starts(std::size_t pieces, const std::vector<Place>& places) {
  std::vector<std::int32_t> starts(pieces + 1, 0);
  for (const Place& place : places) ++starts[static_cast<std::size_t>(place.piece) + 1];
  for (std::size_t p = 0; p < pieces; ++p) starts[p + 1] += starts[p];
  return starts;
}

}  // namespace

GridHierarchy make_grid_hierarchy(const BlockMatrix& A, const VecX& rest_positions, std::int32_t largest_piece) {
  std::vector<Piece> pieces = find_pieces(A);
  std::vector<Place> places;
  GridHierarchy hierarchy;
  hierarchy.levels.push_back(make_first(A, rest_positions, pieces, largest_piece, places));
  while (true) {
    hierarchy.piece_starts = find_piece_starts(pieces.size(), places);
    bool all_final = true;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      const std::int32_t count = hierarchy.piece_starts[p + 1] - hierarchy.piece_starts[p];
      pieces[p].is_final = pieces[p].is_final || count <= largest_piece;
      all_final = all_final && pieces[p].is_final;
    }
    if (all_final) return hierarchy;
    hierarchy.levels.push_back(make_next(pieces, places));
  }
}

}  // namespace flexcast
