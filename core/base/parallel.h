// Threads for loops whose pieces do not depend on each other. Results never depend on the number of threads: a piece
// writes only what is its own, and sums are made of fixed blocks, added in order.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace flexcast {

// Of the whole process, at least 1. Not to be called while a loop runs.
void set_thread_count(int threads);
int thread_count();

// A function of a range [first, end), by reference.
class RangeBody {
 public:
  template <class Body>
  RangeBody(Body& body)  // NOLINT(google-explicit-constructor): made where a loop is started
      : object_(&body),
        call_([](void* object, std::int64_t first, std::int64_t end) { (*static_cast<Body*>(object))(first, end); }) {}
  void operator()(std::int64_t first, std::int64_t end) const { call_(object_, first, end); }

 private:
  void* object_;
  void (*call_)(void*, std::int64_t, std::int64_t);
};

// Calls body(first, end) for ranges that make up [0, count), none shorter than `grain` but the last; on this thread
// alone when there is only one.
void run_parallel(std::int64_t count, std::int64_t grain, RangeBody body);

template <class Body>
void parallel_for(std::int64_t count, std::int64_t grain, Body body) {
  if (count <= grain || thread_count() == 1) {
    if (count > 0) body(std::int64_t{0}, count);
  } else {
    run_parallel(count, grain, body);
  }
}

// The sum of body(first, end) over blocks of `block` items, in their order. `partial` is scratch to be kept.
template <class Body>
double parallel_sum(std::int64_t count, std::int64_t block, std::vector<double>& partial, Body body) {
  const std::int64_t blocks = (count + block - 1) / block;
  partial.resize(static_cast<std::size_t>(blocks));
  parallel_for(blocks, 1, [&](std::int64_t first, std::int64_t end) {
    for (std::int64_t b = first; b < end; ++b) {
      partial[static_cast<std::size_t>(b)] = body(b * block, std::min(count, (b + 1) * block));
    }
  });
  double sum = 0.0;
  for (const double value : partial) sum += value;
  return sum;
}

}  // namespace flexcast
