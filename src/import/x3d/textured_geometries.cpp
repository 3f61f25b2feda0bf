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

  /// Whether there is a texture below an element.
  bool hasTexture(pugi::xml_node element) {
    const auto [found, isNew] = hasTexture_.try_emplace(element.internal_object()); // an element may USE itself
    if (!isNew)
      return found->second;
    for (const pugi::xml_node& child : element.children()) {
      const std::string_view name = child.name();
      if (std::ranges::find(otherTextures, name) != otherTextures.end())
        continue;
      if (std::ranges::find(drawnTextures, name) != drawnTextures.end() || hasTexture(resolved(child)))
        return hasTexture_[element.internal_object()] = true;
    }
    return false;
  }

  const ElementsByDef& defs_;
  std::map<pugi::xml_node_struct*, bool> hasTexture_; ///< by element
};

} // namespace

std::set<pugi::xml_node_struct*> texturedGeometries(pugi::xml_node root, const ElementsByDef& defs) {
  return std::move(TextureFinder(root, defs).geometries);
}

} // namespace imgeo::x3d
