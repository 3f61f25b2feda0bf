#include "documents/appearance_element.h"

#include "documents/appearance_names.h"
#include "documents/node_fields_writer.h"

#include <algorithm>

namespace imgeo {

namespace {

/// Whether the textures of a material have different transforms, each of which then needs a name (X3D 4, 18.4: the
/// `mapping` fields).
bool transformsDiffer(const std::vector<TextureUse>& uses) {
  return std::ranges::any_of(uses, [&](const TextureUse& use) { return use.transform != uses[0].transform; });
}

void writeTransforms(ElementWriter& writer, const std::vector<TextureUse>& uses, bool hasMappings) {
  if (!hasMappings) {
    if (!uses.empty() && uses[0].transform != TextureTransform{})
      writer.leaf(nodeElement("TextureTransform", uses[0].transform));
    return;
  }
  const Element multiTransform{"MultiTextureTransform", {}};
  writer.open(multiTransform);
  for (const TextureUse& use : uses)
    writer.leaf(nodeElement("TextureTransform", use.transform, {{"mapping", nameOf(use.role)}}));
  writer.close(multiTransform);
}

Element propertiesElement(const Texture& texture) {
  Attributes boundaries, filters;
  const auto boundary = [&](const char* name, Boundary value) { boundaries.push_back({name, nameOf(value)}); };
  boundary("boundaryModeS", texture.boundaryS);
  boundary("boundaryModeT", texture.boundaryT);
  if (texture.magnification != Filter::standard)
    filters.push_back({"magnificationFilter", magnificationFilter(texture)});
  if (texture.minification != Filter::standard)
    filters.push_back({"minificationFilter", minificationFilter(texture)});
  if (texture.mipMaps)
    filters.push_back({"generateMipMaps", "true"});
  return {"TextureProperties", {boundaries, filters}};
}

bool needsProperties(const Texture& texture) {
  return texture.boundaryS == Boundary::mirroredRepeat || texture.boundaryT == Boundary::mirroredRepeat ||
         texture.magnification != Filter::standard || texture.minification != Filter::standard;
}

} // namespace

const char* materialNodeName(const AnyMaterial& material) {
  static constexpr const char* names[] = {"Material", "PhysicalMaterial", "UnlitMaterial"};
  return names[material.index()];
}

Element materialElement(const AnyMaterial& material) {
  return std::visit([&](const auto& any) { return nodeElement(materialNodeName(material), any); }, material);
}

void writeTexture(ElementWriter& writer, const SceneGraph& graph, std::size_t index, const std::string& containerField,
                  const Attributes& names) {
  const Texture& texture = graph.textures.at(index);
  Element element{"ImageTexture", {names}};
  Attributes& attributes = element.groups[0];
  if (!containerField.empty())
    attributes.push_back({"containerField", containerField});
  if (!names.empty() && names[0].name == "USE")
    return writer.leaf(element);
  const ImageFile& image = graph.images.at(texture.image);
  attributes.push_back({"url", quoteStrings({image.url})});
  addUnless(attributes, "preview", image.preview, {}, image.preview);
  addUnless(attributes, "repeatS", texture.boundaryS == Boundary::clamp, false, "false");
  addUnless(attributes, "repeatT", texture.boundaryT == Boundary::clamp, false, "false");
  if (!needsProperties(texture))
    return writer.leaf(element);
  writer.open(element);
  writer.leaf(propertiesElement(texture));
  writer.close(element);
}

void writeAppearance(ElementWriter& writer, const SceneGraph& graph, const Appearance& appearance,
                     const Attributes& names, const TextureNames& textureNames) {
  Element element{"Appearance", {names}};
  if (appearance.alphaMode != AlphaMode::automatic)
    element.groups[0].push_back({"alphaMode", nameOf(appearance.alphaMode)});
  if (appearance.alphaMode == AlphaMode::mask)
    addUnless(element.groups[0], "alphaCutoff", appearance.alphaCutoff, 0.5f, number(appearance.alphaCutoff));
  const bool hasMappings = transformsDiffer(appearance.textures);
  Element material = materialElement(appearance.material);
  std::vector<const TextureUse*> materialTextures;
  for (const TextureUse& use : appearance.textures) {
    const std::string field = textureField(appearance.material, use.role);
    if (field.empty() || (use.role == TextureRole::color && !hasMappings))
      continue;
    if (hasMappings)
      material.groups[0].push_back({field + "Mapping", nameOf(use.role)});
    materialTextures.push_back(&use);
  }

  writer.open(element);
  if (materialTextures.empty()) {
    writer.leaf(material);
  } else {
    writer.open(material);
    for (const TextureUse* use : materialTextures)
      writeTexture(writer, graph, use->texture, textureField(appearance.material, use->role),
                   textureNames(use->texture));
    writer.close(material);
  }
  // Without mappings, the texture of the main colour is a child of the Appearance, as in X3D 3.
  for (const TextureUse& use : appearance.textures)
    if (use.role == TextureRole::color && !hasMappings)
      writeTexture(writer, graph, use.texture, "", textureNames(use.texture));
  writeTransforms(writer, appearance.textures, hasMappings);
  writer.close(element);
}

} // namespace imgeo
