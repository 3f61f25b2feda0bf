#include "transcode/default_scene/world_box.h"

#include "scene/shape_instances.h"

#include <cmath>

namespace imgeo {

namespace {

/// Range of the scales of shapes that can be drawn together in single precision.
constexpr double minScale = 1e-15, maxScale = 1e15;

bool canBeDrawn(const Affine3d& worldFromShape) {
  for (const Vec3d& axis : {worldFromShape.x, worldFromShape.y, worldFromShape.z}) {
    const double scale = length(axis);
    if (!(scale <= maxScale) || (scale > 0 && scale < minScale))
      return false;
  }
  return length(worldFromShape.translation) <= maxScale;
}

} // namespace

WorldBox worldBoxOf(const SceneDocument& document) {
  WorldBox world;
  for (const ShapeInstance& instance : shapeInstances(document.graph)) {
    const Box3d& box = document.geometries[shapeOf(document.graph, instance.node).mesh].box;
    if (!canBeDrawn(instance.worldFromShape)) {
      ++world.undrawableShapes;
      continue;
    }
    for (int corner = 0; corner < 8; ++corner)
      world.box.add(
          instance.worldFromShape.point({corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                                         corner & 4 ? box.max.z : box.min.z}));
  }
  return world;
}

} // namespace imgeo
