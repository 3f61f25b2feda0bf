#pragma once
// A shape's look as a glTF 2.0 material (sections 3.9 and 5.19).

#include "scene/scene.h"

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

namespace imgeo {

using Json = nlohmann::ordered_json;

/// The glTF texture of one of the graph's, where its image is at hand.
using TextureIndex = std::function<std::optional<std::size_t>(std::size_t texture)>;

/// The material of a shape that shows `mesh`.
Json gltfMaterial(const Appearance& appearance, const Shape& shape, const Mesh& mesh, const TextureIndex& textureIndex);

/// A texture's sampler.
Json gltfSampler(const Texture& texture);

} // namespace imgeo
