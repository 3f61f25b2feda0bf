#include "import/x3d/shape_reader.h"

#include "documents/animation_element.h"
#include "documents/geometry_reader.h"
#include "images/image_type.h"
#include "import/text/text_scanner.h"
#include "import/x3d/geometry.h"
#include "import/x3d/geometry_text.h"
#include "import/x3d/sized_nodes.h"
#include "import/x3d/solid_sizes.h"
#include "import/x3d/texture_coordinates.h"

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
                         Imported& imported, Summary& summary, Faults& faults, const Routes& routes)
    : source_(source), references_(references), imported_(imported), summary_(summary), faults_(faults),
      routes_(routes), inlineBytes_(options.inlineBytes), recordings_(source, options.recordings),
      readsFrames_(options.recordings.files), readsSolids_(options.solids), keptAttributes_(options.attributes),
      mappings_(options.attributes), warnings_(imported.warnings),
      containers_(source, references, options.strict ? nullptr : &warnings_),
      sharedPatches_(source, containers_, keptAttributes_, attributes_,
                     [this](Mesh mesh, bool isSolid) { return addShape(std::move(mesh), isSolid); }) {
  addTextureMappings(source_, mappings_);
  if (smallGeometryTextBytes(source_, inlineBytes_) > maxInlineTextBytes)
    inlineBytes_ = std::min(inlineBytes_, shortTextBytes);
  if (smallGeometryTextBytes(source_, inlineBytes_) > maxShortTextBytes)
    inlineBytes_ = 0;
}

void ShapeReader::finish() {
  imported_.attributes.assign(attributes_.begin(), attributes_.end());
  sharedPatches_.addTo(imported_.warnings);
}

/// Whether a geometry stays in the document because pages draw it from there and it is short, or routes connect it.
bool ShapeReader::staysInline(pugi::xml_node node) const {
  if (source_.pointAttributesOf(node)) // pages read joints of points from containers alone
    return false;
  return isDrawnInPages(node.name()) && (routes_.connects(node) || geometryTextBytesOf(source_, node) <= inlineBytes_);
}

std::vector<Shape> ShapeReader::shapesOf(pugi::xml_node node, bool isForCubeMap) {
  const auto [found, isNew] = converted_.try_emplace(node.internal_object());
  if (!isNew || !node)
    return found->second;
  if (isContainerGeometry(node.name()))
    return found->second = shapesOfFiles(node);
  std::optional<MovingVertices> moving = recordings_.of(node);
  std::optional<Geometry> geometry = faults_.attempt("A geometry is left as it is", [&]() -> std::optional<Geometry> {
    checkSizes(source_, node);
    if (hasOnlySizes(node.name()) && !readsSolids_)
      return {};
    return readGeometry(source_, node, mappings_, moving ? &*moving : nullptr);
  });
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
  if (!moving && staysInline(node))
    return {};
  noteDataOf(node);
  summary_.fans += geometry->fans;
  if (!operate(node, geometry->mesh))
    return {};
  const Shape shape = addShape(std::move(geometry->mesh), geometry->solid && containers_.isSolid(node));
  if (moving)
    record(node, shape.mesh, *std::move(moving), *geometry);
  return found->second = {shape};
}

/// Notes the interpolators that move the vertices of a mesh.
void ShapeReader::record(pugi::xml_node node, std::size_t mesh, MovingVertices moving, Geometry& geometry) {
  moving.coordinates.points = std::move(geometry.points);
  moving.coordinates.creaseAngle = geometry.creaseAngle;
  moving.normals.points = std::move(geometry.normalNumbers);
  recorded_.push_back(
      {mesh, {source_.resolved(node.child("Coordinate")), source_.resolved(node.child("Normal"))}, std::move(moving)});
}

/// The sequence of a geometry of files, with the paths of its index and its video.
std::optional<MovingVertices> ShapeReader::framesOf(pugi::xml_node node) const {
  if (!readsFrames_)
    return {};
  for (const pugi::xml_node& child : node.children()) {
    const FieldReader fields(source_.documentText(), child);
    std::optional<Interpolator> frames = readMovie(fields);
    if (!frames && interpolatorKindOf(child.name()) == InterpolatorKind::coordinate)
      frames = readInterpolator(InterpolatorKind::coordinate, fields);
    if (!frames || frames->url.empty())
      continue;
    for (std::string* url : {&frames->url, &frames->video})
      if (!url->empty())
        *url = references_.fileOf(*url).string();
    return MovingVertices{child.attribute("DEF").value(), "", *std::move(frames), {InterpolatorKind::normal, {}, {}}};
  }
  return {};
}

std::optional<Shape> ShapeReader::shapeOfSharedPatch(pugi::xml_node element) {
  return sharedPatches_.shapeOf(element, faults_.isStrict());
}

/// Maps a mesh by the operators of its node, in the box around it. False where that fails, which is noted.
bool ShapeReader::operate(pugi::xml_node node, Mesh& mesh) {
  const std::string text = node.attribute("operators").value();
  const auto [operators, problem] = readOperators(text, false);
  if (!problem.empty())
    faults_.attempt("A geometry is left without operators",
                    [&]() -> bool { source_.fail(node, ErrorKind::malformed, refusalOf(text, problem)); });
  if (operators.empty())
    return true; // before the line of the node is counted
  return faults_.attempt("A geometry is left as it is", [&] {
    applyOperators(mesh, operators, OperatorFrame::of(boxOf(mesh)), source_.locationOf(node));
    return true;
  });
}

