#include "transcode/verify/compare_appearances.h"

#include "scene/mf_string.h"

#include <algorithm>
#include <iterator>

namespace imgeo {

namespace {

bool isSameMaterial(const AnyMaterial& site, const AnyMaterial& input) {
  return site == input || site == AnyMaterial(phongOf(input));
}

/// The site's texture has one of the input beside it, of the same role and in the same place.
bool isOfInput(const TextureUse& use, const std::vector<TextureUse>& input) {
  return std::ranges::any_of(
      input, [&](const TextureUse& other) { return other.role == use.role && other.transform == use.transform; });
}

} // namespace

bool haveEqualAppearances(const SceneGraph& siteGraph, const Shape& inSite, const SceneGraph& inputGraph,
                          const Shape& inInput) {
  if (!inInput.appearance)
    return true;
  if (!inSite.appearance)
    return false;
  const Appearance& site = siteGraph.appearances.at(*inSite.appearance);
  const Appearance& input = inputGraph.appearances.at(*inInput.appearance);
  return isSameMaterial(site.material, input.material) &&
         std::ranges::all_of(site.textures, [&](const TextureUse& use) { return isOfInput(use, input.textures); });
}

std::set<std::string> texturesLeftIn(const SceneGraph& input) {
  std::set<std::string> urls;
  for (const Node& node : input.nodes)
    if (const GenericNode* other = std::get_if<GenericNode>(&node.content);
        other && other->element == "ImageTexture" && !other->image)
      for (const FieldText& field : node.fields)
        if (field.name == "url")
          std::ranges::move(parseStrings(field.value), std::inserter(urls, urls.end()));
  return urls;
}

} // namespace imgeo
