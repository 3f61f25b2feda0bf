#include "markup/x3d_element.h"

#include "base/error.h"
#include "markup/find_x3d.h"

#include <algorithm>
#include <array>
#include <filesystem>

namespace imgeo {

namespace {

/// Refuses unknown character references outside of comments, which pugixml would keep as text.
void checkReferences(std::string_view text, const std::string& name, TextSpan span) {
  std::size_t comment = text.find("<!--", span.begin);
  for (std::size_t at = text.find('&', span.begin); at < span.end; at = text.find('&', at + 1)) {
    while (comment < at) {
      const std::size_t end = std::min(text.find("-->", comment), text.size());
      at = std::max(at, std::min(text.find('&', end), text.size()));
      comment = text.find("<!--", end);
    }
    if (at >= span.end)
      return;
    const std::string_view rest = text.substr(at + 1, 12);
    const std::string_view entity = rest.substr(0, rest.find(';'));
    const bool known = entity == "amp" || entity == "lt" || entity == "gt" || entity == "quot" || entity == "apos" ||
                       (entity.size() > 1 && entity[0] == '#');
    if (!known || entity.size() == rest.size())
      throw Error(ErrorKind::malformed, locationOf(text, name, at),
                  "an ampersand begins no character reference that we know");
  }
}

} // namespace

std::size_t ElementOffsets::of(pugi::xml_node element) const {
  if (const auto found = offsets_.find(element.internal_object()); found != offsets_.end())
    return found->second;
  return base_ + static_cast<std::size_t>(std::max<std::ptrdiff_t>(element.offset_debug(), 0));
}

std::string_view withoutComments(std::string_view text) {
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n\f"), text.size()));
    if (!text.starts_with("<!--"))
      return text;
    const std::size_t end = text.find("-->", 4);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 3);
  }
}

pugi::xml_attribute attributeOf(pugi::xml_node element, std::string_view name) {
  for (const pugi::xml_attribute& attribute : element.attributes())
    if (equalIgnoringCase(attribute.name(), name))
      return attribute;
  return {};
}

ElementsByDef elementsByDef(pugi::xml_node root) {
  struct Walker : pugi::xml_tree_walker {
    bool for_each(pugi::xml_node& node) override {
      if (const pugi::xml_attribute def = attributeOf(node, "DEF"))
        defs.emplace(def.value(), node);
      return true;
    }
    ElementsByDef defs;
  } walker;
  root.traverse(walker);
  return std::move(walker.defs);
}

bool isHtml(std::string_view text, const std::string& name) {
  const std::string extension = std::filesystem::path(name).extension();
  const auto is = [&](const char* other) { return equalIgnoringCase(extension, other); };
  if (std::ranges::any_of(std::array{".html", ".htm"}, is))
    return true;
  if (std::ranges::any_of(std::array{".xhtml", ".xht", ".x3d", ".xml"}, is))
    return false;
  const std::string_view beginning = withoutComments(text);
  return beginsIgnoringCase(beginning, "<!doctype html") || beginsIgnoringCase(beginning, "<html");
}

X3dElement parseX3dXml(std::string_view xml, const std::string& name) {
  const TextSpan span = findX3d(xml, name);
  checkReferences(xml, name, span);
  X3dElement element;
  element.offsets = ElementOffsets(span.begin);
  const pugi::xml_parse_result result = element.document.load_buffer(
      xml.data() + span.begin, span.end - span.begin, pugi::parse_default | pugi::parse_comments, pugi::encoding_utf8);
  if (!result)
    throw Error(ErrorKind::malformed, locationOf(xml, name, span.begin + static_cast<std::size_t>(result.offset)),
                std::string("not well-formed: ") + result.description());
  return element;
}

X3dElement parseX3d(std::string_view text, const std::string& name) {
  return isHtml(text, name) ? parsePage(text, name) : parseX3dXml(text, name);
}

} // namespace imgeo
