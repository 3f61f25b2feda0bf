#include "cli/heap.h"

#include <cstdint>
#include <cstdlib>
#include <malloc.h>
#include <sys/mman.h>

namespace imgeo::cli {

namespace {

/// Size of the reserved address range. Pages that are never written take no memory.
constexpr std::uintptr_t heapBytes = 64 << 20;
constexpr std::uintptr_t largePageBytes = 2 << 20;

} // namespace

void prepareHeap() {
  // One heap for all threads, so that a thread reuses memory that another one has freed. Small allocations are rare, so
  // threads seldom wait for each other.
  mallopt(M_ARENA_MAX, 1);
  // By default, freed memory at the end of the heap and separately mapped blocks return to the system, and the next
  // allocation has to get them back page by page.
  mallopt(M_TRIM_THRESHOLD, 2 * heapBytes);
  mallopt(M_MMAP_THRESHOLD, heapBytes / 2);
  mallopt(M_TOP_PAD, heapBytes);
  void* const first = std::malloc(largePageBytes); // makes the heap grow
  mallopt(M_TOP_PAD, largePageBytes);
  if (first) {
    const std::uintptr_t begin = (reinterpret_cast<std::uintptr_t>(first) + largePageBytes - 1) & ~(largePageBytes - 1);
    // NOLINTNEXTLINE(performance-no-int-to-ptr): std::align takes a size, and madvise goes beyond what malloc gave.
    madvise(reinterpret_cast<void*>(begin), heapBytes, MADV_HUGEPAGE);
  }
  std::free(first);
}

} // namespace imgeo::cli
