#pragma once
// The one parallel loop.

#include <cstddef>
#include <functional>

namespace imgeo {

/// Calls body(i) for every i in 0..count-1, on as many threads as the machine (or
/// `limitThreads`) gives. The first exception thrown by a body is rethrown here.
/// Results must not depend on the order of calls: write to slot i.
void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body);

/// The same in blocks: calls body(begin, end) for consecutive ranges that cover
/// 0..count-1, for bodies too short to be called once an index.
void parallelForBlocks(std::size_t count, const std::function<void(std::size_t, std::size_t)>& body);

/// Bounds the threads of every later parallelFor in this process; 0 lifts the bound.
void limitThreads(std::size_t count);

} // namespace imgeo
