#pragma once
// Parallel loops over an index range.

#include <cstddef>
#include <functional>

namespace imgeo {

/// Calls body(i) for every i in 0..count-1, on as many threads as the machine has or `limitThreads` allows. Rethrows an
/// exception of a body; a loop within another body runs to its end nevertheless. The order of calls is unspecified, and
/// calls run in parallel: body(i) must write only to data that belongs to i.
void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body);

/// Calls body(begin, end) for consecutive ranges that cover 0..count-1. For bodies that are too short for one call per
/// index.
void parallelForBlocks(std::size_t count, const std::function<void(std::size_t, std::size_t)>& body);

/// Bounds the threads of every later parallelFor in this process; 0 removes the bound.
void limitThreads(std::size_t count);

} // namespace imgeo
