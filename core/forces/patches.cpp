#include "core/forces/patches.h"

#include <algorithm>
#include <bitset>
#include <numeric>

#include "core/forces/patch_kernels.h"

namespace flexcast {
namespace {

// Bits of a 21 bit number, two zeros between them.
std::uint64_t spread_bits(std::uint64_t v) {
  v = (v | v << 32) & 0x001f00000000ffffULL;
  v = (v | v << 16) & 0x001f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  v = (v | v << 2) & 0x1249249249249249ULL;
  return v;
}

// The elements along Morton's curve through their centroids; ties keep their order.
std::vector<std::int32_t> make_order(std::span<const std::int32_t> nodes, int nodes_per_element, const VecX& rest,
                                     IndexRange particles) {
  Vec3 lo = Vec3::Constant(1e300), hi = Vec3::Constant(-1e300);
  for (std::int32_t i = particles.first; i < particles.end(); ++i) {
    lo = lo.cwiseMin(block3(rest, i));
    hi = hi.cwiseMax(block3(rest, i));
  }
  const double size = (hi - lo).maxCoeff();
  const double scale = size > 0.0 ? 2097151.0 / size : 0.0;
  const std::size_t count = nodes.size() / static_cast<std::size_t>(nodes_per_element);
  std::vector<std::pair<std::uint64_t, std::int32_t>> keys(count);
  for (std::size_t e = 0; e < count; ++e) {
    Vec3 center = Vec3::Zero();
    for (int a = 0; a < nodes_per_element; ++a) {
      center += block3(rest, nodes[e * static_cast<std::size_t>(nodes_per_element) + static_cast<std::size_t>(a)]) - lo;
    }
    center *= scale / nodes_per_element;
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k) {
      key |= spread_bits(static_cast<std::uint64_t>(std::clamp(center[k], 0.0, 2097151.0))) << k;
    }
    keys[e] = {key, static_cast<std::int32_t>(e)};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::int32_t> order(count);
  std::transform(keys.begin(), keys.end(), order.begin(), [](const auto& key) { return key.second; });
  return order;
}

}  // namespace

// A patch in the making.
struct Patches::Draft {
  struct Batch {
    std::vector<std::int32_t> elements;
    std::bitset<most_slots> taken;
  };

  explicit Draft(IndexRange world) : range(world), places(static_cast<std::size_t>(world.count), -1) {}

  std::int32_t& place(std::int32_t particle) { return places[static_cast<std::size_t>(particle - range.first)]; }
  std::int32_t place(std::int32_t particle) const { return places[static_cast<std::size_t>(particle - range.first)]; }
  // False: too many particles.
  bool add_particles(std::span<const std::int32_t> nodes) {
    const std::size_t before = particles.size();
    for (const std::int32_t particle : nodes) {
      if (place(particle) >= 0) continue;
      place(particle) = static_cast<std::int32_t>(particles.size());
      particles.push_back(particle);
    }
    if (particles.size() <= static_cast<std::size_t>(most_slots)) return true;
    for (std::size_t k = before; k < particles.size(); ++k) place(particles[k]) = -1;
    particles.resize(before);
    return false;
  }
  // The first batch that has room and none of the element's particles.
  void add_apart(std::int32_t e, std::span<const std::int32_t> nodes) {
    std::bitset<most_slots> own;
    for (const std::int32_t particle : nodes) own.set(static_cast<std::size_t>(place(particle)));
    while (first_open < batches.size() && batches[first_open].elements.size() == lanes) ++first_open;
    std::size_t b = first_open;
    while (b < batches.size() && (batches[b].elements.size() == lanes || (batches[b].taken & own).any())) ++b;
    if (b == batches.size()) batches.emplace_back();
    batches[b].elements.push_back(e);
    batches[b].taken |= own;
  }
  void spread(std::span<const std::int32_t> elements) {
    batches.resize((elements.size() + lanes - 1) / lanes);
    for (std::size_t k = 0; k < elements.size(); ++k) {
      batches[k % batches.size()].elements.push_back(elements[k]);
    }
  }
  void clear() {
    for (const std::int32_t particle : particles) place(particle) = -1;
    particles.clear();
    batches.clear();
    first_open = 0;
  }

