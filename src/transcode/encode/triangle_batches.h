#pragma once
// Visits triangles many at a time, so that loops over them run on all threads.

#include "transcode/encode/chart_triangle.h"

#include "base/parallel.h"

#include <functional>
#include <mutex>
#include <span>

namespace imgeo {

using TriangleBatch = std::span<const TexturedTriangle>;

/// Calls visit(batch) for consecutive triangles, of which memory holds some 65,000 at a time.
void visitBatches(const TriangleVisits& triangles, const std::function<void(TriangleBatch)>& visit);

/// Adds up what blocks of the triangles have, in any order: add(part, triangle) for each triangle of a block, then
/// join(sum, part), one at a time.
template <typename Sum, typename Add, typename Join>
void addTriangles(const TriangleVisits& triangles, Sum& sum, const Add& add, const Join& join) {
  std::mutex mutex;
  visitBatches(triangles, [&](TriangleBatch batch) {
    parallelForBlocks(batch.size(), [&](std::size_t begin, std::size_t end) {
      Sum part{};
      for (const TexturedTriangle& triangle : batch.subspan(begin, end - begin))
        add(part, triangle);
      const std::lock_guard lock(mutex);
      join(sum, part);
    });
  });
}

} // namespace imgeo
