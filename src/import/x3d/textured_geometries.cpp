#include "import/x3d/textured_geometries.h"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

namespace imgeo::x3d {

namespace {

using namespace std::string_view_literals;

/// Those that pages draw. X3DOM's Texture is an ImageTexture.
constexpr std::array drawnTextures{"ImageTexture"sv, "MultiTexture"sv, "PixelTexture"sv, "Texture"sv};

/// Directions and points of space choose their colours.
constexpr std::array otherTextures{"ComposedCubeMapTexture"sv, "ComposedTexture3D"sv, "GeneratedCubeMapTexture"sv,
                                   "ImageCubeMapTexture"sv,    "ImageTexture3D"sv,    "PixelTexture3D"sv};

/// Textures are in an Appearance, in its material, or in a node of X3DOM between them. USEs could lead on without end.
constexpr int maxTextureDepth = 3;

class TextureFinder {
public:
  TextureFinder(pugi::xml_node root, const ElementsByDef& defs) : defs_(defs) {
    root.find_node([&](const pugi::xml_node& node) {
      if (std::string_view(node.name()) == "Shape")
        addGeometryOf(node);
      return false;
    });
  }

  std::set<pugi::xml_node_struct*> geometries;

private:
  pugi::xml_node resolved(pugi::xml_node element) const {
    const pugi::xml_attribute use = element.attribute("USE");
    if (!use)
      return element;
    const auto found = defs_.find(use.value());
    return found == defs_.end() ? pugi::xml_node() : found->second;
  }

  void addGeometryOf(pugi::xml_node shape) {
    bool isTextured = false;
    std::vector<pugi::xml_node_struct*> others;
    for (const pugi::xml_node& child : shape.children())
      if (std::string_view(child.name()) == "Appearance")
        isTextured |= hasTexture(resolved(child));
      else if (child.type() == pugi::node_element)
        others.push_back(resolved(child).internal_object());
    if (isTextured)
      geometries.insert(others.begin(), others.end());
  }

  /// Whether there is a texture at most `depth` elements below an element.
  bool hasTexture(pugi::xml_node element, int depth = maxTextureDepth) {
    if (depth == 0)
      return false;
    const auto [known, isNew] = hasTexture_.try_emplace({element.internal_object(), depth});
    if (isNew)
      known->second = std::ranges::any_of(element.children(), [&](const pugi::xml_node& child) {
        const std::string_view name = child.name();
        if (std::ranges::find(otherTextures, name) != otherTextures.end())
          return false;
        return std::ranges::find(drawnTextures, name) != drawnTextures.end() || hasTexture(resolved(child), depth - 1);
      });
    return known->second;
  }

  const ElementsByDef& defs_;
  /// By element and depth: many Shapes USE one Appearance.
  std::map<std::pair<pugi::xml_node_struct*, int>, bool> hasTexture_;
};

} // namespace

std::set<pugi::xml_node_struct*> texturedGeometries(pugi::xml_node root, const ElementsByDef& defs) {
  return std::move(TextureFinder(root, defs).geometries);
}

} // namespace imgeo::x3d
