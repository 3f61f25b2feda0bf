#pragma once
// Settings of the memory allocator for a program that allocates much and ends soon: docs/decisions/compact.md.

namespace imgeo::cli {

/// Makes the allocator use large pages, if the system provides them on request, and keep freed memory for later
/// allocations. Call it once, before large allocations. Has no effect if the system refuses.
void prepareHeap();

} // namespace imgeo::cli
