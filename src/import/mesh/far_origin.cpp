#include "import/mesh/far_origin.h"

#include "import/mesh/metadata_set.h"

#include <cmath>

namespace imgeo {

namespace {

constexpr double minFar = 0x1p16, maxFar = 0x1p40;

} // namespace

Vec3d farOriginOf(const Vec3d& first) {
  Vec3d origin{0, 0, 0};
  for (int axis = 0; axis < 3; ++axis)
    if (const double distance = std::abs(first[axis]); distance >= minFar && distance < maxFar)
      origin[axis] = std::floor(first[axis]);
  return origin;
}

void setOrigin(Imported& imported, const Vec3d& origin) {
  imported.origin = origin;
  SceneGraph& graph = imported.scene.graph;
  if (origin == Vec3d{0, 0, 0} || graph.roots.empty())
    return;
  MetadataSet set(graph);
  set.addPoint("origin", origin);
  set.addTo(graph.roots.front(), georeferenceName);
}

} // namespace imgeo
