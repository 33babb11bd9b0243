#include "idl/wire/memory.h"

#include <malloc.h>

namespace flexcast::wire {
namespace {

constexpr int largest_kept = 32 << 20;  // bytes, a block: the largest that glibc takes
constexpr int most_kept = 512 << 20;    // bytes, of each arena: twice the history of a writer

}  // namespace

void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, largest_kept);
  mallopt(M_TRIM_THRESHOLD, most_kept);
}

}  // namespace flexcast::wire
