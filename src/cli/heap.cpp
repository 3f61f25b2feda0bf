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
/// More than the heap holds when the process starts, so that a block of this size makes it grow.
constexpr std::uintptr_t firstBlockBytes = 1 << 20;
constexpr std::uintptr_t chunkHeaderBytes = 16;

/// What lies before the first large page. It is never written, and takes no memory. `volatile`: compilers leave out an
/// allocation that nothing reads.
void* volatile gap = nullptr;

} // namespace

void prepareHeap() {
  // One heap for all threads, so that a thread reuses memory that another one has freed. Small allocations are rare, so
  // threads seldom wait for each other.
  mallopt(M_ARENA_MAX, 1);
  // By default, freed memory at the end of the heap and separately mapped blocks return to the system, and the next
  // allocation has to get them back page by page.
  mallopt(M_TRIM_THRESHOLD, 2 * heapBytes);
  mallopt(M_MMAP_THRESHOLD, heapBytes / 2);
  mallopt(M_TOP_PAD, heapBytes + 2 * largePageBytes);
  void* const first = std::malloc(firstBlockBytes); // makes the heap grow
  mallopt(M_TOP_PAD, largePageBytes);
  if (!first)
    return;
  // The allocator has written what follows the block: the large page around that has small ones already.
  const auto address = reinterpret_cast<std::uintptr_t>(first);
  const std::uintptr_t written = address + firstBlockBytes + chunkHeaderBytes;
  const std::uintptr_t begin = (written + largePageBytes - 1) & ~(largePageBytes - 1);
  // NOLINTNEXTLINE(performance-no-int-to-ptr): std::align takes a size, and madvise goes beyond what malloc gave.
  madvise(reinterpret_cast<void*>(begin), heapBytes, MADV_HUGEPAGE);
  std::free(first);
  gap = std::malloc(begin - address - chunkHeaderBytes); // the next block begins at a large page
}

} // namespace imgeo::cli
