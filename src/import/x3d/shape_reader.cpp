#include "import/x3d/shape_reader.h"

#include "import/x3d/geometry.h"
#include "import/x3d/geometry_text.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace imgeo::x3d {

namespace {

/// Pages parse this much geometry text in the time that a worker takes to start. Documents with more keep only geometry
/// as short as a box (docs/decisions/scenes.md).
constexpr std::size_t maxInlineTextBytes = 64 << 10, shortTextBytes = 256;

/// Documents with more geometry text than this in short pieces keep none: a shape takes fewer bytes as an index in a
/// file that it shares (docs/decisions/tiny-shapes.md).
constexpr std::size_t maxShortTextBytes = 512 << 10;

} // namespace

ShapeReader::ShapeReader(const Source& source, const References& references, const ImportOptions& options,
                         Imported& imported, Summary& summary, Faults& faults)
    : source_(source), imported_(imported), summary_(summary), faults_(faults), inlineBytes_(options.inlineBytes),
      keptAttributes_(options.attributes), mappings_(options.attributes), containers_(source, references),
      sharedPatches_(source, containers_, keptAttributes_, attributes_,
                     [this](Mesh mesh, bool isSolid) { return addShape(std::move(mesh), isSolid); }) {
  addTextureMappings();
  if (smallGeometryTextBytes(source_, inlineBytes_) > maxInlineTextBytes)
    inlineBytes_ = std::min(inlineBytes_, shortTextBytes);
  if (smallGeometryTextBytes(source_, inlineBytes_) > maxShortTextBytes)
    inlineBytes_ = 0;
}

void ShapeReader::finish() {
  imported_.attributes.assign(attributes_.begin(), attributes_.end());
  sharedPatches_.addTo(imported_.warnings);
}

/// Whether a geometry stays in the document because it is short and pages draw it from there.
bool ShapeReader::staysInline(pugi::xml_node node) const {
  return isDrawnInPages(node.name()) && geometryTextBytesOf(source_, node) <= inlineBytes_;
}

/// Adds the `mapping` of every texture of the document: the values of materials' fields such as normalTextureMapping.
void ShapeReader::addTextureMappings() {
  struct Walker : pugi::xml_tree_walker {
    explicit Walker(std::set<std::string>& into) : names(into) {}
    bool for_each(pugi::xml_node& node) override {
      for (const pugi::xml_attribute& attribute : node.attributes())
        if (std::string_view(attribute.name()).ends_with("TextureMapping"))
          names.insert(attribute.value());
      return true;
    }
    std::set<std::string>& names;
  };
  Walker walker(mappings_.names);
  source_.root().traverse(walker);
}

std::optional<Shape> ShapeReader::shapeOf(pugi::xml_node node, bool isForCubeMap) {
  const auto [found, isNew] = converted_.try_emplace(node.internal_object());
  if (!isNew || !node)
    return found->second;
  if (isContainerGeometry(node.name()))
    return found->second = shapeOfFiles(node);
  std::optional<Geometry> geometry =
      faults_.attempt("A geometry is left as it is", [&] { return readGeometry(source_, node, mappings_); });
  if (!geometry)
    return {};
  if (geometry->mesh.corners.empty()) {
    ++summary_.empty[node.name()];
    return {};
  }
  if (geometry->nurbsError)
    summary_.noteNurbs(*geometry->nurbsError);
  summary_.furtherTexCoords += geometry->furtherTexCoords > 0 ? 1 : 0;
  if (!geometry->approximatedTexCoords.empty() && !isForCubeMap)
    ++summary_.approximatedTexCoords[geometry->approximatedTexCoords];
  if (staysInline(node))
    return {};
  noteDataOf(node);
  summary_.fans += geometry->fans;
  return found->second = addShape(std::move(geometry->mesh), geometry->solid);
}

std::optional<Shape> ShapeReader::shapeOfSharedPatch(pugi::xml_node element) {
  return sharedPatches_.shapeOf(element, faults_.isStrict());
}

Shape ShapeReader::addShape(Mesh mesh, bool isSolid) {
  std::vector<Mesh>& meshes = imported_.scene.meshes;
  meshes.push_back(std::move(mesh));
  return {meshes.size() - 1, {}, isSolid};
}

std::optional<Shape> ShapeReader::shapeOfPatches(const std::vector<pugi::xml_node>& geometries) {
  std::optional<Mesh> mesh;
  try {
    mesh = containers_.read(geometries, keptAttributes_, attributes_);
  } catch (const Error&) {
    return {}; // the Shape of the geometry that cannot be read has a warning
  }
  if (!mesh || mesh->corners.empty())
    return {};
  return addShape(std::move(*mesh), source_.boolean(geometries[0], "solid", true));
}

/// A shape with the mesh that a node's files hold. Empty where they cannot be read: pages could not either.
std::optional<Shape> ShapeReader::shapeOfFiles(pugi::xml_node node) {
  std::optional<Mesh> mesh;
  try {
    mesh = containers_.read(std::array{node}, keptAttributes_, attributes_);
  } catch (const Error& error) {
    if (faults_.isStrict()) // a missing file is a fault of the document, not of the disk
      throw Error(error.kind() == ErrorKind::io ? ErrorKind::malformed : error.kind(), error.location(),
                  error.message());
    imported_.warnings.push_back(
        fmt::format("{}: {} left out: {}.", source_.locationOf(node), node.name(), error.what()));
    return {};
  }
  if (mesh->corners.empty()) {
    ++summary_.empty[node.name()];
    return {};
  }
  return addShape(std::move(*mesh), source_.boolean(node, "solid", true));
}

/// Notes the children of a geometry node that its mesh does not hold.
void ShapeReader::noteDataOf(pugi::xml_node geometry) {
  for (const pugi::xml_node& child : geometry.children())
    if (child.type() == pugi::node_element && isLeftOut(child.name()))
      faults_.leaveOut(child);
    else
      summary_.noteKept(child.name());
}

} // namespace imgeo::x3d
