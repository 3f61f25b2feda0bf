#pragma once
// Edits of a document's elements that the expansion of prototypes and the conversions of nodes share.

#include "import/x3d/field_values.h"

#include <algorithm>
#include <optional>
#include <pugixml.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace imgeo::x3d {

inline std::vector<pugi::xml_node> elementsOf(pugi::xml_node parent) {
  std::vector<pugi::xml_node> elements;
  for (const pugi::xml_node& child : parent.children())
    if (child.type() == pugi::node_element)
      elements.push_back(child);
  return elements;
}

inline bool isElement(pugi::xml_node node, std::string_view name) {
  return node.type() == pugi::node_element && node.name() == name;
}

inline bool isOneOf(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

inline bool isTextureNode(std::string_view element) {
  return element == "ImageTexture" || element == "PixelTexture" || element == "MultiTexture";
}

inline bool isMaterialNode(std::string_view element) {
  return element == "Material" || element == "PhysicalMaterial" || element == "UnlitMaterial" ||
         element == "TwoSidedMaterial";
}

inline void setField(pugi::xml_node element, const char* field, const std::string& value) {
  if (!element.attribute(field))
    element.append_attribute(field);
  element.attribute(field).set_value(value.c_str());
}

/// Gives a field another name; keeps a field that already has that name.
inline void renameField(pugi::xml_node element, const char* from, const char* to) {
  if (const pugi::xml_attribute given = element.attribute(from); given && !element.attribute(to))
    element.append_attribute(to) = given.value();
  element.remove_attribute(from);
}

/// The numbers of a field; `fallback` where the field has fewer numbers than `fallback`.
inline std::vector<double> numbersOf(pugi::xml_node element, const char* field, const std::vector<double>& fallback) {
  std::optional<std::vector<double>> values = parseReals(element.attribute(field).value());
  if (!values || values->size() < fallback.size())
    return fallback;
  return std::move(*values);
}

} // namespace imgeo::x3d
