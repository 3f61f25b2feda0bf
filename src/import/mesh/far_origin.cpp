#include "import/mesh/far_origin.h"

#include "import/mesh/metadata_set.h"

#include <cmath>
#include <fmt/format.h>
#include <locale>
#include <sstream>
#include <string>
#include <string_view>
#include <variant>

namespace imgeo {

namespace {

constexpr double minFar = 0x1p16, maxFar = 0x1p40;
constexpr const char* setName = "georeference";

std::string_view fieldOf(const Node& node, std::string_view field) {
  for (const auto& [name, value] : node.fields)
    if (name == field)
      return value;
  return {};
}

bool isElement(const Node& node, std::string_view element, std::string_view name) {
  const auto* generic = std::get_if<GenericNode>(&node.content);
  return generic && generic->element == element && fieldOf(node, "name") == name;
}

} // namespace

Vec3d farOriginOf(const Vec3d& first) {
  Vec3d origin{0, 0, 0};
  for (int axis = 0; axis < 3; ++axis)
    if (const double distance = std::abs(first[axis]); distance >= minFar && distance < maxFar)
      origin[axis] = std::floor(first[axis]);
  return origin;
}

void addOrigin(SceneGraph& graph, const Vec3d& origin) {
  if (origin == Vec3d{0, 0, 0} || graph.roots.empty())
    return;
  MetadataSet set(graph);
  set.add("MetadataDouble", "origin", fmt::format("{} {} {}", origin.x, origin.y, origin.z));
  set.addTo(graph.roots.front(), setName);
}

Vec3d statedOrigin(const SceneGraph& graph) {
  for (const Node& set : graph.nodes) {
    if (!isElement(set, "MetadataSet", setName))
      continue;
    for (const std::size_t child : set.children)
      if (isElement(graph.nodes[child], "MetadataDouble", "origin")) {
        std::istringstream text{std::string(fieldOf(graph.nodes[child], "value"))};
        text.imbue(std::locale::classic());
        Vec3d origin{0, 0, 0};
        text >> origin.x >> origin.y >> origin.z;
        return text ? origin : Vec3d{0, 0, 0};
      }
  }
  return {0, 0, 0};
}

} // namespace imgeo
