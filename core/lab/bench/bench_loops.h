// What the engine's forces are measured against: the same forces by a plain loop, and a copy of the memory they need.
#pragma once

#include <memory>
#include <vector>

#include "core/forces/model.h"

namespace flexcast {

// One body's elastic forces, element by element as a textbook says: no batches, no vectors, one thread.
class PlainLoop {
 public:
  virtual ~PlainLoop() = default;
  // f += the conservative force of every element at x.
  virtual void add_force(const VecX& x, VecX& f) const = 0;
};

// One per body.
std::vector<std::unique_ptr<PlainLoop>> make_plain_loops(const Model& model);

// Bytes that an evaluation of the elastic forces touches at least: of a tetrahedron its nodes, nine numbers of its
// rest shape and its volume; of a spring its ends and its rest length; of a particle its position and its force.
std::int64_t calc_touched_bytes(const Model& model);

// Tetrahedra and springs.
std::int64_t count_elements(const Model& model);

// Copies bytes from one place to another, by as many threads as the engine uses.
class Copy {
 public:
  explicit Copy(std::int64_t bytes);
  void run();

 private:
  std::vector<char> from_, to_;
};

}  // namespace flexcast
