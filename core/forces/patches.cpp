#include "core/forces/patches.h"

#include <algorithm>
#include <bitset>
#include <numeric>

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

Patches::Patches(std::span<const std::int32_t> nodes, int nodes_per_element, std::int32_t most_elements,
                 const VecX& rest_positions, IndexRange particles)
    : nodes_per_element_(nodes_per_element), particles_(particles) {
  const std::vector<std::int32_t> order = make_order(nodes, nodes_per_element, rest_positions, particles);
  const auto n = static_cast<std::size_t>(nodes_per_element);
  const auto nodes_of = [&](std::int32_t e) { return nodes.subspan(static_cast<std::size_t>(e) * n, n); };

  std::vector<std::int32_t> place_of(static_cast<std::size_t>(particles.count), -1);
  std::size_t begin = 0;
  while (begin < order.size()) {
    // As many elements as fit.
    std::vector<std::int32_t> mine;
    std::size_t end = begin;
    for (; end < order.size() && end - begin < static_cast<std::size_t>(most_elements); ++end) {
      const std::size_t before = mine.size();
      for (const std::int32_t particle : nodes_of(order[end])) {
        std::int32_t& place = place_of[static_cast<std::size_t>(particle - particles.first)];
        if (place < 0) place = 0, mine.push_back(particle);
      }
      if (mine.size() > static_cast<std::size_t>(most_slots)) {
        for (std::size_t k = before; k < mine.size(); ++k)
          place_of[static_cast<std::size_t>(mine[k] - particles.first)] = -1;
        mine.resize(before);
        break;
      }
    }
    std::sort(mine.begin(), mine.end());
    for (std::size_t k = 0; k < mine.size(); ++k) {
      place_of[static_cast<std::size_t>(mine[k] - particles.first)] = static_cast<std::int32_t>(k);
    }
    const auto first_batch = static_cast<std::int32_t>(batch_count());
    add_batches({order.data() + begin, end - begin}, [&](std::int32_t e, std::size_t a) {
      return static_cast<std::uint16_t>(place_of[static_cast<std::size_t>(nodes_of(e)[a] - particles.first)]);
    });
    patches_.push_back({first_batch, static_cast<std::int32_t>(batch_count()) - first_batch,
                        static_cast<std::int32_t>(slot_particles_.size()), static_cast<std::int32_t>(mine.size())});
    slot_particles_.insert(slot_particles_.end(), mine.begin(), mine.end());
    for (const std::int32_t particle : mine) place_of[static_cast<std::size_t>(particle - particles.first)] = -1;
    begin = end;
  }

  meeting_starts_.assign(static_cast<std::size_t>(particles.count) + 1, 0);
  for (const std::int32_t particle : slot_particles_)
    ++meeting_starts_[static_cast<std::size_t>(particle - particles.first) + 1];
  std::partial_sum(meeting_starts_.begin(), meeting_starts_.end(), meeting_starts_.begin());
  std::vector<std::int32_t> next(meeting_starts_.begin(), meeting_starts_.end() - 1);
  meeting_.resize(slot_particles_.size());
  for (std::size_t slot = 0; slot < slot_particles_.size(); ++slot) {
    meeting_[static_cast<std::size_t>(next[static_cast<std::size_t>(slot_particles_[slot] - particles.first)]++)] =
        static_cast<std::int32_t>(slot);
  }

  // Each patch takes the first colour that no neighbour before it has.
  std::vector<std::int32_t> patch_of_slot(slot_particles_.size()), color_of(patches_.size(), -1);
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    std::fill_n(patch_of_slot.begin() + patches_[p].first_slot, patches_[p].slots, static_cast<std::int32_t>(p));
  }
  std::vector<std::uint8_t> taken;
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    taken.assign(colors_.size() + 1, 0);
    for (std::int32_t k = 0; k < patches_[p].slots; ++k) {
      const auto i = static_cast<std::size_t>(slot_particles_[static_cast<std::size_t>(patches_[p].first_slot + k)] -
                                              particles.first);
      for (std::int32_t m = meeting_starts_[i]; m < meeting_starts_[i + 1]; ++m) {
        const std::int32_t other = color_of[static_cast<std::size_t>(
            patch_of_slot[static_cast<std::size_t>(meeting_[static_cast<std::size_t>(m)])])];
        if (other >= 0) taken[static_cast<std::size_t>(other)] = 1;
      }
    }
    const auto color = static_cast<std::size_t>(std::find(taken.begin(), taken.end(), 0) - taken.begin());
    color_of[p] = static_cast<std::int32_t>(color);
    if (color == colors_.size()) colors_.emplace_back();
    colors_[color].push_back(static_cast<std::int32_t>(p));
  }

  elements_.shrink_to_fit();
  places_.shrink_to_fit();
  slot_particles_.shrink_to_fit();
  partial_.resize(3 * slot_particles_.size());
}

// Each element goes to the first batch that has room and none of its particles.
template <class Place>
void Patches::add_batches(std::span<const std::int32_t> mine, Place place) {
  struct Batch {
    std::vector<std::int32_t> elements;
    std::bitset<most_slots> taken;
  };
  const auto n = static_cast<std::size_t>(nodes_per_element_);
  std::vector<Batch> batches;
  std::size_t first_open = 0;
  for (const std::int32_t e : mine) {
    std::bitset<most_slots> own;
    for (std::size_t a = 0; a < n; ++a) own.set(place(e, a));
    while (first_open < batches.size() && batches[first_open].elements.size() == lanes) ++first_open;
    std::size_t b = first_open;
    while (b < batches.size() && (batches[b].elements.size() == lanes || (batches[b].taken & own).any())) ++b;
    if (b == batches.size()) batches.emplace_back();
    batches[b].elements.push_back(e);
    batches[b].taken |= own;
  }
  for (const Batch& batch : batches) {
    const auto element = [&](std::size_t lane) { return batch.elements[std::min(lane, batch.elements.size() - 1)]; };
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      elements_.push_back(lane < batch.elements.size() ? element(lane) : -1 - element(lane));
    }
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t lane = 0; lane < lanes; ++lane) places_.push_back(place(element(lane), a));
    }
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

void Patches::put(const Patch& patch, const double* local) const {
  double* to = partial_.data() + 3 * static_cast<std::int64_t>(patch.first_slot);
  for (std::int32_t i = 0; i < patch.slots; ++i) {
    to[3 * i] = local[4 * i];
    to[3 * i + 1] = local[4 * i + 1];
    to[3 * i + 2] = local[4 * i + 2];
  }
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