  IndexRange range;
  std::vector<std::int32_t> places;     // of the body's particles; -1: not in the patch
  std::vector<std::int32_t> particles;  // of the patch
  std::vector<Batch> batches;
  std::size_t first_open = 0;
};

Patches::Patches(std::span<const std::int32_t> nodes, std::span<const NodeRow> node_rows, LaneOrder lane_order,
                 const VecX& rest_positions, IndexRange particles)
    : nodes_per_element_(node_rows.size()), node_rows_(node_rows.begin(), node_rows.end()), particles_(particles) {
  // What moves particles one after the other does it in the order of the mesh: the curve would turn with the scene.
  std::vector<std::int32_t> order(nodes.size() / nodes_per_element_);
  std::iota(order.begin(), order.end(), 0);
  if (lane_order == LaneOrder::spread) {
    order = make_order(nodes, static_cast<int>(nodes_per_element_), rest_positions, particles);
  }
  std::int32_t rows_per_element = 1;
  for (const NodeRow& one : node_rows) rows_per_element = std::max(rows_per_element, one.row + 1);
  const auto most_elements = static_cast<std::size_t>(most_rows / rows_per_element / lanes * lanes);
  Draft draft(particles);
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    const auto nodes_of = [&](std::size_t k) {
      return nodes.subspan(static_cast<std::size_t>(order[k]) * nodes_per_element_, nodes_per_element_);
    };
    while (end < order.size() && end - begin < most_elements && draft.add_particles(nodes_of(end))) {
      if (lane_order == LaneOrder::apart) draft.add_apart(order[end], nodes_of(end));
      ++end;
    }
    if (lane_order == LaneOrder::spread) draft.spread({order.data() + begin, end - begin});
    add_patch(nodes, draft);
    draft.clear();
  }
  find_meetings();
  find_colors();
  elements_.shrink_to_fit();
  places_.shrink_to_fit();
  slot_particles_.shrink_to_fit();
  row_counts_.shrink_to_fit();
  rows_.shrink_to_fit();
  partial_.resize(3 * slot_particles_.size());
}

void Patches::add_patch(std::span<const std::int32_t> nodes, const Draft& draft) {
  // Rows by particle, in the order of batches, lanes and nodes.
  struct Given {
    std::int32_t particle = 0;
    std::vector<std::uint16_t> added, subtracted;
    std::size_t count() const { return added.size() + subtracted.size(); }
  };
  std::vector<Given> given(draft.particles.size());
  for (std::size_t k = 0; k < given.size(); ++k) given[k].particle = draft.particles[k];
  std::int32_t rows_per_element = 1;
  for (const NodeRow& one : node_rows_) rows_per_element = std::max(rows_per_element, one.row + 1);
  for (std::size_t b = 0; b < draft.batches.size(); ++b) {
    for (std::size_t lane = 0; lane < draft.batches[b].elements.size(); ++lane) {
      for (std::size_t a = 0; a < nodes_per_element_; ++a) {
        const auto e = static_cast<std::size_t>(draft.batches[b].elements[lane]);
        Given& to = given[static_cast<std::size_t>(draft.place(nodes[e * nodes_per_element_ + a]))];
        const std::size_t row =
            (b * static_cast<std::size_t>(rows_per_element) + static_cast<std::size_t>(node_rows_[a].row)) * lanes +
            lane;
        (node_rows_[a].subtracted ? to.subtracted : to.added).push_back(static_cast<std::uint16_t>(row));
      }
    }
  }
  // Particles with as many rows next to each other: loops of the same length are predicted well.
  std::sort(given.begin(), given.end(), [](const Given& one, const Given& other) {
    return one.count() != other.count() ? one.count() > other.count() : one.particle < other.particle;
  });

  patches_.push_back({static_cast<std::int32_t>(batch_count()), static_cast<std::int32_t>(draft.batches.size()),
                      static_cast<std::int32_t>(slot_particles_.size()), static_cast<std::int32_t>(given.size()),
                      static_cast<std::int64_t>(rows_.size())});
  std::vector<std::int32_t> slot_of(given.size());  // by the draft's places
  for (std::size_t slot = 0; slot < given.size(); ++slot) {
    slot_of[static_cast<std::size_t>(draft.place(given[slot].particle))] = static_cast<std::int32_t>(slot);
    slot_particles_.push_back(given[slot].particle);
    for (const auto* list : {&given[slot].added, &given[slot].subtracted}) {
      row_counts_.push_back(static_cast<std::uint16_t>(list->size()));
      rows_.insert(rows_.end(), list->begin(), list->end());
    }
  }
  for (const Draft::Batch& batch : draft.batches) {
    const auto element = [&](std::size_t lane) { return batch.elements[std::min(lane, batch.elements.size() - 1)]; };
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      elements_.push_back(lane < batch.elements.size() ? element(lane) : -1 - element(lane));
    }
    for (std::size_t a = 0; a < nodes_per_element_; ++a) {
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const std::int32_t particle = nodes[static_cast<std::size_t>(element(lane)) * nodes_per_element_ + a];
        places_.push_back(static_cast<std::uint16_t>(4 * slot_of[static_cast<std::size_t>(draft.place(particle))]));
      }
    }
  }
}

