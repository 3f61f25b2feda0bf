#pragma once
// An X3D document as a tree of XML elements, for both encodings: XML (ISO/IEC 19776-1) and classic VRML (ISO/IEC
// 19776-2, of which VRML97 is the predecessor).

#include "import/x3d/skins.h"
#include "markup/x3d_element.h"

#include <string>
#include <string_view>
#include <vector>

namespace imgeo::x3d {

struct Elements {
  pugi::xml_document document; ///< its document element is <X3D>
  std::string format;          ///< "X3D", "HTML", "X3D Classic", "VRML97" or "VRML 1.0": for reports
  ElementOffsets offsets;
  std::vector<std::string> warnings; ///< of the parser
  Skins skins;                       ///< from convertNodes() on

  pugi::xml_node root() const { return document.document_element(); }
};

/// Safe for untrusted text: document types with entities are refused. Throws Error{malformed, unsupported} naming
/// `name` and the line.
Elements parseXml(std::string_view text, const std::string& name);

/// "hall.wrl:12:3", the line and column of a byte of the text.
std::string locationOf(std::string_view text, const std::string& name, std::size_t offset);

} // namespace imgeo::x3d
