#include "core/base/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <memory>

namespace flexcast {
namespace {

struct Threads {
  int count = 1;
  std::unique_ptr<tbb::global_control> limit;  // oneTBB's own is the number of processors
  std::unique_ptr<tbb::task_arena> arena;      // none for one thread
};

Threads& threads() {
  static Threads one;
  return one;
}

}  // namespace

void set_thread_count(int count) {
  Threads& mine = threads();
  mine.count = std::max(1, count);
  mine.arena.reset();
  mine.limit.reset();
  if (mine.count == 1) return;
  mine.limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                     static_cast<std::size_t>(mine.count));
  mine.arena = std::make_unique<tbb::task_arena>(mine.count);
}

int thread_count() {
  return threads().count;
}

void run_parallel(std::int64_t count, std::int64_t grain, RangeBody body) {
  Threads& mine = threads();
  if (!mine.arena) return body(0, count);
  mine.arena->execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, count, static_cast<std::size_t>(grain)),
                      [&](const tbb::blocked_range<std::int64_t>& range) { body(range.begin(), range.end()); });
  });
}

}  // namespace flexcast
