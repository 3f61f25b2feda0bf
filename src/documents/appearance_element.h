#pragma once
// The elements of an Appearance: its material, textures and their transforms.

#include "documents/element_writer.h"
#include "scene/scene.h"

#include <functional>

namespace imgeo {

/// "Material", "PhysicalMaterial" or "UnlitMaterial".
const char* materialNodeName(const AnyMaterial& material);

Element materialElement(const AnyMaterial& material);
/// The element of an extension of PhysicalMaterial, in X_ITE's field for them.
Element extensionElement(const MaterialExtension& extension);

/// Returns the DEF or USE of a texture, given as index into the graph's textures.
using TextureNames = std::function<Attributes(std::size_t texture)>;

/// Writes an Appearance with its material, textures and texture transforms. `names` is its DEF, if any.
void writeAppearance(ElementWriter& writer, const SceneGraph& graph, const Appearance& appearance,
                     const Attributes& names, const TextureNames& textureNames);

/// Writes an ImageTexture. If `names` is a USE, its own fields and children are left out.
void writeTexture(ElementWriter& writer, const SceneGraph& graph, std::size_t texture,
                  const std::string& containerField, const Attributes& names);

} // namespace imgeo
