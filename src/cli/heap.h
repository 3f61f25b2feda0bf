#pragma once
// What the allocator may do with the memory of this program, which takes much at once
// and soon ends: docs/decisions/compact.md, "Where an encoder's time goes".

namespace imgeo::cli {

/// Lets the allocator have large pages where the system gives them when they are asked
/// for, and keep what is freed for what comes next. To be called once, before anything
/// large is allocated. Where the system refuses, nothing changes.
void prepareHeap();

} // namespace imgeo::cli
