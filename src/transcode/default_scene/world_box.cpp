#include "transcode/default_scene/world_box.h"

#include "base/box_corners.h"
#include "base/error.h"
#include "scene/shape_instances.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

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

void requireDrawable(const Box3d& worldBox, const std::string& location) {
  if (worldBox.empty())
    return;
  double reach = 0;
  for (const Vec3d& corner : {worldBox.min, worldBox.max})
    reach = std::max({reach, std::abs(corner.x), std::abs(corner.y), std::abs(corner.z)});
  if (!(reach <= maxDrawableLength))
    throw Error(ErrorKind::limit, location,
                fmt::format("its coordinates reach {:.3g}, and pages draw, in single precision, none beyond {:.0e}; "
                            "scale the source down",
                            reach, maxDrawableLength));
}

} // namespace imgeo
