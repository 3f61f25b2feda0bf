#include "import/vrml/elements.h"

#include "import/text/text_scanner.h"
#include "import/vrml/names.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace imgeo::x3d {

pugi::xml_node VrmlElements::add(pugi::xml_node parent, std::string_view element, const Token& where) {
  requireName(where, element);
  pugi::xml_node added = parent.append_child(std::string(element).c_str());
  elements_.offsets.add(added, where.offset);
  return added;
}

void VrmlElements::requireName(const Token& where, std::string_view name) const {
  const auto isLetter = [](unsigned char c) { return std::isalpha(c) || c == '_' || c >= 0x80; };
  const auto isInner = [&](unsigned char c) { return isLetter(c) || std::isdigit(c) || c == '-'; };
  if (name.empty() || !isLetter(static_cast<unsigned char>(name[0])) || !std::ranges::all_of(name, isInner))
    tokens_.fail(where, ErrorKind::malformed, fmt::format("\"{}\" is no name of a node or field", asPrintable(name)));
}

std::string VrmlElements::define(const std::string& name, const std::string& element) {
  Scope& scope = scopes_.back();
  const std::size_t times = ++scope.definitionCounts[name];
  std::string uniqueName = times == 1 ? name : fmt::format("{}-{}", name, times);
  scope.definitions[name] = {uniqueName, element};
  return uniqueName;
}

const VrmlElements::Definition* VrmlElements::definition(const std::string& name) const {
  const auto found = scopes_.back().definitions.find(name);
  return found == scopes_.back().definitions.end() ? nullptr : &found->second;
}

std::string VrmlElements::currentName(const std::string& name) const {
  const Definition* known = definition(name);
  return known ? known->name : name;
}

pugi::xml_node VrmlElements::prototype(std::string_view name) const {
  const auto found = scopes_.back().prototypes.find(name);
  return found == scopes_.back().prototypes.end() ? pugi::xml_node() : found->second;
}

void VrmlElements::declare(const std::string& name, pugi::xml_node declaration) {
  scopes_.back().prototypes[name] = declaration;
}

void VrmlElements::openScope() {
  Scope inner;
  inner.prototypes = scopes_.back().prototypes;
  scopes_.push_back(std::move(inner));
}

void set(pugi::xml_node element, std::string_view attribute, std::string_view value) {
  const std::string name(attribute);
  pugi::xml_attribute target = element.attribute(name.c_str());
  if (!target)
    target = element.append_attribute(name.c_str());
  target.set_value(std::string(value).c_str());
}

void setContainerField(pugi::xml_node element, std::string_view field) {
  const std::string_view name = element.name();
  const std::string_view defaultField = name == "ProtoInstance" ? "children" : defaultContainerField(name);
  if (!field.empty() && field != defaultField)
    set(element, "containerField", field);
}

void addComments(pugi::xml_node parent, const std::vector<std::string_view>& comments) {
  for (const std::string_view comment : comments)
    parent.append_child(pugi::node_comment).set_value(std::string(comment).c_str());
}

} // namespace imgeo::x3d
