#pragma once
// The skins and morph targets of a scene as glTF has them (glTF 2.0, 3.7.2.2 and 3.7.3).

#include "export/gltf_arrays.h"
#include "scene/scene.h"

#include <map>
#include <vector>

namespace imgeo {

/// Adds the joints, weights and displacements of a mesh to its primitive.
void addDeformation(GltfArrays& arrays, const Mesh& mesh, Json& primitive);

/// The skin of a humanoid; null if a joint is no node of the file. `gltfNodes`: the nodes by those of the scene.
Json gltfSkin(GltfArrays& arrays, const Humanoid& humanoid,
              const std::map<std::size_t, std::vector<std::size_t>>& gltfNodes);

/// The displacers of a shape, as many as its mesh has displacements.
std::vector<std::size_t> displacersOf(const Scene& scene, std::size_t shapeNode);

} // namespace imgeo
