// How often this program asks for memory.
#pragma once

#include <cstdint>

namespace flexcast::test {

// False where a sanitizer owns the allocator: nothing is counted then.
bool counts_allocations();

// Calls of malloc, calloc, realloc, aligned_alloc, posix_memalign and memalign so far, by all threads; operator new
// and Eigen come down to these.
std::int64_t allocation_count();

}  // namespace flexcast::test