Shape ShapeReader::addShape(Mesh mesh, bool isSolid) {
  std::vector<Mesh>& meshes = imported_.scene.meshes;
  meshes.push_back(std::move(mesh));
  return {meshes.size() - 1, {}, isSolid};
}

std::optional<Shape> ShapeReader::shapeOfPatches(const std::vector<pugi::xml_node>& geometries) {
  const std::size_t warningCount = warnings_.count();
  std::optional<std::vector<Mesh>> meshes;
  try {
    meshes = containers_.read(geometries, keptAttributes_, attributes_);
  } catch (const Error&) {
    meshes.reset();
  }
  if (!meshes || meshes->size() != 1 || meshes->front().corners.empty()) {
    warnings_.keepFirst(warningCount); // the Shapes, which are read one by one, have them again
    return {};
  }
  return addShape(std::move(meshes->front()), containers_.isSolid(geometries[0]));
}

template <typename Read> auto ShapeReader::attemptFiles(pugi::xml_node node, const Read& read) -> decltype(read()) {
  try {
    return read();
  } catch (const Error& error) {
    if (faults_.isStrict())
      throw faultOfSource(error);
    // An Error of the document's own text has its line, that of the node or of a child; one of its URLs has its name.
    const std::string location = source_.locationOf(node), file = location.substr(0, location.find(':'));
    const bool hasLine = error.location().starts_with(file + ':'), isOfDocument = hasLine || error.location() == file;
    imported_.warnings.push_back(fmt::format("{}: {} left out: {}.", hasLine ? error.location() : location, node.name(),
                                             isOfDocument ? error.message() : error.what()));
    return {};
  }
}

/// Shapes with the meshes that a node's files hold. Empty where they cannot be read: pages could not either.
std::vector<Shape> ShapeReader::shapesOfFiles(pugi::xml_node node) {
  if (std::string_view(node.name()) == "ExternalGeometry")
    return shapesOfResource(node, attemptFiles(node, [&] { return containers_.readExternal(node, false); }));
  std::optional<MovingVertices> frames;
  std::optional<std::vector<Mesh>> meshes = attemptFiles(node, [&] {
    frames = framesOf(node);
    return containers_.read(std::array{node}, keptAttributes_, attributes_, frames.has_value());
  });
  if (!meshes)
    return {};
  std::vector<Shape> shapes;
  for (Mesh& mesh : *meshes)
    if (!mesh.corners.empty())
      shapes.push_back(addShape(std::move(mesh), containers_.isSolid(node)));
  if (frames && shapes.size() == 1)
    recorded_.push_back({shapes[0].mesh, {}, *std::move(frames)});
  if (shapes.empty())
    ++summary_.empty[node.name()];
  return shapes;
}

std::vector<Shape> ShapeReader::shapesOfExternal(pugi::xml_node externalShape) {
  const auto [found, isNew] = converted_.try_emplace(externalShape.internal_object());
  if (isNew)
    found->second = shapesOfResource(
        externalShape, attemptFiles(externalShape, [&] { return containers_.readExternal(externalShape, true); }));
  return found->second;
}

/// Adds the meshes of a container and, for an ExternalShape, its materials: without one, X3D's default.
std::vector<Shape> ShapeReader::shapesOfResource(pugi::xml_node node, gltf::ShapeResource resource) {
  std::vector<Shape> shapes;
  std::map<std::optional<std::size_t>, std::size_t> appearances; ///< by material
  const bool isSolid = source_.boolean(node, "solid", true), isCcw = source_.boolean(node, "ccw", true);
  for (auto& [mesh, material] : resource.shapes) {
    if (mesh.corners.empty())
      continue;
    for (std::size_t i = 0; !isCcw && mesh.topology == Topology::triangles && i < mesh.corners.size(); i += 3)
      std::swap(mesh.corners[i + 1], mesh.corners[i + 2]);
    shapes.push_back(addShape(std::move(mesh), material ? resource.materials[*material].isSolid : isSolid));
    if (std::string_view(node.name()) != "ExternalShape")
      continue;
    if (!appearances.contains(material))
      appearances[material] = addAppearance(material ? resource.materials[*material] : gltf::ResourceMaterial{});
    shapes.back().appearance = appearances[material];
  }
  if (shapes.empty() && !resource.shapes.empty())
    ++summary_.empty[node.name()];
  return shapes;
}

std::size_t ShapeReader::addAppearance(gltf::ResourceMaterial material) {
  SceneGraph& graph = imported_.scene.graph;
  Appearance appearance;
  appearance.name = material.name;
  appearance.material = material.material;
  for (auto& [role, bytes] : material.images) {
    if (imageType(bytes).empty()) {
      imported_.warnings.push_back(
          fmt::format("The texture of material \"{}\" is left out: it is an image of a kind that browsers do not show.",
                      asPrintable(material.name)));
      continue;
    }
    graph.images.push_back({"", std::move(bytes)});
    Texture texture;
    texture.image = graph.images.size() - 1;
    graph.textures.push_back(std::move(texture));
    appearance.textures.push_back({role, graph.textures.size() - 1, {}, {}});
  }
  graph.appearances.push_back(std::move(appearance));
  return graph.appearances.size() - 1;
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
