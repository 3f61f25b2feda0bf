#pragma once
// Finds meshes that are others, moved and turned: docs/decisions/instances.md.

#include "prepare/instances/congruence.h"
#include "scene/stored_meshes.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace imgeo {

struct MeshInstance {
  std::size_t mesh = 0; ///< the mesh that is shown instead, which stands for itself
  Transform transform;  ///< from that mesh to the one that it stands for
  double distance = 0;  ///< the largest one of positions that correspond
};

/// What is looked for among the meshes of a scene.
struct InstanceSearch {
  /// By mesh: meshes of other numbers are not compared; nothing: the mesh is not compared at all.
  std::vector<std::optional<std::uint64_t>> kinds;
  std::vector<std::size_t> order; ///< all meshes that have a kind, each once: the first of a class stands for the class
  /// The largest distance of positions for a mesh with this box, before the rounding of its coordinates is added.
  std::function<double(const Box3d&)> tolerance;
  /// By mesh: whether it is small. A small mesh is moved only where at least `minSmallClass` meshes are equal; of
  /// others it stands for meshes with the same coordinates in the same order alone. Empty: none is.
  std::vector<bool> small = {};
  std::size_t minSmallClass = 0;
};

/// The distance within which two meshes count as equal: the tolerance of the smaller box, and what single precision
/// may have rounded their coordinates by, up to 1/1024 of their radius.
double congruenceDistance(double tolerance, const MeshMeasure& a, const MeshMeasure& b);

/// For each mesh the instance that stands for it; nothing for those that stand for themselves. The first mesh of each
/// class does, in the stated order and whatever the number of threads. Of more than 32 meshes with equal counts,
/// attributes and radii the first 32 are compared.
std::vector<std::optional<MeshInstance>> findInstances(const SceneMeshes& meshes, const InstanceSearch& search);

} // namespace imgeo
