#include "transcode/verify/geometry_fields.h"

#include "documents/page_sanitizer.h"
#include "import/x3d/field_values.h"
#include "import/x3d/node_table.h"
#include "markup/find_x3d.h"
#include "scene/mf_string.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace imgeo {

namespace {

struct FieldDefault {
  std::string_view node, field, text;
};

/// Defaults of X3D 4.0 of the fields of geometry that stays in documents, where they are not empty. `node` is empty for
/// the fields of all other nodes.
constexpr auto fieldDefaults = std::to_array<FieldDefault>({
    {"Arc2D", "endAngle", "1.570796"},
    {"ArcClose2D", "endAngle", "1.570796"},
    {"ArcClose2D", "solid", "false"},
    {"Box", "size", "2 2 2"},
    {"Cone", "height", "2"},
    {"Cylinder", "height", "2"},
    {"Disk2D", "solid", "false"},
    {"Extrusion", "crossSection", "1 1 1 -1 -1 -1 -1 1 1 1"},
    {"Extrusion", "orientation", "0 0 1 0"},
    {"Extrusion", "scale", "1 1"},
    {"Extrusion", "spine", "0 0 0 0 1 0"},
    {"FontStyle", "size", "1"},
    {"Rectangle2D", "size", "2 2"},
    {"Rectangle2D", "solid", "false"},
    {"Text", "solid", "false"},
    {"TriangleSet2D", "solid", "false"},
    {"", "beginCap", "true"},
    {"", "bottom", "true"},
    {"", "bottomRadius", "1"},
    {"", "ccw", "true"},
    {"", "closureType", "PIE"},
    {"", "colorPerVertex", "true"},
    {"", "convex", "true"},
    {"", "creaseAngle", "0"},
    {"", "endCap", "true"},
    {"", "family", "SERIF"},
    {"", "geoGridOrigin", "0 0 0"},
    {"", "geoSystem", "\"GD\" \"WE\""},
    {"", "horizontal", "true"},
    {"", "innerRadius", "0"},
    {"", "justify", "BEGIN"},
    {"", "leftToRight", "true"},
    {"", "maxExtent", "0"},
    {"", "mode", "SPHERE"},
    {"", "normalPerVertex", "true"},
    {"", "outerRadius", "1"},
    {"", "radius", "1"},
    {"", "side", "true"},
    {"", "solid", "true"},
    {"", "spacing", "1"},
    {"", "startAngle", "0"},
    {"", "style", "PLAIN"},
    {"", "top", "true"},
    {"", "topToBottom", "true"},
    {"", "xDimension", "0"},
    {"", "xSpacing", "1"},
    {"", "yScale", "1"},
    {"", "zDimension", "0"},
    {"", "zSpacing", "1"},
});

std::string_view defaultOf(std::string_view node, std::string_view field) {
  for (const FieldDefault& row : fieldDefaults)
    if ((row.node.empty() || equalIgnoringCase(row.node, node)) && equalIgnoringCase(row.field, field))
      return row.text;
  return "";
}

/// Whether an attribute is no field, but a name, or for browsers.
bool isNoField(std::string_view attribute) {
  constexpr std::array names{"DEF", "USE", "containerField", "id", "class", "title", "slot", "is"};
  return std::ranges::any_of(names, [&](const char* name) { return equalIgnoringCase(attribute, name); }) ||
         beginsIgnoringCase(attribute, "data-") || beginsIgnoringCase(attribute, "aria-") ||
         !isInertAttribute(attribute);
}

bool isUrl(std::string_view field) {
  return equalIgnoringCase(field, "url") || field.ends_with("Url");
}

/// Whether a field has strings, which may look like numbers.
bool hasStrings(std::string_view field) {
  constexpr std::array names{"string", "family", "justify", "style", "language", "name", "geoSystem"};
  return isUrl(field) || std::ranges::any_of(names, [&](const char* name) { return equalIgnoringCase(field, name); });
}

std::optional<bool> booleanOf(std::string_view text) {
  const bool value = x3d::parseBoolean(text, true);
  return value == x3d::parseBoolean(text, false) ? std::optional(value) : std::nullopt;
}

bool isSameNumber(double a, double b, bool isDouble) {
  const auto isInteger = [](double number) { return number == std::trunc(number); };
  if (isDouble || a == b || (isInteger(a) && isInteger(b)))
    return a == b;
  return static_cast<float>(a) == static_cast<float>(b);
}

/// The beginning of a text, in quotes that it does not have itself.
std::string quoted(std::string_view text) {
  constexpr std::size_t shown = 60;
  const char quote = text.find('"') == text.npos ? '"' : '\'';
  if (text.size() <= shown)
    return fmt::format("{0}{1}{0}", quote, text);
  std::size_t end = shown;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80) // not within a character of UTF-8
    --end;
  return fmt::format("{0}{1}…{0}", quote, text.substr(0, end));
}

