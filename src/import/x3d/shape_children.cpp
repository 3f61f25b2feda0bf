#include "import/x3d/shape_children.h"

#include "import/x3d/container_geometry.h"
#include "import/x3d/node_table.h"
#include "import/x3d/texture_coordinates.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace imgeo::x3d {

namespace {

bool isGeometryChild(pugi::xml_node node) {
  const NodeRow* row = nodeRow(node.name());
  return isContainerGeometry(node.name()) || (row && row->containerField == "geometry");
}

/// Whether the Appearance of a Shape has a cube map.
bool hasCubeMap(const Source& source, pugi::xml_node shape) {
  const auto isCubeMap = [](const pugi::xml_node& node) {
    return std::string_view(node.name()).ends_with("CubeMapTexture");
  };
  return std::ranges::any_of(shape.children("Appearance"), [&](const pugi::xml_node& child) {
    return !source.resolved(child).find_node(isCubeMap).empty();
  });
}

} // namespace

bool isFurtherGeometry(pugi::xml_node child, pugi::xml_node parent) {
  return std::string_view(parent.name()) == "Shape" && isGeometryChild(child) &&
         child != parent.find_child([](const pugi::xml_node& node) { return isGeometryChild(node); });
}

void requireOneGeometry(const Source& source, pugi::xml_node shape, Faults& faults) {
  const auto count = std::ranges::count_if(shape.children(), isGeometryChild);
  if (count > 1)
    faults.attempt("The others are left out", [&]() -> bool {
      source.fail(shape, ErrorKind::malformed,
                  fmt::format("a Shape has one geometry; of {} the first is drawn", count));
    });
}

pugi::xml_node cameraGeneratorOf(const Source& source, pugi::xml_node shape, pugi::xml_node geometry) {
  if (!hasCubeMap(source, shape))
    return {};
  for (const pugi::xml_node& node : texCoordNodes(source, geometry))
    if (std::string_view(node.attribute("mode").value()).starts_with("CAMERASPACE"))
      return node;
  return {};
}

} // namespace imgeo::x3d
