#include "tests/allocation/counter.h"

#include <atomic>
#include <cerrno>
#include <cstddef>

#if defined(FLEXCAST_SANITIZED) || !defined(__GLIBC__)

namespace flexcast::test {
bool counts_allocations() {
  return false;
}
std::int64_t allocation_count() {
  return 0;
}
}  // namespace flexcast::test

#else

namespace {
std::atomic<std::int64_t> count = 0;  // initialised before anything runs
}

namespace flexcast::test {
bool counts_allocations() {
  return true;
}
std::int64_t allocation_count() {
  return count.load();
}
}  // namespace flexcast::test

// Functions of a program take the place of the C library's, which keeps its own under these names.
extern "C" {

void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t number, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* memory);

void* malloc(std::size_t size) {
  ++count;
  return __libc_malloc(size);
}

void* calloc(std::size_t number, std::size_t size) {
  ++count;
  return __libc_calloc(number, size);
}

void* realloc(void* old, std::size_t size) {
  ++count;
  return __libc_realloc(old, size);
}

void* memalign(std::size_t alignment, std::size_t size) {
  ++count;
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++count;
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  ++count;
  *memory = __libc_memalign(alignment, size);
  return *memory ? 0 : ENOMEM;
}

void free(void* memory) {
  __libc_free(memory);
}

}  // extern "C"

#endif
