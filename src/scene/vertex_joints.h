#pragma once
// The joints and displacements of single vertices, for what is computed from a pose.

#include "scene/mesh.h"
#include "scene/skin.h"

#include <algorithm>

namespace imgeo {

/// The further vertex attribute with this name, which the mesh must have.
inline const NamedAttribute& attributeOf(const Mesh& mesh, const std::string& name) {
  return *std::ranges::find(mesh.namedAttributes, name, &NamedAttribute::name);
}

/// The displacement of a vertex, or of its normal.
inline Vec3d displacementAt(const NamedAttribute& attribute, std::size_t wedge) {
  return {attribute.values[3 * wedge], attribute.values[3 * wedge + 1], attribute.values[3 * wedge + 2]};
}

/// Calls `visit` with each joint that moves a vertex, a position in Humanoid::joints, and its weight.
template <typename Visit> void visitJoints(const Mesh& mesh, std::size_t setCount, std::size_t wedge, Visit visit) {
  for (std::size_t set = 0; set < setCount; ++set) {
    const NamedAttribute &joints = attributeOf(mesh, jointsName(set)),
                         &weights = attributeOf(mesh, jointWeightsName(set));
    for (std::size_t i = 4 * wedge; i < 4 * wedge + 4; ++i)
      if (weights.values[i] > 0)
        visit(static_cast<std::size_t>(joints.values[i]), double{weights.values[i]});
  }
}

} // namespace imgeo
