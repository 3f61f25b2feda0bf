#include "import/x3d/source.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace imgeo::x3d {

namespace {

constexpr std::size_t maxDepth = 200;

/// Entities are what XML bombs and the reading of other files are made of; documents
/// of X3D have none.
void refuseEntities(std::string_view text, const std::string& name) {
  const std::size_t doctype = text.find("<!DOCTYPE");
  if (doctype == text.npos)
    return;
  const std::size_t bracket = text.find_first_of("[>", doctype);
  if (bracket != text.npos && text[bracket] == '[')
    throw Error(ErrorKind::unsupported, name,
                "its document type defines entities, which imgeo does not read");
}

} // namespace

Source::Source(std::string_view text, const std::string& name) : text_(text), name_(name) {
  refuseEntities(text, name);
  const pugi::xml_parse_result result =
      document_.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!result) {
    // pugixml ends its copy of the text with a zero, and may fail behind it.
    const std::string_view read = text.substr(0, static_cast<std::size_t>(result.offset));
    const auto line = 1 + std::ranges::count(read, '\n');
    throw Error(ErrorKind::malformed, fmt::format("{}:{}", name, line),
                std::string("not well-formed: ") + result.description());
  }
  root_ = document_.document_element();
  if (std::string_view(root_.name()) != "X3D")
    throw Error(ErrorKind::malformed, name, "is XML, but its element is no X3D");
  addDefs(root_, 0);
}

void Source::addDefs(pugi::xml_node element, std::size_t depth) {
  if (depth > maxDepth)
    fail(element, ErrorKind::limit, "elements are nested too deeply");
  if (const pugi::xml_attribute def = element.attribute("DEF"))
    defs_.emplace(def.value(), element);
  for (const pugi::xml_node& child : element.children())
    if (child.type() == pugi::node_element)
      addDefs(child, depth + 1);
}

pugi::xml_node Source::resolved(pugi::xml_node element) const {
  const pugi::xml_attribute use = element.attribute("USE");
  if (!use)
    return element;
  const auto found = defs_.find(use.value());
  return found == defs_.end() ? pugi::xml_node() : found->second;
}

void Source::fail(pugi::xml_node element, ErrorKind kind, const std::string& message) const {
  const auto offset = std::clamp<std::ptrdiff_t>(element.offset_debug(), 0, std::ssize(text_));
  const auto line = 1 + std::count(text_.begin(), text_.begin() + offset, '\n');
  throw Error(kind, fmt::format("{}:{}", name_, line), fmt::format("{}: {}", element.name(), message));
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
