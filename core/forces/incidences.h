// Which elements meet at each particle of a body, and as which of their nodes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/math.h"

namespace flexcast {

struct Incidence {
  std::int32_t element = 0;
  std::int32_t node = 0;  // of the element
};

class Incidences {
 public:
  // Elements with a member `nodes`, all in `particles`. Ascending elements at every particle.
  template <class Elements>
  Incidences(IndexRange particles, const Elements& elements)
      : particles_(particles), starts_(static_cast<std::size_t>(particles.count) + 1, 0) {
    for (const auto& e : elements) {
      for (const std::int32_t particle : e.nodes) ++starts_[row(particle) + 1];
    }
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    entries_.resize(starts_.back());
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    for (std::size_t e = 0; e < elements.size(); ++e) {
      for (std::size_t a = 0; a < elements[e].nodes.size(); ++a) {
        entries_[next[row(elements[e].nodes[a])]++] = {static_cast<std::int32_t>(e), static_cast<std::int32_t>(a)};
      }
    }
  }

  // Nothing for particles of other bodies.
  std::span<const Incidence> at(std::int32_t particle) const {
    if (particle < particles_.first || particle >= particles_.end()) return {};
    return {entries_.data() + starts_[row(particle)], entries_.data() + starts_[row(particle) + 1]};
  }

 private:
  std::size_t row(std::int32_t particle) const { return static_cast<std::size_t>(particle - particles_.first); }

  IndexRange particles_;
  std::vector<std::size_t> starts_;
  std::vector<Incidence> entries_;
};

}  // namespace flexcast
