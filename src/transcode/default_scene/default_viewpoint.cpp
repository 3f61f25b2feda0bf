#include "transcode/default_scene/default_viewpoint.h"

#include "base/affine_inverse.h"
#include "base/shortest_decimal.h"

#include <vector>

namespace imgeo {

namespace {

/// Sets the center of rotation of all viewpoints, in the coordinate system of the first instance of each.
class RotationCenters {
public:
  RotationCenters(SceneGraph& graph, Vec3d center) : graph_(graph), center_(center), isVisited_(graph.nodes.size()) {}

  void visit(std::size_t index, const Affine3d& worldFromParent) {
    if (isVisited_[index])
      return;
    isVisited_[index] = true;
    Node& node = graph_.nodes[index];
    if (worldFromParent.determinant() != 0) {
      const Vec3d center = inverseOf(worldFromParent).point(center_);
      if (Viewpoint* viewpoint = std::get_if<Viewpoint>(&node.content))
        viewpoint->centerOfRotation = center;
      if (OrthoViewpoint* viewpoint = std::get_if<OrthoViewpoint>(&node.content))
        viewpoint->centerOfRotation = center;
    }
    const Transform* transform = std::get_if<Transform>(&node.content);
    const Affine3d worldFromNode = transform ? worldFromParent * affineOf(*transform) : worldFromParent;
    for (const std::size_t child : node.children)
      visit(child, worldFromNode);
  }

private:
  SceneGraph& graph_;
  Vec3d center_;
  std::vector<bool> isVisited_;
};

} // namespace

Viewpoint withShortNumbers(Viewpoint viewpoint) {
  const double tolerance = 1e-6 * length(viewpoint.position - viewpoint.centerOfRotation);
  for (int axis = 0; axis < 3; ++axis) {
    viewpoint.position[axis] = shortestWithin(viewpoint.position[axis], tolerance);
    viewpoint.centerOfRotation[axis] = shortestWithin(viewpoint.centerOfRotation[axis], tolerance);
    viewpoint.orientation.axis[axis] = shortestWithin(viewpoint.orientation.axis[axis], 1e-6);
  }
  viewpoint.orientation.angle = shortestWithin(viewpoint.orientation.angle, 1e-6);
  return viewpoint;
}

void setCentersOfRotation(SceneGraph& graph, Vec3d center) {
  RotationCenters centers(graph, center);
  for (const std::size_t root : graph.roots)
    centers.visit(root, {});
}

} // namespace imgeo
