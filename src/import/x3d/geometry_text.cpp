#include "import/x3d/geometry_text.h"

#include "import/x3d/node_faces.h"
#include "import/x3d/sized_nodes.h"

#include <string_view>

namespace imgeo::x3d {

namespace {

std::size_t textBytesOf(pugi::xml_node element) {
  std::size_t bytes = std::string_view(element.name()).size();
  for (const pugi::xml_attribute& attribute : element.attributes())
    bytes += std::string_view(attribute.name()).size() + std::string_view(attribute.value()).size();
  return bytes;
}

} // namespace

std::size_t geometryTextBytesOf(const Source& source, pugi::xml_node geometry) {
  std::size_t bytes = textBytesOf(geometry);
  for (const pugi::xml_node& child : geometry.children())
    if (child.type() == pugi::node_element)
      bytes += textBytesOf(source.resolved(child));
  return bytes;
}

std::size_t smallGeometryTextBytes(const Source& source, std::size_t maxBytes) {
  struct Walker : pugi::xml_tree_walker {
    Walker(const Source& document, std::size_t limit) : source(document), maxBytes(limit) {}
    bool for_each(pugi::xml_node& node) override {
      if (becomesMesh(node.name()) && !hasOnlySizes(node.name()))
        if (const std::size_t bytes = geometryTextBytesOf(source, node); bytes <= maxBytes)
          sum += bytes;
      return true;
    }
    const Source& source;
    const std::size_t maxBytes;
    std::size_t sum = 0;
  };
  Walker walker(source, maxBytes);
  source.root().traverse(walker);
  return walker.sum;
}

} // namespace imgeo::x3d
