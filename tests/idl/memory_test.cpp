#include "idl/wire/memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <cstring>
#include <thread>
#include <vector>

namespace flexcast::wire {
namespace {

constexpr std::size_t page = 4096;

long count_faults() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt;
}

// Frames of eight chunks, all of which are given back before the next comes.
long write_and_free_frames(int frames, std::size_t chunk_bytes) {
  const long before = count_faults();
  for (int frame = 0; frame < frames; ++frame) {
    std::vector<void*> chunks(8);
    for (void*& chunk : chunks) {
      chunk = std::malloc(chunk_bytes);
      if (chunk != nullptr) std::memset(chunk, frame, chunk_bytes);
    }
    for (void* chunk : chunks) std::free(chunk);
  }
  return count_faults() - before;
}

TEST(Memory, OfFramesThatWereSentServesTheNextOnesInEveryThread) {
#ifdef FLEXCAST_SANITIZED
  GTEST_SKIP() << "the sanitizer's own allocator";
#endif
  keep_freed_memory();
  for (const std::size_t chunk_bytes : {std::size_t{240'000}, std::size_t{1} << 20}) {
    const long of_one_frame = static_cast<long>(8 * chunk_bytes / page);
    std::thread([&] { EXPECT_LT(write_and_free_frames(50, chunk_bytes), 2 * of_one_frame); }).join();
    EXPECT_LT(write_and_free_frames(50, chunk_bytes), 2 * of_one_frame);
  }
}

}  // namespace
}  // namespace flexcast::wire
