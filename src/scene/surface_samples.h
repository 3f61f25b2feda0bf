#pragma once
// Points spread evenly over the surfaces of a scene. They stand for its shape where an estimate is enough, at a cost
// that hardly depends on the number of triangles.

#include "scene/scene.h"
#include "scene/shape_instances.h"
#include "scene/stored_meshes.h"

#include <array>
#include <vector>

namespace imgeo {

struct SurfaceSample {
  Vec3d point;          ///< world coordinates
  Vec3f normal;         ///< of the triangle, by its winding, unit length; (0, 0, 0) for samples of lines and points
  bool isSolid = false; ///< X3D `solid`: the back of the triangle is not visible

  std::size_t shape = 0;                 ///< index of its Shape in SceneGraph::nodes
  std::size_t firstCorner = 0;           ///< of its triangle, line or point: index into Mesh::corners
  std::array<float, 3> weights{1, 0, 0}; ///< barycentric coordinates in its triangle or line
};

/// Samples of the elements of one topology.
struct TopologySamples {
  std::vector<SurfaceSample> samples;
  double size = 0; ///< area of the triangles, length of the lines or number of the points, in world units
};

/// About `count` samples of those elements of the instances that have a topology; fewer if there are fewer points. The
/// samples of an instance that cannot be drawn (isDrawable) are left out. `stored`: meshes that are on the disk.
TopologySamples surfaceSamples(const Scene& scene, const std::vector<ShapeInstance>& instances, Topology topology,
                               std::size_t count, const StoredMeshes* stored = nullptr);

/// About `count` samples of all shape instances that can be drawn (isDrawable), in world coordinates, as many per area
/// everywhere; where a transform scales its axes differently, nearly as many. A scene without area is sampled along its
/// lines, one without lines at its points. Fewer for scenes of fewer points. Equal scenes have equal samples. Takes
/// time in proportion to the elements of all meshes and the number of instances.
std::vector<SurfaceSample> surfaceSamples(const Scene& scene, std::size_t count, const StoredMeshes* stored = nullptr);

} // namespace imgeo
