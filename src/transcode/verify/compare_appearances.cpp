#include "transcode/verify/compare_appearances.h"

#include "scene/gltf_material_of.h"
#include "scene/mf_string.h"
#include "scene/point_material.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace imgeo {

namespace {

/// Equal but for the rounding of conversions between sRGB and linear colours.
bool isWithinRounding(float a, float b) {
  return std::abs(a - b) <= 1e-5f;
}

bool isWithinRounding(Vec3f a, Vec3f b) {
  return isWithinRounding(a.x, b.x) && isWithinRounding(a.y, b.y) && isWithinRounding(a.z, b.z);
}

bool isWithinRounding(const GltfMaterial& a, const AnyMaterial& b) {
  const auto *physicalA = std::get_if<PhysicalMaterial>(&a), *physicalB = std::get_if<PhysicalMaterial>(&b);
  if (physicalA && physicalB)
    return isWithinRounding(physicalA->baseColor, physicalB->baseColor) &&
           isWithinRounding(physicalA->emissiveColor, physicalB->emissiveColor) &&
           isWithinRounding(physicalA->metallic, physicalB->metallic) &&
           isWithinRounding(physicalA->roughness, physicalB->roughness) &&
           isWithinRounding(physicalA->transparency, physicalB->transparency) &&
           physicalA->normalScale == physicalB->normalScale &&
           physicalA->occlusionStrength == physicalB->occlusionStrength &&
           physicalA->extensions == physicalB->extensions;
  const auto *unlitA = std::get_if<UnlitMaterial>(&a), *unlitB = std::get_if<UnlitMaterial>(&b);
  return unlitA && unlitB && isWithinRounding(unlitA->emissiveColor, unlitB->emissiveColor) &&
         isWithinRounding(unlitA->transparency, unlitB->transparency);
}

bool isSameMaterial(const AnyMaterial& site, const AnyMaterial& input, const Mesh& mesh) {
  return site == input || site == AnyMaterial(phongOf(input)) ||
         (mesh.topology != Topology::triangles && site == AnyMaterial(pointMaterialOf(input))) ||
         isWithinRounding(gltfMaterialOf(site, !mesh.colors.empty()), input);
}

/// Whether glTF has textures in this role; export leaves out the others.
bool isInGltf(TextureRole role) {
  return role != TextureRole::ambient && role != TextureRole::specular && role != TextureRole::shininess;
}

/// Whether the input uses a texture in the same role with the same transform and the same texture coordinates.
bool isUsedIn(const TextureUse& use, const std::vector<TextureUse>& input) {
  return std::ranges::any_of(input, [&](const TextureUse& other) {
    return other.role == use.role && other.transform == use.transform && other.mapping == use.mapping;
  });
}

} // namespace

bool haveEqualAppearances(const SceneGraph& siteGraph, const Shape& siteShape, const SceneGraph& inputGraph,
                          const Shape& inputShape, const Mesh& inputMesh) {
  if (!inputShape.appearance)
    return true;
  const Appearance defaults;
  const Appearance& site = siteShape.appearance ? siteGraph.appearances.at(*siteShape.appearance) : defaults;
  const Appearance& input = inputGraph.appearances.at(*inputShape.appearance);
  return isSameMaterial(site.material, input.material, inputMesh) &&
         std::ranges::all_of(site.textures, [&](const TextureUse& use) {
           return !isInGltf(use.role) || isUsedIn(use, input.textures);
         });
}

std::optional<bool> isUnlit(const SceneGraph& graph, const Node& shape) {
  if (const std::optional<std::size_t> appearance = std::get<Shape>(shape.content).appearance)
    return std::holds_alternative<UnlitMaterial>(graph.appearances.at(*appearance).material);
  const auto find = [&](const Node& parent, std::string_view element) {
    const auto found = std::ranges::find_if(parent.children, [&](std::size_t child) {
      const auto* generic = std::get_if<GenericNode>(&graph.nodes[child].content);
      return generic && generic->element == element;
    });
    return found == parent.children.end() ? nullptr : &graph.nodes[*found];
  };
  const Node* appearance = find(shape, "Appearance");
  return appearance ? std::optional(find(*appearance, "UnlitMaterial") != nullptr) : std::nullopt;
}

std::set<std::string> unreadTextureUrls(const SceneGraph& input) {
  std::set<std::string> urls;
  for (const Node& node : input.nodes)
    if (const GenericNode* generic = std::get_if<GenericNode>(&node.content))
      for (const std::string_view name : imageFieldsOf(generic->element))
        if (std::ranges::find(generic->images, name, &FieldImage::field) == generic->images.end())
          for (const FieldText& field : node.fields)
            if (field.name == name)
              std::ranges::move(parseStrings(field.value), std::inserter(urls, urls.end()));
  return urls;
}

} // namespace imgeo
