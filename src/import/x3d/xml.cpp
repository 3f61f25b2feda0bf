#include "base/error.h"
#include "import/x3d/elements.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo::x3d {

namespace {

/// Refuses entity definitions, which allow exponential expansion and access to other files. X3D documents need none.
void refuseEntities(std::string_view text, const std::string& name) {
  const std::size_t doctype = text.find("<!DOCTYPE");
  if (doctype == text.npos)
    return;
  const std::size_t bracket = text.find_first_of("[>", doctype);
  if (bracket != text.npos && text[bracket] == '[')
    throw Error(ErrorKind::unsupported, locationOf(text, name, doctype),
                "its document type defines entities, which imgeo does not read");
}

} // namespace

std::string locationOf(std::string_view text, const std::string& name, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const std::size_t lineBegin = before.rfind('\n') + 1; // npos + 1 is 0
  return fmt::format("{}:{}:{}", name, 1 + std::ranges::count(before, '\n'), before.size() - lineBegin + 1);
}

Elements parseXml(std::string_view text, const std::string& name) {
  refuseEntities(text, name);
  Elements elements;
  elements.format = "X3D";
  const pugi::xml_parse_result result = elements.document.load_buffer(
      text.data(), text.size(), pugi::parse_default | pugi::parse_comments, pugi::encoding_utf8);
  if (!result) // the offset may be one past the end of the text, which locationOf allows
    throw Error(ErrorKind::malformed, locationOf(text, name, static_cast<std::size_t>(result.offset)),
                std::string("not well-formed: ") + result.description());
  if (std::string_view(elements.root().name()) != "X3D")
    throw Error(ErrorKind::malformed, name, "is XML, but its root element is not X3D");
  return elements;
}

} // namespace imgeo::x3d
