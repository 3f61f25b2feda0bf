#include "import/x3d/unlit_geometry.h"

#include "import/x3d/container_geometry.h"
#include "import/x3d/element_edits.h"

#include <algorithm>
#include <utility>

namespace imgeo::x3d {

namespace {

bool isShader(pugi::xml_node element) {
  return std::string_view(element.name()) == "CommonSurfaceShader";
}

class DefinitionFinder final : public pugi::xml_tree_walker {
public:
  bool for_each(pugi::xml_node& element) override {
    const std::string_view name = element.name();
    if (const pugi::xml_attribute def = element.attribute("DEF");
        def && (isContainerGeometry(name) || name == "Appearance" || isMaterialNode(name) || isShader(element)))
      definitions.emplace(def.value(), element);
    return true;
  }

  ShapeDefinitions definitions;
};

/// The element that `element` USEs, or itself.
pugi::xml_node definitionOf(pugi::xml_node element, const ShapeDefinitions& definitions) {
  const std::string_view name = element.attribute("USE").value();
  if (name.empty())
    return element;
  const auto found = definitions.find(name);
  return found == definitions.end() ? pugi::xml_node() : found->second;
}

bool isUnlitGeometry(pugi::xml_node node) {
  const std::string_view name = node.name(), primitives = node.attribute("primType").value();
  return isContainerGeometry(name) && std::string_view(node.attribute("lit").value()) == "false" &&
         (primitives.empty() || primitives.find("TRIANGLE") != primitives.npos);
}

bool hasColors(pugi::xml_node geometry) {
  return geometry.attribute("color") || geometry.find_child_by_attribute("containerField", "color");
}

bool isColorTexture(pugi::xml_node texture) {
  const std::string_view field = texture.attribute("containerField").value();
  return isTextureNode(texture.name()) && (field == "diffuseTexture" || field == "baseTexture");
}

/// Copies have no names: the elements that they are copies of keep them.
void removeNames(pugi::xml_node element) {
  element.remove_attribute("DEF");
  for (const pugi::xml_node& child : elementsOf(element))
    removeNames(child);
}

/// Replaces the material of an Appearance.
void makeUnlit(pugi::xml_node appearance, bool hasVertexColors, const ShapeDefinitions& definitions) {
  pugi::xml_node unlit = appearance.prepend_child("UnlitMaterial");
  std::string emissiveColor = "1 1 1"; // without a material
  bool isTextured = false;
  for (pugi::xml_node child : elementsOf(appearance)) {
    isTextured = isTextured || isTextureNode(child.name());
    if (child == unlit || !(isShader(child) || isMaterialNode(child.name())))
      continue;
    const pugi::xml_node material = definitionOf(child, definitions);
    const bool isWhite = std::string_view(material.name()) == "UnlitMaterial";
    const pugi::xml_attribute emissive = material.attribute(isShader(child) ? "emissiveFactor" : "emissiveColor");
    emissiveColor = emissive ? emissive.value() : isWhite ? "1 1 1" : "0 0 0";
    if (const pugi::xml_attribute given = material.attribute("transparency"))
      setField(unlit, "transparency", given.value());
    for (const pugi::xml_node& texture : elementsOf(material))
      if (isColorTexture(texture)) {
        isTextured = true;
        pugi::xml_node copy = unlit.append_copy(texture);
        removeNames(copy);
        setField(copy, "containerField", "emissiveTexture");
      }
    appearance.remove_child(child);
  }
  setField(unlit, "emissiveColor", isTextured || hasVertexColors ? "1 1 1" : emissiveColor);
}

} // namespace

ShapeDefinitions shapeDefinitionsOf(pugi::xml_node root) {
  DefinitionFinder finder;
  root.traverse(finder);
  return std::move(finder.definitions);
}

bool convertUnlitGeometry(pugi::xml_node shape, const ShapeDefinitions& definitions,
                          const std::function<void(pugi::xml_node)>& takeOut) {
  const std::vector<pugi::xml_node> children = elementsOf(shape);
  const auto geometry = std::ranges::find_if(
      children, [&](pugi::xml_node child) { return isUnlitGeometry(definitionOf(child, definitions)); });
  if (geometry == children.end())
    return false;
  pugi::xml_node appearance = shape.child("Appearance");
  if (!appearance)
    appearance = shape.prepend_child("Appearance");
  pugi::xml_node own = shape.insert_copy_before(definitionOf(appearance, definitions), appearance);
  if (!own) // the USE names no Appearance
    return false;
  takeOut(appearance);
  removeNames(own);
  makeUnlit(own, hasColors(definitionOf(*geometry, definitions)), definitions);
  return true;
}

} // namespace imgeo::x3d
