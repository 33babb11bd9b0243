// Groups of up to eight particles of a run, a lane each, and the rows of what meets at them: row k of a group has the
// k-th element or spring of every lane. Lanes without a particle, or with fewer elements than the group has rows,
// repeat one that is there and weigh nothing.
#pragma once

#include <span>
#include <vector>

#include "core/forces/block_runs.h"

namespace flexcast {

struct BlockGroup {
  static constexpr int lanes = 8;

  std::int64_t first_row = 0;
  std::int32_t rows = 0;
  std::int32_t kind = 0;          // the maker's
  std::int32_t particles[lanes];  // of the world
  std::int32_t places[lanes];     // in the run; -1: none
};

class BlockGroups {
 public:
  // kind_of(particle): -1, nothing meets there; else only those of a kind share a group. count_of(particle): how much
  // meets there.
  template <class Kind, class Count>
  BlockGroups(const Visits& visits, Kind kind_of, Count count_of);
  BlockGroups() = default;

  std::int64_t row_count() const { return rows_; }
  std::span<const BlockGroup> all() const { return groups_; }
  std::span<const BlockGroup> run(std::int32_t r) const {
    const auto first = static_cast<std::size_t>(starts_[static_cast<std::size_t>(r)]);
    const auto end = static_cast<std::size_t>(starts_[static_cast<std::size_t>(r) + 1]);
    return std::span(groups_).subspan(first, end - first);
  }

 private:
  std::vector<BlockGroup> groups_;
  std::vector<std::int32_t> starts_;
  std::int64_t rows_ = 0;
};

template <class Kind, class Count>
BlockGroups::BlockGroups(const Visits& visits, Kind kind_of, Count count_of) {
  constexpr int kinds = 2;
  starts_.push_back(0);
  for (std::int32_t r = 0; r < visits.run_count(); ++r) {
    const std::span<const std::int32_t> run = visits.run(r);
    for (int kind = 0; kind < kinds; ++kind) {
      int lane = BlockGroup::lanes;
      for (std::size_t i = 0; i < run.size(); ++i) {
        if (kind_of(run[i]) != kind) continue;
        if (lane == BlockGroup::lanes) {
          groups_.emplace_back().kind = kind;
          for (int k = 0; k < BlockGroup::lanes; ++k)
            groups_.back().particles[k] = run[i], groups_.back().places[k] = -1;
          lane = 0;
        }
        BlockGroup& group = groups_.back();
        group.particles[lane] = run[i];
        group.places[lane++] = static_cast<std::int32_t>(i);
        group.rows = std::max(group.rows, static_cast<std::int32_t>(count_of(run[i])));
      }
    }
    starts_.push_back(static_cast<std::int32_t>(groups_.size()));
  }
  groups_.shrink_to_fit();
  for (BlockGroup& group : groups_) {
    group.first_row = rows_;
    rows_ += group.rows;
  }
}

}  // namespace flexcast
