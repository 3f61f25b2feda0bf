#include "import/x3d/source.h"

#include "import/x3d/textured_geometries.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace imgeo::x3d {

namespace {

constexpr std::size_t maxElementDepth = 200;

} // namespace

Source::Source(Elements elements, std::string_view text, const std::string& name)
    : elements_(std::move(elements)), text_(text), name_(name) {
  addDefs(root(), 0);
  textured_ = texturedGeometries(root(), defs_);
}

void Source::addDefs(pugi::xml_node element, std::size_t depth) {
  if (depth > maxElementDepth)
    fail(element, ErrorKind::limit, "elements are nested too deeply");
  if (const pugi::xml_attribute def = element.attribute("DEF"))
    defs_.emplace(def.value(), element);
  for (const pugi::xml_node& child : element.children())
    if (child.type() == pugi::node_element)
      addDefs(child, depth + 1);
}

pugi::xml_node Source::resolved(pugi::xml_node element) const {
  const pugi::xml_attribute use = element.attribute("USE");
  return use ? defined(use.value()) : element;
}

pugi::xml_node Source::defined(std::string_view name) const {
  const auto found = defs_.find(name);
  return found == defs_.end() ? pugi::xml_node() : found->second;
}

const Skin* Source::skinOf(pugi::xml_node group) const {
  const auto found = elements_.skins.groups.find(group.internal_object());
  return found == elements_.skins.groups.end() ? nullptr : &found->second;
}

const std::vector<NamedAttribute>* Source::pointAttributesOf(pugi::xml_node geometry) const {
  const auto found = elements_.skins.pointAttributes.find(geometry.internal_object());
  return found == elements_.skins.pointAttributes.end() ? nullptr : &found->second;
}

std::string Source::locationOf(pugi::xml_node element) const {
  return x3d::locationOf(text_, name_, elements_.offsets.of(element));
}

void Source::fail(pugi::xml_node element, ErrorKind kind, const std::string& message) const {
  throw Error(kind, locationOf(element), fmt::format("{}: {}", element.name(), message));
}

std::vector<double> Source::reals(pugi::xml_node element, const char* field) const {
  std::optional<std::vector<double>> values = parseReals(element.attribute(field).value());
  const auto isFinite = [](double value) {
    return std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max());
  };
  if (!values || !std::ranges::all_of(*values, isFinite))
    fail(element, ErrorKind::malformed, fmt::format("{} holds something that is no number", field));
  return std::move(*values);
}

std::vector<std::int32_t> Source::integers(pugi::xml_node element, const char* field) const {
  std::optional<std::vector<std::int32_t>> values = parseIntegers(element.attribute(field).value());
  if (!values)
    fail(element, ErrorKind::malformed, fmt::format("{} holds something that is no whole number", field));
  return std::move(*values);
}

double Source::real(pugi::xml_node element, const char* field, double fallback) const {
  const std::vector<double> values = reals(element, field);
  return values.empty() ? fallback : values[0];
}

bool Source::boolean(pugi::xml_node element, const char* field, bool fallback) const {
  return parseBoolean(element.attribute(field).value(), fallback);
}

} // namespace imgeo::x3d
