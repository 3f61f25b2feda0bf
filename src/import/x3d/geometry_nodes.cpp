#include "import/x3d/geometry_nodes.h"

#include "import/complete_import.h"
#include "import/x3d/geometry.h"
#include "import/x3d/node_faces.h"
#include "import/x3d/page.h"
#include "import/x3d/solid_sizes.h"
#include "import/x3d/source.h"
#include "import/x3d/texture_coordinates.h"
#include "scene/operators.h"

#include <unordered_map>
#include <utility>

namespace imgeo {

namespace {

x3d::Elements parsedElements(std::string_view text, const std::string& name) {
  X3dElement parsed = parseX3d(text, name);
  x3d::nameAsInX3d(parsed.document);
  x3d::Elements elements;
  elements.document = std::move(parsed.document);
  elements.offsets = std::move(parsed.offsets);
  return elements;
}

} // namespace

struct GeometryNodes::Document {
  Document(std::string_view documentText, const std::string& documentName, const ImportOptions& importOptions)
      : text(documentText), name(documentName), options(importOptions), kept(importOptions.attributes),
        source(parsedElements(text, name), text, name) {
    addTextureMappings(source, kept);
    struct Walker : pugi::xml_tree_walker {
      explicit Walker(Document& into) : document(into) {}
      bool for_each(pugi::xml_node& node) override {
        if (x3d::becomesMesh(node.name()))
          document.nodes.emplace(document.offsetOf(node), node);
        return true;
      }
      Document& document;
    } walker(*this);
    source.root().traverse(walker);
  }

  std::size_t offsetOf(pugi::xml_node node) const { return source.documentText().offsets.of(node); }

  const std::string text, name;
  const ImportOptions options;
  AttributeChoice kept;
  x3d::Source source;
  std::unordered_map<std::size_t, pugi::xml_node> nodes; ///< by the offset in the text
};

GeometryNodes::GeometryNodes(std::string_view text, const std::string& name, const ImportOptions& options)
    : document_(std::make_unique<Document>(text, name, options)) {}

GeometryNodes::~GeometryNodes() = default;

std::optional<NodeMesh> GeometryNodes::read(std::size_t offset) const {
  const auto found = document_->nodes.find(offset);
  if (found == document_->nodes.end())
    return {};
  const x3d::Source& source = document_->source;
  const pugi::xml_node node = found->second;
  checkSizes(source, node);
  std::optional<x3d::Geometry> geometry = readGeometry(source, node, document_->kept);
  NodeMesh read{std::move(geometry->mesh), geometry->solid};
  completeCreases(read.mesh, document_->options);
  if (read.mesh.corners.empty())
    return read;
  const auto [operators, problem] = readOperators(node.attribute("operators").value(), false);
  if (!operators.empty()) // a location takes a time that grows with the text before it
    applyOperators(read.mesh, operators, OperatorFrame::of(boxOf(read.mesh)), source.locationOf(node));
  read.solid = read.solid && orientationOf(operators) != Orientation::folded;
  return read;
}

} // namespace imgeo
