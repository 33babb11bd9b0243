#include "core/sim/failure_search.h"

#include <algorithm>
#include <cmath>

namespace flexcast {
namespace {

bool is_good(double value) {
  return std::abs(value) <= largest_magnitude;
}  // false for NaN

std::int64_t find_bad_particle(const State& state) {
  for (std::int64_t i = 0; i < state.positions.size(); ++i) {
    if (!is_good(state.positions[i]) || !is_good(state.velocities[i])) return i / 3;
  }
  return -1;
}

template <class Element>
std::int64_t find_element(const std::vector<Element>& elements, IndexRange range, std::int64_t particle) {
  for (std::int32_t e = range.first; e < range.end(); ++e) {
    if (std::find(elements[e].begin(), elements[e].end(), particle) != elements[e].end()) return e - range.first;
  }
  return -1;
}

}  // namespace

Failure find_failure(const Model& model, const State& before, const State& after) {
  Failure failure;
  std::int64_t particle = find_bad_particle(after);
  if (particle < 0) {
    failure.cause = "the implicit solver met numbers that are not finite";
    before.velocities.cwiseAbs().maxCoeff(&particle);
    particle /= 3;
  } else {
    const auto x = block3(after.positions, particle);
    const auto v = block3(after.velocities, particle);
    const bool finite = x.allFinite() && v.allFinite();
    const bool in_position = !(is_good(x[0]) && is_good(x[1]) && is_good(x[2]));
    failure.cause = std::string(in_position ? "a position" : "a velocity") +
                    (finite ? " passed 1e38 (the range of single precision)" : " is not finite");
  }
  const Body* body = find_body_of_particle(model, particle);
  failure.body = body->name;
  failure.particle = particle - body->particles.first;
  failure.position = block3(before.positions, particle);
  failure.element = body->is_fem() ? find_element(model.tetrahedra, body->tetrahedra, particle)
                                   : find_element(model.springs, body->springs, particle);
  return failure;
}

}  // namespace flexcast
