#include "transcode/out_of_core/large_meshes.h"

#include "transcode/encode/levels.h"

#include <algorithm>

namespace imgeo {

std::vector<std::size_t> largeMeshes(const ChunkedSource& source, const ConvertOptions& options) {
  const std::uint64_t withoutLevels =
      options.levels == LevelChoice::always ? options.groupTriangles : maxElementsWithoutLevels;
  std::vector<std::size_t> large;
  for (std::size_t i = 0; i < source.meshCount(); ++i)
    if (source.mesh(i).elementCount() > std::max<std::uint64_t>(withoutLevels, options.regionTriangles))
      large.push_back(i);
  return large;
}

std::uint64_t elementsOf(const ChunkedSource& source, std::span<const std::size_t> meshes) {
  std::uint64_t elements = 0;
  for (const std::size_t mesh : meshes)
    elements += source.mesh(mesh).elementCount();
  return elements;
}

} // namespace imgeo
