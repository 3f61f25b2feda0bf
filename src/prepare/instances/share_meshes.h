#pragma once
// Lets shapes of a scene show one mesh where theirs are equal but for a rigid map.

#include "scene/scene.h"
#include "scene/stored_meshes.h"

#include <functional>
#include <span>

namespace imgeo {

struct SharedMeshes {
  std::size_t shapes = 0; ///< that show another mesh now
  std::size_t meshes = 0; ///< that no shape shows any more
  double distance = 0; ///< how far positions of these shapes are from where they were, at most, in units of the source
};

struct SharingOptions {
  /// The largest distance of positions for a mesh with this box: see InstanceSearch.
  std::function<double(const Box3d&)> tolerance;
  /// Meshes of fewer elements are small: of fewer than `minSmallClass` that are equal, only those are shared that need
  /// no Transform, since they have the same coordinates in the same order.
  std::size_t minElements = 0, minSmallClass = 0;
  /// Larger meshes with texture coordinates share only with shapes of their own appearance.
  std::size_t maxTexturedElements = SIZE_MAX;
};

/// Where a mesh is an earlier one, moved and turned, its shapes show that one, each in a Transform: its group where
/// that has nothing else, or one of its own. Meshes whose vertices move, those of inlined documents, `excluded` ones
/// and shapes whose parent may not have a Transform stay as they are. Empties the meshes that no shape shows any more,
/// but for those that are on the disk (`stored`).
SharedMeshes shareMeshes(Scene& scene, const SharingOptions& options, std::span<const std::size_t> excluded = {},
                         const StoredMeshes* stored = nullptr);

} // namespace imgeo
