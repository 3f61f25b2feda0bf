#include "cli/heap.h"

#include <cstdint>
#include <cstdlib>
#include <malloc.h>
#include <sys/mman.h>

namespace imgeo::cli {

namespace {

/// Addresses, not memory: what nothing is written to costs nothing.
constexpr std::uintptr_t heapBytes = 64 << 20;
constexpr std::uintptr_t largePageBytes = 2 << 20;

} // namespace

void prepareHeap() {
  // One heap for all threads, which ask for little that is not large: what one has freed
  // the next one uses.
  mallopt(M_ARENA_MAX, 1);
  // What is freed at the heap's end, or was mapped by itself, would go back to the system
  // only to be asked for again, page by page.
  mallopt(M_TRIM_THRESHOLD, 2 * heapBytes);
  mallopt(M_MMAP_THRESHOLD, heapBytes / 2);
  mallopt(M_TOP_PAD, heapBytes);
  void* const first = std::malloc(largePageBytes); // lets the heap grow
  mallopt(M_TOP_PAD, largePageBytes);
  if (first) {
    const std::uintptr_t begin = (reinterpret_cast<std::uintptr_t>(first) + largePageBytes - 1) & ~(largePageBytes - 1);
    // NOLINTNEXTLINE(performance-no-int-to-ptr): std::align takes a size, and madvise goes beyond what malloc gave.
    madvise(reinterpret_cast<void*>(begin), heapBytes, MADV_HUGEPAGE);
  }
  std::free(first);
}

} // namespace imgeo::cli