void Patches::find_meetings() {
  const auto row = [&](std::int32_t particle) { return static_cast<std::size_t>(particle - particles_.first); };
  meeting_starts_.assign(static_cast<std::size_t>(particles_.count) + 1, 0);
  for (const std::int32_t particle : slot_particles_) ++meeting_starts_[row(particle) + 1];
  std::partial_sum(meeting_starts_.begin(), meeting_starts_.end(), meeting_starts_.begin());
  std::vector<std::int32_t> next(meeting_starts_.begin(), meeting_starts_.end() - 1);
  meeting_.resize(slot_particles_.size());
  for (std::size_t slot = 0; slot < slot_particles_.size(); ++slot) {
    meeting_[static_cast<std::size_t>(next[row(slot_particles_[slot])]++)] = static_cast<std::int32_t>(slot);
  }
}

// Each patch takes the first colour that no neighbour before it has.
void Patches::find_colors() {
  std::vector<std::int32_t> patch_of(slot_particles_.size()), color_of(patches_.size(), -1);
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    std::fill_n(patch_of.begin() + patches_[p].first_slot, patches_[p].slots, static_cast<std::int32_t>(p));
  }
  std::vector<std::uint8_t> taken;
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    taken.assign(colors_.size() + 1, 0);
    for (std::int32_t slot = patches_[p].first_slot; slot < patches_[p].first_slot + patches_[p].slots; ++slot) {
      const auto i = static_cast<std::size_t>(slot_particles_[static_cast<std::size_t>(slot)] - particles_.first);
      for (std::int32_t m = meeting_starts_[i]; m < meeting_starts_[i + 1]; ++m) {
        const std::int32_t other = patch_of[static_cast<std::size_t>(meeting_[static_cast<std::size_t>(m)])];
        const std::int32_t color = color_of[static_cast<std::size_t>(other)];
        if (color >= 0) taken[static_cast<std::size_t>(color)] = 1;
      }
    }
    const auto color = static_cast<std::size_t>(std::find(taken.begin(), taken.end(), 0) - taken.begin());
    color_of[p] = static_cast<std::int32_t>(color);
    if (color == colors_.size()) colors_.emplace_back();
    colors_[color].push_back(static_cast<std::int32_t>(p));
  }
}

void Patches::copy(const Patch& patch, const VecX& x, double* local) const {
  const std::int32_t* particle = slot_particles_.data() + patch.first_slot;
  const double* all = x.data();
  for (std::int32_t i = 0; i < patch.slots; ++i) {
    const double* from = all + 3 * static_cast<std::int64_t>(particle[i]);
    local[4 * i] = from[0];
    local[4 * i + 1] = from[1];
    local[4 * i + 2] = from[2];
    local[4 * i + 3] = 0.0;
  }
}

void Patches::copy_back(const Patch& patch, const double* local, VecX& x) const {
  const std::int32_t* particle = slot_particles_.data() + patch.first_slot;
  for (std::int32_t i = 0; i < patch.slots; ++i) {
    std::copy_n(local + 4 * i, 3, x.data() + 3 * static_cast<std::int64_t>(particle[i]));
  }
}

void Patches::gather(const Patch& patch, const double* rows) const {
  const auto first = static_cast<std::size_t>(patch.first_slot);
  gather_rows(patch.slots, row_counts_.data() + 2 * first, rows_.data() + patch.first_row, rows,
              partial_.data() + 3 * first);
}

void Patches::collect(VecX& f) const {
  double* all = f.data() + 3 * static_cast<std::int64_t>(particles_.first);
  const double* partial = partial_.data();
  parallel_for(particles_.count, 4096, [&](std::int64_t first, std::int64_t end) {
    for (std::int64_t i = first; i < end; ++i) {
      double x = all[3 * i], y = all[3 * i + 1], z = all[3 * i + 2];
      for (std::int32_t k = meeting_starts_[i]; k < meeting_starts_[i + 1]; ++k) {
        const double* from = partial + 3 * static_cast<std::int64_t>(meeting_[k]);
        x += from[0];
        y += from[1];
        z += from[2];
      }
      all[3 * i] = x;
      all[3 * i + 1] = y;
      all[3 * i + 2] = z;
    }
  });
}

}  // namespace flexcast