std::string differenceOfTexts(std::string_view field, std::string_view site, std::string_view input) {
  return fmt::format("has {} {}, in the input {}", field, quoted(site), quoted(input));
}

std::optional<std::string> differenceOfNumbers(std::string_view field, const std::vector<double>& site,
                                               const std::vector<double>& input, std::string_view siteText,
                                               std::string_view inputText, bool isDouble) {
  const auto [inSite, inInput] =
      std::ranges::mismatch(site, input, [&](double a, double b) { return isSameNumber(a, b, isDouble); });
  if (inSite == site.end() && inInput == input.end())
    return {};
  constexpr std::size_t few = 16; // numbers of a field whose text is shown
  if (site.size() <= few && input.size() <= few)
    return differenceOfTexts(field, siteText, inputText);
  if (site.size() != input.size())
    return fmt::format("has {} numbers of {}, in the input {}", site.size(), field, input.size());
  return fmt::format("has {} as number {} of {}, in the input {}", *inSite, inSite - site.begin() + 1, field, *inInput);
}

/// How the values of a field differ, if X3D reads different ones from the texts.
std::optional<std::string> differenceOfValues(std::string_view field, std::string_view site, std::string_view input,
                                              bool isDouble) {
  if (site == input)
    return {};
  if (hasStrings(field))
    return parseStrings(site) == parseStrings(input) ? std::nullopt
                                                     : std::optional(differenceOfTexts(field, site, input));
  if (const auto a = booleanOf(site), b = booleanOf(input); a && b)
    return *a == *b ? std::nullopt : std::optional(differenceOfTexts(field, site, input));
  const auto a = x3d::parseReals(site), b = x3d::parseReals(input);
  if (a && b)
    return differenceOfNumbers(field, *a, *b, site, input, isDouble);
  return parseStrings(site) == parseStrings(input) ? std::nullopt
                                                   : std::optional(differenceOfTexts(field, site, input));
}

/// Whether the fields of a node are double: X3D's SFDouble and MFVec3d.
bool hasDoubles(std::string_view element) {
  return element.ends_with("Double") || beginsIgnoringCase(element, "Geo");
}

/// Whether an element is compared as a part of a geometry: neither metadata nor a node that stands for itself.
bool isPart(std::string_view element) {
  if (beginsIgnoringCase(element, "Metadata") || equalIgnoringCase(element, "ROUTE"))
    return false;
  const x3d::NodeRow* row = x3d::nodeRow(element);
  return !row || row->containerField != "children";
}

/// The style of a FontStyle, which has other names in pages, where `style` is HTML's.
std::string_view fontStyleIn(pugi::xml_node element) {
  for (const char* name : {"data-style", "style"})
    if (const pugi::xml_attribute attribute = attributeOf(element, name))
      return attribute.value();
  return defaultOf("FontStyle", "style");
}

/// X3D's styles; others count as PLAIN, which is what the pages of X3DOM have for them.
std::string_view knownFontStyle(std::string_view style) {
  constexpr std::array<std::string_view, 3> styles{"BOLD", "ITALIC", "BOLDITALIC"};
  const auto found = std::ranges::find(styles, style);
  return found == styles.end() ? "PLAIN" : *found;
}

} // namespace

std::optional<std::string> GeometryFieldComparer::differenceOf(pugi::xml_node element, std::size_t node) {
  const std::pair key{element.internal_object(), node};
  if (equal_.contains(key))
    return {};
  const Node& content = input_.nodes[node];
  std::optional<std::string> difference = differenceOfFields(element, content);
  if (!difference)
    difference = differenceOfChildren(element, content);
  if (!difference)
    equal_.insert(key);
  return difference;
}

