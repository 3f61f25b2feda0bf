#include "import/x3d/shared_patches.h"

#include "documents/geometry_reader.h"
#include "documents/patch_references.h"
#include "import/x3d/node_table.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo::x3d {

namespace {

bool isGeometry(pugi::xml_node element) {
  const NodeRow* row = nodeRow(element.name());
  return row && row->containerField == "geometry";
}

} // namespace

bool hasSharedPatch(const Source& source, pugi::xml_node shape) {
  return *shape.attribute("patch").value() != '\0' &&
         std::ranges::none_of(shape.children(),
                              [&](const pugi::xml_node& child) { return isGeometry(source.resolved(child)); });
}

std::optional<Shape> SharedPatches::shapeOf(pugi::xml_node element, bool isStrict) {
  if (!std::exchange(hasNames_, true))
    findNames();
  const std::string text = element.attribute("patch").value();
  const std::optional<PatchName> name = parsePatchName(text);
  const pugi::xml_node geometry = name ? source_.defined(name->geometry) : pugi::xml_node();
  const bool isNamed = isContainerGeometry(geometry.name());
  std::optional<Error> error;
  if (isNamed) {
    GeometryNode& node = nodes_[name->geometry];
    if (node.shapes.empty())
      readNode(geometry, node);
    const auto& found = node.shapes.at(name->index);
    if (const Shape* shape = std::get_if<Shape>(&found))
      return *shape;
    error = std::get<Error>(found);
  } else {
    error.emplace(ErrorKind::malformed, "", fmt::format("patch=\"{}\" names no patch of a geometry", text));
  }
  if (isStrict)
    source_.fail(element, faultOfSource(*error).kind(), error->what());
  Missing& missing = missing_[isNamed ? name->geometry : ""];
  if (++missing.count == 1) {
    missing.location = source_.locationOf(element);
    missing.reason = error->what();
  }
  return {};
}

/// Notes which patches of which nodes the Shapes of the document name.
void SharedPatches::findNames() {
  struct Walker : pugi::xml_tree_walker {
    explicit Walker(std::map<std::string, GeometryNode>& into) : nodes(into) {}
    bool for_each(pugi::xml_node& element) override {
      if (std::string_view(element.name()) == "Shape")
        if (const std::optional<PatchName> name = parsePatchName(element.attribute("patch").value()))
          nodes[name->geometry].indices.insert(name->index);
      return true;
    }
    std::map<std::string, GeometryNode>& nodes;
  };
  Walker walker(nodes_);
  source_.root().traverse(walker);
}

void SharedPatches::readNode(pugi::xml_node geometry, GeometryNode& node) {
  const bool isSolid = containers_.isSolid(geometry);
  try {
    for (auto& [index, patch] : containers_.readShared(geometry, node.indices, kept_, attributes_))
      if (const Error* error = std::get_if<Error>(&patch))
        node.shapes.emplace(index, *error);
      else
        node.shapes.emplace(index, addShape_(std::move(std::get<Mesh>(patch)), isSolid));
  } catch (const Error& error) { // the node is no such geometry
    for (const std::uint32_t index : node.indices)
      node.shapes.emplace(index, error);
  }
}

void SharedPatches::addTo(std::vector<std::string>& warnings) const {
  for (const auto& [name, missing] : missing_)
    warnings.push_back(missing.count == 1
                           ? fmt::format("{}: Shape left without its geometry: {}.", missing.location, missing.reason)
                           : fmt::format("{} Shapes left without their geometry, the first at {}: {}.", missing.count,
                                         missing.location, missing.reason));
}

} // namespace imgeo::x3d
