#include "transcode/encode/atlas.h"

#include <fmt/format.h>
#include <optional>

namespace imgeo {

namespace {

/// Why groups cannot have images of a texture, or nullptr.
const char* obstacleOf(const TextureUse& use, const ImageFile& image, const Mesh& mesh) {
  if (use.role != TextureRole::color)
    return "its texture is not one of colours";
  if (use.transform != TextureTransform{})
    return "its texture has a transform";
  if (mesh.texCoords.empty())
    return "it has no texture coordinates of its own";
  if (texCoordSetNamed(use.mapping, mesh) != 0)
    return "its texture uses another set of texture coordinates than the first";
  if (image.bytes.empty())
    return "its texture is no file of the site";
  return nullptr;
}

} // namespace

Atlas atlasOf(const SceneGraph& graph, std::size_t geometry, const Mesh& mesh) {
  Atlas atlas;
  std::optional<std::optional<std::size_t>> appearance; // of the first shape, which may have none
  bool hasTextures = false, hasSeveral = false;
  for (const std::size_t node : shapeNodes(graph)) {
    const Shape& shape = shapeOf(graph, node);
    if (shape.mesh != geometry)
      continue;
    if (!appearance) {
      atlas.shape = graph.nodes[node].name;
      atlas.material = shape.appearance ? graph.appearances[*shape.appearance].name : "";
    }
    hasSeveral |= appearance.value_or(shape.appearance) != shape.appearance;
    appearance = appearance.value_or(shape.appearance);
    hasTextures |= shape.appearance && !graph.appearances[*shape.appearance].textures.empty();
  }
  if (!hasTextures)
    return atlas;
  if (hasSeveral) {
    atlas.obstacle = "its shapes have several appearances";
    return atlas;
  }
  const std::vector<TextureUse>& uses = graph.appearances[**appearance].textures;
  if (uses.size() > 1) {
    atlas.obstacle = fmt::format("its material has {} textures", uses.size());
    return atlas;
  }
  const ImageFile& image = graph.images[graph.textures[uses.front().texture].image];
  if (const char* obstacle = obstacleOf(uses.front(), image, mesh))
    atlas.obstacle = obstacle;
  else
    atlas.image = &image;
  return atlas;
}

std::string wholeImageWarning(const Atlas& atlas, const std::string& reason) {
  const std::string mesh = !atlas.shape.empty()      ? fmt::format("the mesh \"{}\"", atlas.shape)
                           : !atlas.material.empty() ? fmt::format("a mesh of material \"{}\"", atlas.material)
                                                     : "a mesh without a name";
  const std::string whole = !atlas.image               ? "whole images"
                            : atlas.image->url.empty() ? "the whole image"
                                                       : fmt::format("the whole image {}", atlas.image->url);
  return fmt::format("All levels of {} draw {}, not images of their groups: {}.", mesh, whole, reason);
}

} // namespace imgeo
