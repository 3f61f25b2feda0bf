#pragma once
// The elements of an Appearance: its material, textures and their transforms.

#include "documents/element_writer.h"
#include "scene/scene.h"

#include <functional>

namespace imgeo {

/// "Material", "PhysicalMaterial" or "UnlitMaterial".
const char* materialNodeName(const AnyMaterial& material);

Element materialElement(const AnyMaterial& material);

/// Gives the DEF or USE of a texture, which is an index into the graph's textures.
using TextureNames = std::function<Attributes(std::size_t texture)>;

/// Writes an Appearance with all that belongs to it. `names` is its DEF, if any.
void writeAppearance(ElementWriter& writer, const SceneGraph& graph, const Appearance& appearance,
                     const Attributes& names, const TextureNames& textureNames);

/// Writes an ImageTexture. Where `names` is a USE nothing else of it is written.
void writeTexture(ElementWriter& writer, const SceneGraph& graph, std::size_t texture,
                  const std::string& containerField, const Attributes& names);

/// The name of the material's field that a role's texture belongs to; "" where the
/// kind of material has none.
std::string textureField(const AnyMaterial& material, TextureRole role);

} // namespace imgeo
