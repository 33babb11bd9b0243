// Patches: the elements of a mesh in runs whose particles fit the first cache, ordered along a space-filling curve.
// A kernel sees one patch: a copy of its particles' vectors, four doubles each (x, y, z, 0), and the elements in
// batches of eight lanes that name particles by their place in that copy. No two elements of a batch share a particle,
// so that it does not matter in which order they add to one. What the patches give a particle is added up in the order
// of the patches, whichever thread made it. Source of the curve: G. M. Morton, A computer oriented geodetic data base
// and a new technique in file sequencing, IBM 1966.
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
};

class Patches {
 public:
  static constexpr int lanes = 8;
  static constexpr std::int32_t most_slots = 512;

  Patches() = default;
  // `nodes`: particles of the world, nodes_per_element for each element, all in `particles`. At most `most_elements` a
  // patch, a multiple of the lanes.
  Patches(std::span<const std::int32_t> nodes, int nodes_per_element, std::int32_t most_elements,
          const VecX& rest_positions, IndexRange particles);

  std::span<const Patch> patches() const { return patches_; }
  std::int64_t batch_count() const { return static_cast<std::int64_t>(elements_.size()) / lanes; }
  // The element of each lane of each batch; -1 - e in lanes left over, which repeat element e and must not count.
  std::span<const std::int32_t> elements() const { return elements_; }
  // [batch][node][lane]: places in the copy.
  const std::uint16_t* places(std::int32_t batch) const {
    return places_.data() + static_cast<std::int64_t>(batch) * nodes_per_element_ * lanes;
  }

  void copy(const Patch& patch, const VecX& x, double* local) const;

  // f += what kernel(patch, local_x, local_f) adds to its zeroed copy, for every patch.
  template <class Kernel>
  void add_to(const VecX& x, VecX& f, Kernel kernel) const;
  // The same with two vectors to read, and the sum of what kernel(patch, local_x, local_v, local_f) returns.
  template <class Kernel>
  double add_to(const VecX& x, const VecX& v, VecX& f, Kernel kernel) const;
  // Calls kernel(patch, local_x) for every patch; those that share a particle one after the other, in a fixed order.
  template <class Kernel>
  void for_apart(const VecX& x, Kernel kernel) const;
  // The same with two vectors to read and u, which kernel(patch, local_x, local_w, local_u) changes.
  template <class Kernel>
  void sweep(const VecX& x, const VecX& w, VecX& u, Kernel kernel) const;
  // The sum of kernel(patch, local_x).
  template <class Kernel>
  double sum(const VecX& x, Kernel kernel) const;

 private:
  template <class Place>
  void add_batches(std::span<const std::int32_t> mine, Place place);

  struct Copy {
    alignas(64) double values[4 * most_slots];
  };
  void clear(const Patch& patch, Copy& copy) const { std::fill_n(copy.values, 4 * patch.slots, 0.0); }
  void copy_back(const Patch& patch, const double* local, VecX& x) const;
  template <class Visit>
  void visit_apart(Visit visit) const;
  void put(const Patch& patch, const double* local) const;
  void collect(VecX& f) const;

  int nodes_per_element_ = 0;
  IndexRange particles_;
  std::vector<Patch> patches_;
  std::vector<std::int32_t> elements_;
  AlignedVector<std::uint16_t> places_;
  std::vector<std::int32_t> slot_particles_;            // ascending in a patch
  std::vector<std::int32_t> meeting_starts_, meeting_;  // for each particle its slots, ascending
  std::vector<std::vector<std::int32_t>> colors_;       // patches that share no particle
  mutable std::vector<double> partial_, patch_sums_;    // scratch: [slot][3], [patch]
};

template <class Kernel>
void Patches::add_to(const VecX& x, VecX& f, Kernel kernel) const {
  parallel_for(static_cast<std::int64_t>(patches_.size()), 1, [&](std::int64_t first, std::int64_t end) {
    Copy local_x, local_f;
    for (std::int64_t p = first; p < end; ++p) {
      const Patch& patch = patches_[static_cast<std::size_t>(p)];
      copy(patch, x, local_x.values);
      clear(patch, local_f);
      kernel(patch, local_x.values, local_f.values);
      put(patch, local_f.values);
    }
  });
  collect(f);
}

template <class Kernel>
double Patches::add_to(const VecX& x, const VecX& v, VecX& f, Kernel kernel) const {
  const double total =
      parallel_sum(static_cast<std::int64_t>(patches_.size()), 1, patch_sums_, [&](std::int64_t first, std::int64_t) {
        Copy local_x, local_v, local_f;
        const Patch& patch = patches_[static_cast<std::size_t>(first)];
        copy(patch, x, local_x.values);
        copy(patch, v, local_v.values);
        clear(patch, local_f);
        const double value = kernel(patch, local_x.values, local_v.values, local_f.values);
        put(patch, local_f.values);
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
        visit(patches_[static_cast<std::size_t>(color[static_cast<std::size_t>(p)])]);
      }
    });
  }
}

template <class Kernel>
void Patches::for_apart(const VecX& x, Kernel kernel) const {
  visit_apart([&](const Patch& patch) {
    Copy local_x;
    copy(patch, x, local_x.values);
    kernel(patch, local_x.values);
  });
}

template <class Kernel>
void Patches::sweep(const VecX& x, const VecX& w, VecX& u, Kernel kernel) const {
  visit_apart([&](const Patch& patch) {
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
