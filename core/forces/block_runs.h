// What a force gives vertex block descent, in lanes: a lane is a particle, so that what meets at it is added up in a
// fixed order and eight particles that do not feel each other are taken at a time.
#pragma once

#include <span>
#include <vector>

#include "core/base/math.h"

namespace flexcast {

// All particles in the order of their visits, in runs; none feels another of its run.
struct Visits {
  static constexpr std::int32_t most_in_run = 64;

  std::vector<std::int32_t> particles;
  std::vector<std::int32_t> starts;  // of the runs, and the end of the last one

  std::int32_t run_count() const { return static_cast<std::int32_t>(starts.size()) - 1; }
  std::span<const std::int32_t> run(std::int32_t r) const {
    const auto first = static_cast<std::size_t>(starts[static_cast<std::size_t>(r)]);
    return std::span(particles).subspan(first,
                                        static_cast<std::size_t>(starts[static_cast<std::size_t>(r) + 1]) - first);
  }
};

// Positions x and velocities v are four doubles a particle of the world, x, y, z and 0, from the beginning of a cache
// line on. Entry i of f and K belongs to particle i of the run. Any thread may call any of these at any time.
class BlockRuns {
 public:
  virtual ~BlockRuns() = default;

  // f[i] += conservative force, K[i] += the diagonal block of the stiffness: of the exact one, or of one that is
  // positive definite and not below it.
  virtual void add(std::int32_t run, const double* x, std::span<Vec3> f, std::span<Mat3> K) const = 0;
  // For a block that turned out not to be positive: K += the positive semidefinite one at particle i of the run - what
  // add() gave.
  virtual void make_positive(std::int32_t /*run*/, std::int32_t /*i*/, const double* /*x*/, Mat3& /*K*/) const {}
  // As Force::add_damping_blocks.
  virtual void add_damping(std::int32_t /*run*/, const double* /*x*/, const double* /*v*/, double /*scale*/,
                           std::span<Vec3> /*f*/, std::span<Mat3> /*K*/) const {}
};

}  // namespace flexcast
