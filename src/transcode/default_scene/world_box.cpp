#include "transcode/default_scene/world_box.h"

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
    for (int corner = 0; corner < 8; ++corner)
      world.box.add(
          instance.worldFromShape.point({corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                                         corner & 4 ? box.max.z : box.min.z}));
  }
  return world;
}

} // namespace imgeo
