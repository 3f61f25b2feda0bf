#pragma once
// The appearance of a shape as a glTF 2.0 material (sections 3.9 and 5.19).

#include "export/gltf_arrays.h"
#include "scene/scene.h"

#include <functional>
#include <optional>

namespace imgeo {

/// Index of the glTF texture of a texture of the graph; nothing if its image is not available.
using TextureIndex = std::function<std::optional<std::size_t>(std::size_t texture)>;

/// The material of a shape with this mesh.
Json gltfMaterial(const Appearance& appearance, const Shape& shape, const Mesh& mesh, const TextureIndex& textureIndex);

/// A texture's sampler.
Json gltfSampler(const Texture& texture);

} // namespace imgeo
