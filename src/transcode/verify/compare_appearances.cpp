#include "transcode/verify/compare_appearances.h"

#include "scene/mf_string.h"
#include "scene/point_material.h"

#include <algorithm>
#include <iterator>

namespace imgeo {

namespace {

bool isSameMaterial(const AnyMaterial& site, const AnyMaterial& input, Topology topology) {
  return site == input || site == AnyMaterial(phongOf(input)) ||
         (topology != Topology::triangles && site == AnyMaterial(pointMaterialOf(input)));
}

/// Whether the input uses a texture in the same role with the same transform and the same texture coordinates.
bool isUsedIn(const TextureUse& use, const std::vector<TextureUse>& input) {
  return std::ranges::any_of(input, [&](const TextureUse& other) {
    return other.role == use.role && other.transform == use.transform && other.mapping == use.mapping;
  });
}

} // namespace

bool haveEqualAppearances(const SceneGraph& siteGraph, const Shape& siteShape, const SceneGraph& inputGraph,
                          const Shape& inputShape, Topology topology) {
  if (!inputShape.appearance)
    return true;
  if (!siteShape.appearance)
    return false;
  const Appearance& site = siteGraph.appearances.at(*siteShape.appearance);
  const Appearance& input = inputGraph.appearances.at(*inputShape.appearance);
  return isSameMaterial(site.material, input.material, topology) &&
         std::ranges::all_of(site.textures, [&](const TextureUse& use) { return isUsedIn(use, input.textures); });
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
