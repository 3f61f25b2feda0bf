#pragma once
// Chooses the side from which a scene is shown first.

#include "imgeo/convert.h"
#include "scene/surface_samples.h"

#include <vector>

namespace imgeo {

/// What the default viewpoints are made from, while the meshes are in memory.
struct ViewSamples {
  std::vector<SurfaceSample> surface; ///< empty if no view is to be chosen
  std::vector<Vec3d> outline;         ///< points that all viewpoints show; empty: the whole box of the scene
  Box3d moving;                       ///< around the shapes at all moments of animations; empty where nothing moves
};

/// The samples of a scene at rest, in world coordinates. The outline includes what its animations move, and the boxes
/// around shapes whose vertices move (Shape::movingBox). `stored`: meshes that are on the disk.
ViewSamples viewSamplesOf(const Scene& scene, const StoredMeshes* stored = nullptr);

/// The unit vector from the scene to the viewer at a named view; for `automatic` that of the front.
Vec3d directionOf(StartView view);

/// The unit vector from the scene to the viewer that shows the surface best, among three-quarter views: the mean of
/// the visible share of the surface and of the share of the picture that it covers, each compared with the best
/// direction, with a slight preference for the front (+z) and for a height of 20 degrees.
Vec3d bestDirection(const std::vector<SurfaceSample>& samples);

} // namespace imgeo
