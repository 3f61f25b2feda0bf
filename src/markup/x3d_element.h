#pragma once
// The <X3D> element of a document as a tree of elements, read by the rules of HTML5 or of XML.

#include <map>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace imgeo {

/// Where elements of a tree stand in the text that they were read from.
class ElementOffsets {
public:
  /// For elements that pugixml has parsed, from byte `base` of the text on.
  explicit ElementOffsets(std::size_t base = 0) : base_(base) {}
  /// States the offset of an element that pugixml has not parsed.
  void add(pugi::xml_node element, std::size_t offset) { offsets_[element.internal_object()] = offset; }
  /// Bytes from the text's beginning.
  std::size_t of(pugi::xml_node element) const;

private:
  std::size_t base_;
  std::unordered_map<pugi::xml_node_struct*, std::size_t> offsets_;
};

struct X3dElement {
  pugi::xml_document document; ///< its document element is <X3D>, in any case
  ElementOffsets offsets;
  std::string pageTitle;             ///< of an HTML page; may be empty
  std::vector<std::string> warnings; ///< of what HTML5 repairs in silence: one sentence each, with the line

  pugi::xml_node root() const { return document.document_element(); }
};

/// An attribute by its name, in any case; empty if the element has none of that name.
pugi::xml_attribute attributeOf(pugi::xml_node element, std::string_view name);

/// The elements of a document that have a DEF; of several with the same name, the first. Names are in the document.
using ElementsByDef = std::map<std::string_view, pugi::xml_node>;
ElementsByDef elementsByDef(pugi::xml_node root);

/// Limits of pages.
inline constexpr std::size_t maxPageBytes = 64u << 20, maxPageTreeBytes = 1u << 30, maxPageDepth = 240;
inline constexpr double maxPageSeconds = 60; ///< of processor time

/// The text without white space and comments at its beginning.
std::string_view withoutComments(std::string_view text);

/// Whether a text is read by the rules of HTML5: as a server would say by its name (.html and .htm; not .xhtml, .xht,
/// .x3d or .xml), for other names by its beginning, `<!doctype html>` or `<html>` without an XML declaration.
bool isHtml(std::string_view text, const std::string& name);

/// The first <x3d> element of a page as the tree that browsers make of it; names have the case of the text. Comments
/// are kept, text is not. Elements and attributes whose names XML does not allow are left out. Safe for untrusted text.
/// Throws Error with the line: malformed where there is no such element, limit beyond the limits above.
X3dElement parsePage(std::string_view html, const std::string& name);

/// The first <X3D> element of a text in XML: of an X3D document or of an XHTML page. Throws Error{malformed,
/// unsupported} with the line; for document types see findX3d.
X3dElement parseX3dXml(std::string_view xml, const std::string& name);

/// parsePage or parseX3dXml, as isHtml says.
X3dElement parseX3d(std::string_view text, const std::string& name);

} // namespace imgeo
