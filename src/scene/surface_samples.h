#pragma once
// Points spread evenly over the surfaces of a scene. They stand for its shape where an estimate is enough, at a cost
// that hardly depends on the number of triangles.

#include "scene/scene.h"

#include <vector>

namespace imgeo {

struct SurfaceSample {
  Vec3d point;          ///< world coordinates
  Vec3f normal;         ///< of the triangle, by its winding, unit length; (0, 0, 0) for samples of lines and points
  bool isSolid = false; ///< X3D `solid`: the back of the triangle is not visible
};

/// About `count` samples of all shape instances that can be drawn (isDrawable), in world coordinates, as many per area
/// everywhere; where a transform scales its axes differently, nearly as many. A scene without area is sampled along its
/// lines, one without lines at its points. Fewer for scenes of fewer points. Equal scenes have equal samples. Takes
/// time in proportion to the elements of all meshes and the number of instances.
std::vector<SurfaceSample> surfaceSamples(const Scene& scene, std::size_t count);

} // namespace imgeo
