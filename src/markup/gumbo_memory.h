#pragma once
// The memory and the time of one run of gumbo, the HTML5 parser.

#include <csetjmp>
#include <cstddef>

namespace imgeo {

/// Hands out memory up to a limit of bytes and of processor time, and frees all of it at its end. HTML5 takes quadratic
/// time for elements that are nested without end; every token takes memory, so this is where time can be checked. gumbo
/// is C code that cannot report a failed allocation: at a limit `allocate` jumps to `exhausted`, which the caller of
/// gumbo has set. Blocks are kept in a list, since gumbo frees a tree by recursion, as deep as the tree.
class GumboMemory {
public:
  GumboMemory(std::size_t maxBytes, double maxSeconds);
  ~GumboMemory();
  GumboMemory(const GumboMemory&) = delete;
  GumboMemory& operator=(const GumboMemory&) = delete;

  std::jmp_buf exhausted;

  // gumbo's callbacks: `memory` is a GumboMemory.
  static void* allocate(void* memory, std::size_t bytes);
  static void release(void* memory, void* block);

private:
  /// What precedes each block.
  struct alignas(std::max_align_t) Header {
    Header *previous, *next;
    std::size_t bytes;
  };

  std::size_t bytesLeft_;
  double endSeconds_; ///< of the thread's processor time
  std::size_t allocations_ = 0;
  Header* first_ = nullptr;
};

} // namespace imgeo
