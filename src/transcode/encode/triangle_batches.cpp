#include "transcode/encode/triangle_batches.h"

#include <vector>

namespace imgeo {

void visitBatches(const TriangleVisits& triangles, const std::function<void(TriangleBatch)>& visit) {
  constexpr std::size_t batchSize = std::size_t{1} << 16;
  std::vector<TexturedTriangle> batch;
  triangles([&](const TexturedTriangle& triangle) {
    batch.push_back(triangle);
    if (batch.size() == batchSize) {
      visit(batch);
      batch.clear();
    }
  });
  if (!batch.empty())
    visit(batch);
}

} // namespace imgeo
