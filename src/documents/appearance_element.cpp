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

/// The `mapping` of a texture: the name of its set of texture coordinates, with its role where the name must also tell
/// transforms apart.
std::string mappingOf(const TextureUse& use, bool namesTransform) {
  if (!namesTransform)
    return use.mapping;
  return use.mapping.empty() ? nameOf(use.role) : use.mapping + "." + nameOf(use.role);
}

void writeTransforms(ElementWriter& writer, const std::vector<TextureUse>& uses, bool areNamed) {
  if (!areNamed) {
    if (!uses.empty() && uses[0].transform != TextureTransform{})
      writer.leaf(nodeElement("TextureTransform", uses[0].transform));
    return;
  }
  const Element multiTransform{"MultiTextureTransform", {}};
  writer.open(multiTransform);
  for (const TextureUse& use : uses)
    writer.leaf(nodeElement("TextureTransform", use.transform, {{"mapping", mappingOf(use, areNamed)}}));
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

/// Whether a texture is a child of the Appearance, as in X3D 3: that of the main colour, unless its mapping has a name.
bool isChildOfAppearance(const TextureUse& use, bool areTransformsNamed) {
  return use.role == TextureRole::color && mappingOf(use, areTransformsNamed).empty();
}

/// Writes the textures of `uses` that belong to a material or to an extension, `node`, whose `element` gets a field for
/// each mapping that has a name.
template <typename Node, typename WriteChildren>
void writeWithTextures(ElementWriter& writer, const SceneGraph& graph, const Node& node, Element element,
                       const std::vector<TextureUse>& uses, bool areTransformsNamed, const TextureNames& textureNames,
                       bool hasChildren, const WriteChildren& writeChildren) {
  std::vector<const TextureUse*> own;
  for (const TextureUse& use : uses) {
    const std::string field = textureField(node, use.role);
    if (field.empty() || isChildOfAppearance(use, areTransformsNamed))
      continue;
    if (const std::string mapping = mappingOf(use, areTransformsNamed); !mapping.empty())
      element.groups[0].push_back({field + "Mapping", mapping});
    own.push_back(&use);
  }
  if (own.empty() && !hasChildren)
    return writer.leaf(element);
  writer.open(element);
  for (const TextureUse* use : own)
    writeTexture(writer, graph, use->texture, textureField(node, use->role), textureNames(use->texture));
  writeChildren();
  writer.close(element);
}

} // namespace

const char* materialNodeName(const AnyMaterial& material) {
  static constexpr const char* names[] = {"Material", "PhysicalMaterial", "UnlitMaterial"};
  return names[material.index()];
}

Element materialElement(const AnyMaterial& material) {
  return std::visit([&](const auto& any) { return nodeElement(materialNodeName(material), any); }, material);
}

Element extensionElement(const MaterialExtension& extension) {
  return std::visit(
      [&](const auto& any) {
        return nodeElement(materialExtensionNames.at(extension.index()), any, {{"containerField", "extensions"}});
      },
      extension);
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
  const bool areTransformsNamed = transformsDiffer(appearance.textures);
  const auto write = [&](const auto& node, Element nodeElement, bool hasChildren, const auto& writeChildren) {
    writeWithTextures(writer, graph, node, std::move(nodeElement), appearance.textures, areTransformsNamed,
                      textureNames, hasChildren, writeChildren);
  };
  const PhysicalMaterial* physical = std::get_if<PhysicalMaterial>(&appearance.material);
  const std::vector<MaterialExtension> extensions = physical ? physical->extensions : std::vector<MaterialExtension>{};

  writer.open(element);
  write(appearance.material, materialElement(appearance.material), !extensions.empty(), [&] {
    for (const MaterialExtension& extension : extensions)
      write(extension, extensionElement(extension), false, [] {});
  });
  for (const TextureUse& use : appearance.textures)
    if (isChildOfAppearance(use, areTransformsNamed))
      writeTexture(writer, graph, use.texture, "", textureNames(use.texture));
  writeTransforms(writer, appearance.textures, areTransformsNamed);
  writer.close(element);
}

} // namespace imgeo