std::optional<std::string> GeometryFieldComparer::differenceOfFields(pugi::xml_node element, const Node& node) const {
  const GenericNode& generic = std::get<GenericNode>(node.content);
  const bool isFontStyle = equalIgnoringCase(element.name(), "FontStyle"), isDouble = hasDoubles(generic.element);
  const auto isCompared = [&](std::string_view field) {
    const bool isImage =
        std::ranges::any_of(generic.images, [&](const FieldImage& image) { return image.field == field; });
    return !isNoField(field) && !isImage && !(isFontStyle && equalIgnoringCase(field, "style"));
  };
  const auto inInput = [&](std::string_view name) {
    return std::ranges::find_if(node.fields,
                                [&](const FieldText& field) { return equalIgnoringCase(field.name, name); });
  };
  for (const FieldText& field : node.fields) {
    if (!isCompared(field.name))
      continue;
    const std::string expected = document_.isPage && isUrl(field.name) ? safeUrls(field.value) : field.value;
    const pugi::xml_attribute attribute = attributeOf(element, field.name);
    const std::string_view value = attribute ? attribute.value() : defaultOf(generic.element, field.name);
    if (auto difference = differenceOfValues(field.name, value, expected, isDouble))
      return difference;
  }
  for (const pugi::xml_attribute& attribute : element.attributes())
    if (isCompared(attribute.name()) && inInput(attribute.name()) == node.fields.end())
      if (auto difference = differenceOfValues(attribute.name(), attribute.value(),
                                               defaultOf(generic.element, attribute.name()), isDouble))
        return difference;
  if (!isFontStyle)
    return {};
  const auto found = inInput("style");
  const std::string_view style = fontStyleIn(element),
                         expected = found == node.fields.end() ? defaultOf("FontStyle", "style") : found->value;
  return knownFontStyle(style) == knownFontStyle(expected) ? std::nullopt
                                                           : std::optional(differenceOfTexts("style", style, expected));
}

std::optional<std::string> GeometryFieldComparer::differenceOfChildren(pugi::xml_node element, const Node& node) {
  const std::vector<pugi::xml_node> inSite = childrenOf(element);
  const std::vector<std::size_t> inInput = childrenOf(node);
  const auto nameOf = [&](std::size_t child) -> const std::string& {
    return std::get<GenericNode>(input_.nodes[child].content).element;
  };
  for (std::size_t i = 0; i < std::max(inSite.size(), inInput.size()); ++i) {
    if (i >= inInput.size())
      return fmt::format("has a {}, which the input has not", inSite[i].name());
    if (i >= inSite.size())
      return fmt::format("has no {}, which the input has", nameOf(inInput[i]));
    pugi::xml_node child = inSite[i];
    if (!equalIgnoringCase(child.name(), nameOf(inInput[i])))
      return fmt::format("has a {} where the input has a {}", child.name(), nameOf(inInput[i]));
    if (const pugi::xml_attribute use = attributeOf(child, "USE")) {
      const auto found = document_.defs.find(std::string_view(use.value()));
      if (found == document_.defs.end() || !equalIgnoringCase(found->second.name(), child.name()))
        return fmt::format("has a {} with USE={}, which is the DEF of none", child.name(), quoted(use.value()));
      child = found->second;
    }
    if (const auto difference = differenceOf(child, inInput[i]))
      return fmt::format("has a {} that {}", child.name(), *difference);
  }
  return {};
}

std::vector<pugi::xml_node> GeometryFieldComparer::childrenOf(pugi::xml_node element) const {
  std::vector<pugi::xml_node> children;
  for (const pugi::xml_node& child : element.children())
    if (child.type() == pugi::node_element && isPart(child.name()))
      children.push_back(child);
  return children;
}

std::vector<std::size_t> GeometryFieldComparer::childrenOf(const Node& node) const {
  std::vector<std::size_t> children;
  for (const std::size_t child : node.children)
    if (const auto* generic = std::get_if<GenericNode>(&input_.nodes[child].content)) {
      const bool isLeftOut =
          document_.isPage && !isAllowedInPage(generic->element) && input_.nodes[child].children.empty();
      if (generic->element != commentElement && isPart(generic->element) && !isLeftOut)
        children.push_back(child);
    }
  return children;
}

} // namespace imgeo
