#include "import/x3d/page.h"

#include "base/error.h"
#include "import/warnings.h"
#include "import/x3d/field_names.h"
#include "import/x3d/node_table.h"
#include "import/x3d/x3d.h"
#include "markup/find_x3d.h"

#include <algorithm>
#include <array>

namespace imgeo {

namespace {

using namespace x3d;

/// X3D's name of an element whose letters may be in another case; the name itself where it is no node's.
std::string_view elementNameOf(std::string_view element) {
  if (nodeRow(element))
    return element;
  const auto found =
      std::ranges::find_if(nodeTable(), [&](const NodeRow& row) { return equalIgnoringCase(row.name, element); });
  return found == nodeTable().end() ? element : found->name;
}

} // namespace

void x3d::nameAsInX3d(pugi::xml_document& document) {
  struct Walker : pugi::xml_tree_walker {
    bool for_each(pugi::xml_node& node) override {
      if (node.type() != pugi::node_element)
        return true;
      node.set_name(std::string(elementNameOf(node.name())).c_str());
      for (pugi::xml_attribute& attribute : node.attributes())
        attribute.set_name(std::string(fieldNameOf(attribute.name())).c_str());
      return true;
    }
  };
  Walker walker;
  document.traverse(walker);
}

namespace {

/// Removes the attributes of <x3d> that are about its rectangle in the page.
void leaveOutPresentation(pugi::xml_node x3d) {
  constexpr std::array kept{std::string_view("profile"), std::string_view("version")};
  for (pugi::xml_attribute attribute = x3d.first_attribute(); attribute;) {
    const pugi::xml_attribute next = attribute.next_attribute();
    if (std::ranges::find(kept, std::string_view(attribute.name())) == kept.end())
      x3d.remove_attribute(attribute);
    attribute = next;
  }
}

/// Moves meta, component and unit elements into a <head>, which HTML does not allow within a page's body.
void restoreHead(pugi::xml_node x3d) {
  constexpr std::array statements{std::string_view("component"), std::string_view("meta"), std::string_view("unit")};
  std::vector<pugi::xml_node> found;
  for (const pugi::xml_node& child : x3d.children())
    if (std::ranges::find(statements, std::string_view(child.name())) != statements.end())
      found.push_back(child);
  if (found.empty())
    return;
  pugi::xml_node head = x3d.prepend_child("head");
  for (const pugi::xml_node& statement : found)
    head.append_move(statement);
}

} // namespace

bool isPage(ByteSpan bytes) {
  std::string_view text = withoutComments(asText(bytes).substr(0, 4096));
  while (text.starts_with("<?")) {
    const std::size_t end = text.find('>');
    if (end == text.npos)
      return false;
    text = withoutComments(text.substr(end + 1));
  }
  return isHtml(text, "");
}

Imported readPage(ByteSpan bytes, const std::string& name, const ImportOptions& options) {
  X3dElement page = parseX3d(asText(bytes), name);
  if (options.strict && !page.warnings.empty())
    throw Error(ErrorKind::malformed, name, withoutFullStop(page.warnings[0]));
  nameAsInX3d(page.document);
  const pugi::xml_node root = page.root();
  if (!root.child("Scene"))
    throw Error(ErrorKind::malformed, x3d::locationOf(asText(bytes), name, page.offsets.of(root)),
                "there is no Scene in the X3D element");
  leaveOutPresentation(root);
  restoreHead(root);
  Elements elements;
  elements.document = std::move(page.document);
  elements.offsets = std::move(page.offsets);
  elements.format = isHtml(asText(bytes), name) ? "HTML" : "XHTML";
  elements.warnings = std::move(page.warnings);
  Imported imported = readElements(std::move(elements), bytes, name, options);
  if (imported.scene.graph.title.empty())
    imported.scene.graph.title = page.pageTitle;
  return imported;
}

} // namespace imgeo
