#include "transcode/default_scene/world_box.h"

#include "base/box_corners.h"
#include "scene/shape_instances.h"

namespace imgeo {

WorldBox worldBoxOf(const SceneDocument& document) {
  WorldBox world;
  for (const ShapeInstance& instance : shapeInstances(document.graph)) {
    const Shape& shape = shapeOf(document.graph, instance.node);
    const Box3d& box = shape.movingBox.empty() ? document.geometries[shape.mesh].box : shape.movingBox;
    if (!isDrawable(instance.worldFromShape)) {
      ++world.undrawableShapes;
      continue;
    }
    for (const Vec3d& corner : cornersOf(box))
      world.box.add(instance.worldFromShape.point(corner));
  }
  return world;
}

} // namespace imgeo
