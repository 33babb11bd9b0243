// Patches: the elements of a mesh in runs whose particles fit the first cache, ordered along a space-filling curve.
// A kernel sees one patch: a copy of its particles' vectors, four doubles each (x, y, z, 0), and the elements in
// batches of eight lanes that name particles by their place in that copy. It writes what its elements give to particles
// as rows of four doubles; then each particle gathers its rows, so that no sum waits for the one before. What the
// patches give a particle is added up in the order of the patches, whichever thread made it.
// Source of the curve: G. M. Morton, A computer oriented geodetic data base and a new technique in file sequencing,
// IBM 1966.
#pragma once

#include <span>
#include <vector>

#include "core/base/aligned.h"
#include "core/base/math.h"
#include "core/base/parallel.h"

namespace flexcast {

struct Patch {
  std::int32_t first_batch = 0, batches = 0;
  std::int32_t first_slot = 0, slots = 0;  // the particles of the copy
  std::int64_t first_row = 0;              // of the lists of rows
};

// How an element gives to one of its nodes: a row of those it writes, added or subtracted.
struct NodeRow {
  std::int32_t row = 0;
  bool subtracted = false;
};

// Which elements share a batch.
enum class LaneOrder {
  spread,  // lane l holds the l-th eighth of the patch: full batches
  apart    // no two of a batch have a particle in common: what moves particles at once
};

class Patches {
 public:
  static constexpr int lanes = 8;
  static constexpr std::int32_t most_slots = 512, most_rows = 1024;

  Patches() = default;
  // `nodes`: particles of the world, as many for each element as there are node rows, all in `particles`. At most
  // most_rows rows a patch, or where they are apart as many elements as for one row each.
  Patches(std::span<const std::int32_t> nodes, std::span<const NodeRow> node_rows, LaneOrder lane_order,
          const VecX& rest_positions, IndexRange particles);

  std::span<const Patch> patches() const { return patches_; }
  std::int64_t batch_count() const { return static_cast<std::int64_t>(elements_.size()) / lanes; }
  // The element of each lane of each batch; -1 - e in lanes left over, which repeat element e and must not count.
  std::span<const std::int32_t> elements() const { return elements_; }
  // [batch][node][lane]: where in the copy the vector begins.
  const std::uint16_t* places(std::int32_t batch) const {
    return places_.data() + static_cast<std::size_t>(batch) * nodes_per_element_ * lanes;
  }

  void copy(const Patch& patch, const VecX& x, double* local) const;

  // f += what kernel(patch, local_x, rows) writes, for every patch: rows are [batch][row][lane][4]. For spread lanes.
  template <class Kernel>
  void add_to(const VecX& x, VecX& f, Kernel kernel) const;
  // The same with two vectors to read, and the sum of what kernel(patch, local_x, local_v, rows) returns.
  template <class Kernel>
  double add_to(const VecX& x, const VecX& v, VecX& f, Kernel kernel) const;
  // Calls kernel(number, patch, local_x) for every patch; those that share a particle one after the other, in a fixed
  // order.
  template <class Kernel>
  void for_apart(const VecX& x, Kernel kernel) const;
  // The same with two vectors to read and u, which kernel(patch, local_x, local_w, local_u) changes.
  template <class Kernel>
  void sweep(const VecX& x, const VecX& w, VecX& u, Kernel kernel) const;
  // The sum of kernel(patch, local_x).
  template <class Kernel>
  double sum(const VecX& x, Kernel kernel) const;

 private:
  struct Draft;
  void add_patch(std::span<const std::int32_t> nodes, const Draft& draft);
  void find_meetings();
  void find_colors();

  struct Copy {
    alignas(64) double values[4 * most_slots];
  };
  struct Rows {
    alignas(64) double values[4 * most_rows];
  };
  void copy_back(const Patch& patch, const double* local, VecX& x) const;
  template <class Visit>
  void visit_apart(Visit visit) const;
  void gather(const Patch& patch, const double* rows) const;
  void collect(VecX& f) const;

  std::size_t nodes_per_element_ = 0;
  std::vector<NodeRow> node_rows_;
  IndexRange particles_;
  std::vector<Patch> patches_;
  std::vector<std::int32_t> elements_;
  AlignedVector<std::uint16_t> places_;
  std::vector<std::int32_t> slot_particles_;
  std::vector<std::uint16_t> row_counts_;               // [slot][2]: of rows added and of rows subtracted
  std::vector<std::uint16_t> rows_;                     // their numbers, slot by slot
  std::vector<std::int32_t> meeting_starts_, meeting_;  // for each particle its slots, ascending
  std::vector<std::vector<std::int32_t>> colors_;       // patches that share no particle
  mutable std::vector<double> partial_, patch_sums_;    // scratch: [slot][3], [patch]
};

template <class Kernel>
void Patches::add_to(const VecX& x, VecX& f, Kernel kernel) const {
  parallel_for(static_cast<std::int64_t>(patches_.size()), 1, [&](std::int64_t first, std::int64_t end) {
    Copy local_x;
    Rows rows;
    for (std::int64_t p = first; p < end; ++p) {
      const Patch& patch = patches_[static_cast<std::size_t>(p)];
      copy(patch, x, local_x.values);
      kernel(patch, local_x.values, rows.values);
      gather(patch, rows.values);
    }
  });
  collect(f);
}

template <class Kernel>
double Patches::add_to(const VecX& x, const VecX& v, VecX& f, Kernel kernel) const {
  const double total =
      parallel_sum(static_cast<std::int64_t>(patches_.size()), 1, patch_sums_, [&](std::int64_t first, std::int64_t) {
        Copy local_x, local_v;
        Rows rows;
        const Patch& patch = patches_[static_cast<std::size_t>(first)];
        copy(patch, x, local_x.values);
        copy(patch, v, local_v.values);
        const double value = kernel(patch, local_x.values, local_v.values, rows.values);
        gather(patch, rows.values);
        return value;
      });
  collect(f);
  return total;
}

template <class Visit>
void Patches::visit_apart(Visit visit) const {
  for (const std::vector<std::int32_t>& color : colors_) {
    parallel_for(static_cast<std::int64_t>(color.size()), 1, [&](std::int64_t first, std::int64_t end) {
      for (std::int64_t p = first; p < end; ++p) {
        const auto number = static_cast<std::size_t>(color[static_cast<std::size_t>(p)]);
        visit(number, patches_[number]);
      }
    });
  }
}

template <class Kernel>
void Patches::for_apart(const VecX& x, Kernel kernel) const {
  visit_apart([&](std::size_t number, const Patch& patch) {
    Copy local_x;
    copy(patch, x, local_x.values);
    kernel(number, patch, local_x.values);
  });
}

template <class Kernel>
void Patches::sweep(const VecX& x, const VecX& w, VecX& u, Kernel kernel) const {
  visit_apart([&](std::size_t, const Patch& patch) {
    Copy local_x, local_w, local_u;
    copy(patch, x, local_x.values);
    copy(patch, w, local_w.values);
    copy(patch, u, local_u.values);
    kernel(patch, local_x.values, local_w.values, local_u.values);
    copy_back(patch, local_u.values, u);
  });
}

template <class Kernel>
double Patches::sum(const VecX& x, Kernel kernel) const {
  return parallel_sum(static_cast<std::int64_t>(patches_.size()), 1, patch_sums_,
                      [&](std::int64_t first, std::int64_t) {
                        Copy local_x;
                        const Patch& patch = patches_[static_cast<std::size_t>(first)];
                        copy(patch, x, local_x.values);
                        return kernel(patch, local_x.values);
                      });
}

}  // namespace flexcast
