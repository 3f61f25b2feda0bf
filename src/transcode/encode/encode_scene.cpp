#include "transcode/encode/encode_scene.h"

#include "base/shortest_decimal.h"
#include "containers/compact/base.h"
#include "containers/encodings.h"
#include "containers/named_attributes.h"
#include "import/warnings.h"
#include "transcode/default_scene/world_box.h"
#include "transcode/encode/load_groups.h"
#include "transcode/encode/patch_files.h"
#include "transcode/encode/spatial_order.h"
#include "transcode/encode/textures.h"
#include "transcode/site/staged_site.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <numbers>
#include <utility>

namespace imgeo {

namespace {

/// A warm stone: shape shows by shading, and nothing of it is clipped where all lights
/// meet: (1 + 0.4) * (diffuse + specular) + 0.2 * diffuse is about 1.
constexpr Material stone{.diffuseColor{0.52f, 0.51f, 0.485f}, .specularColor{0.13f, 0.13f, 0.12f}, .shininess = 0.25f};

/// From above and to the left of the viewer, warmer than the headlight, so that
/// carving casts light and shade across the view.
constexpr DirectionalLight keyLight{{-0.45, -0.8, -0.4}, {1.0f, 0.96f, 0.9f}, 0.4f};

/// From the other side, cooler, with light from everywhere: no wall or ceiling of a room
/// is black because the viewer looks along it.
constexpr DirectionalLight fillLight{{0.5, 0.7, 0.5}, {0.9f, 0.95f, 1.0f}, 0.3f};

/// A fifth of what a colour on the screen is: Material takes so much of ambient light, and
/// in a PhysicalMaterial's linear numbers 0.04 are as bright.
float ambientIntensityFor(const SceneGraph& graph) {
  const bool isPhysical = std::ranges::any_of(graph.appearances, [](const Appearance& appearance) {
    return std::holds_alternative<PhysicalMaterial>(appearance.material);
  });
  return isPhysical ? 0.04f : 1.0f;
}

constexpr Background sky{{0.93f, 0.94f, 0.95f}};

bool drawsSurface(const GeometryDescription& geometry) {
  const Primitive primitive = geometry.patches.front().draws.front().primitive;
  return primitive == Primitive::triangles || primitive == Primitive::triangleStrip;
}

/// X3D does not light points and lines: it shows their own or the emissive colour.
AnyMaterial shiningMaterial(const AnyMaterial& material) {
  Material shining = phongOf(material);
  if (shining.emissiveColor == Vec3f{})
    shining.emissiveColor = shining.diffuseColor;
  return shining;
}

/// Gives shapes without an appearance one, and those that are no surface one that shines.
class Looks {
public:
  explicit Looks(SceneGraph& graph) : graph_(graph) {}

  std::size_t lookFor(const Shape& shape, bool isSurface) {
    if (shape.appearance && isSurface)
      return *shape.appearance;
    const auto [look, isNew] = made_.try_emplace({shape.appearance, isSurface}, graph_.appearances.size());
    if (isNew) {
      Appearance appearance;
      appearance.material = stone;
      if (shape.appearance)
        appearance = graph_.appearances[*shape.appearance];
      if (!isSurface)
        appearance.material = shiningMaterial(appearance.material);
      graph_.appearances.push_back(std::move(appearance));
    }
    return look->second;
  }

private:
  SceneGraph& graph_;
  std::map<std::pair<std::optional<std::size_t>, bool>, std::size_t> made_;
};

/// The map back; the determinant is not 0.
Affine3d inverseOf(const Affine3d& map) {
  const Vec3d a = cross(map.y, map.z), b = cross(map.z, map.x), c = cross(map.x, map.y);
  const double scale = 1 / map.determinant();
  Affine3d back{Vec3d{a.x, b.x, c.x} * scale, Vec3d{a.y, b.y, c.y} * scale, Vec3d{a.z, b.z, c.z} * scale, {}};
  back.translation = back.direction(map.translation) * -1;
  return back;
}

/// Lets viewpoints turn around the middle of what is seen, which their sources say
/// nothing of. One that stands in several places does so for the first.
class Aiming {
public:
  Aiming(SceneGraph& graph, Vec3d center) : graph_(graph), center_(center), isSeen_(graph.nodes.size()) {}

  void aim(std::size_t index, const Affine3d& worldFromParent) {
    if (isSeen_[index])
      return;
    isSeen_[index] = true;
    Node& node = graph_.nodes[index];
    if (worldFromParent.determinant() != 0) {
      const Vec3d center = inverseOf(worldFromParent).point(center_);
      if (Viewpoint* viewpoint = std::get_if<Viewpoint>(&node.content))
        viewpoint->centerOfRotation = center;
      if (OrthoViewpoint* viewpoint = std::get_if<OrthoViewpoint>(&node.content))
        viewpoint->centerOfRotation = center;
    }
    const Transform* transform = std::get_if<Transform>(&node.content);
    const Affine3d worldFromNode = transform ? worldFromParent * affineOf(*transform) : worldFromParent;
    for (const std::size_t child : node.children)
      aim(child, worldFromNode);
  }

private:
  SceneGraph& graph_;
  Vec3d center_;
  std::vector<bool> isSeen_;
};

/// In digits that people read: off by less than a millionth of how far it is away.
Viewpoint framing(const Box3d& box) {
  Viewpoint viewpoint = viewpointFor(box);
  const double tolerance = 1e-6 * length(viewpoint.position - viewpoint.centerOfRotation);
  for (int axis = 0; axis < 3; ++axis) {
    viewpoint.position[axis] = shortestWithin(viewpoint.position[axis], tolerance);
    viewpoint.centerOfRotation[axis] = shortestWithin(viewpoint.centerOfRotation[axis], tolerance);
    viewpoint.orientation.axis[axis] = shortestWithin(viewpoint.orientation.axis[axis], 1e-6);
  }
  viewpoint.orientation.angle = shortestWithin(viewpoint.orientation.angle, 1e-6);
  return viewpoint;
}

/// Puts the nodes that a page needs and the source lacks before its own.
void addDefaults(SceneDocument& document, std::vector<std::string>& warnings) {
  SceneGraph& graph = document.graph;
  bool hasViewpoint = false, hasLight = false;
  for (const std::size_t index : nodesInOrder(graph)) {
    const NodeContent& content = graph.nodes[index].content;
    hasViewpoint |= std::holds_alternative<Viewpoint>(content) || std::holds_alternative<OrthoViewpoint>(content);
    hasLight |= std::holds_alternative<DirectionalLight>(content) || std::holds_alternative<PointLight>(content) ||
                std::holds_alternative<SpotLight>(content);
  }
  const WorldBox world = worldBoxOf(document);
  const Box3d whole = world.box.empty() ? Box3d{{}, {}} : world.box;
  if (world.absurdShapes > 0)
    warnings.push_back(fmt::format("{} scaled by more than 10^15 or less than 10^-15, or moved as far: what "
                                   "stands there cannot be drawn.",
                                   counted(world.absurdShapes, "shape is", "shapes are")));
  Aiming aiming(graph, whole.center());
  for (const std::size_t root : graph.roots)
    aiming.aim(root, {});
  const auto addFirst = [&](NodeContent content) {
    graph.roots.insert(graph.roots.begin(), addNode(graph, {"", std::move(content), {}, ""}));
  };
  if (!hasLight) {
    DirectionalLight fill = fillLight;
    fill.ambientIntensity = ambientIntensityFor(graph);
    addFirst(fill);
    addFirst(keyLight);
  }
  if (!hasViewpoint)
    addFirst(framing(whole));
  if (!graph.background)
    graph.background = sky;
}

/// The bases of all geometries, in one file as long as they fit into it.
class Bases {
public:
  explicit Bases(ContentFiles& files) : files_(files) {}

  /// The base of the geometry with this number.
  void add(compact::CompactPatch base, std::size_t geometry) {
    if (!contents_.fits(base, compact::maxPatchCount))
      close();
    contents_.add(std::move(base));
    geometries_.push_back(geometry);
  }
  void write(std::vector<GeometryDescription>& geometries) {
    close();
    for (auto& [geometry, reference] : references_)
      geometries[geometry].base = std::move(reference);
  }

private:
  void close() {
    const FileContents contents = std::exchange(contents_, {});
    if (contents.patches().empty())
      return;
    const EncodedFile file = baseFile(contents.patches());
    const std::string url = files_.write(file.bytes, file.extension);
    for (std::size_t number = 0; number < geometries_.size(); ++number)
      references_.push_back({geometries_[number], {url, static_cast<std::uint32_t>(number), 0}});
    geometries_.clear();
  }

  ContentFiles& files_;
  FileContents contents_;
  std::vector<std::size_t> geometries_; ///< of the contents
  std::vector<std::pair<std::size_t, Reference>> references_;
};

/// What a report says of the attributes of a geometry, which are those of others, too.
void addAttributes(std::vector<AttributeReport>& reports, const GeometryDescription& geometry) {
  for (const AttributeDescription& attribute : geometry.attributes) {
    auto report = std::ranges::find(reports, attribute.name, &AttributeReport::name);
    if (report == reports.end())
      report = reports.insert(report, {attribute.name, attribute.components, 0, 0});
    const bool isTyped = hasElementTypes(geometry.encoding);
    report->bits = std::max(report->bits, isTyped ? 32 : 8 * attribute.bytes);
    for (std::uint32_t c = 0; c < attribute.components; ++c)
      report->error = std::max(report->error, numberBound(geometry.encoding, attribute, c));
  }
}

void addEncoded(ConvertReport& report, const EncodedMesh& encoded) {
  report.elements += encoded.elements;
  report.vertices += encoded.vertices;
  report.patches += encoded.geometry.patches.size();
  report.collapsed += encoded.collapsed;
  report.positionError = std::max(report.positionError, encoded.positionError);
  report.normalErrorDegrees = std::max(report.normalErrorDegrees, encoded.normalErrorDegrees);
  const Lattice& lattice = encoded.geometry.lattice;
  report.largestStep = std::max(report.largestStep, lattice.step);
  report.leastPositionBits =
      report.leastPositionBits == 0 ? lattice.bits : std::min(report.leastPositionBits, lattice.bits);
  report.mostPositionBits = std::max(report.mostPositionBits, lattice.bits);
  report.hasNormals |= encoded.hasNormals;
  report.hasColors |= encoded.hasColors;
  if (encoded.texCoordError)
    report.texCoordError = std::max(report.texCoordError.value_or(0), *encoded.texCoordError);
  addAttributes(report.attributes, encoded.geometry);
}

/// Lets shapes name geometries, which are meshes in the order of their first use, and
/// returns each geometry's mesh.
std::vector<std::size_t> numberGeometries(SceneGraph& graph) {
  std::vector<std::size_t> meshOf;
  std::map<std::size_t, std::size_t> geometryOf;
  for (const std::size_t node : shapeNodes(graph)) {
    Shape& shape = std::get<Shape>(graph.nodes[node].content);
    const auto [geometry, isNew] = geometryOf.try_emplace(shape.mesh, meshOf.size());
    if (isNew)
      meshOf.push_back(shape.mesh);
    shape.mesh = geometry->second;
  }
  return meshOf;
}

std::vector<Box3d> boxesOf(const std::vector<Mesh>& meshes, const std::vector<std::size_t>& meshOf) {
  std::vector<Box3d> boxes;
  for (const std::size_t mesh : meshOf)
    boxes.push_back(boxOf(meshes[mesh]));
  return boxes;
}

void giveLooks(SceneDocument& document) {
  Looks looks(document.graph);
  for (const std::size_t node : shapeNodes(document.graph)) {
    Shape& shape = std::get<Shape>(document.graph.nodes[node].content);
    shape.appearance = looks.lookFor(shape, drawsSurface(document.geometries[shape.mesh]));
  }
}

} // namespace

SceneDocument encodeScene(Scene&& scene, const ConvertOptions& options, SiteContent& content, ConvertReport& report,
                          const ElementsDone& done) {
  SceneDocument document;
  document.graph = std::move(scene.graph);
  const std::vector<std::size_t> meshOf = numberGeometries(document.graph);
  document.geometries.resize(meshOf.size());
  Bases bases(content.geometry);
  const std::vector<std::size_t> groups = loadGroups(document.graph);
  PatchFiles patchFiles(content.geometry, options.effort);
  std::vector<bool> isEncoded(meshOf.size());
  for (const std::size_t node : spatialOrder(document.graph, boxesOf(scene.meshes, meshOf))) {
    const std::size_t geometry = shapeOf(document.graph, node).mesh;
    if (isEncoded[geometry])
      continue;
    isEncoded[geometry] = true;
    EncodedMesh encoded = encodeMesh(std::move(scene.meshes[meshOf[geometry]]), options, content.geometry, done);
    addEncoded(report, encoded);
    if (encoded.base)
      bases.add(std::move(*encoded.base), geometry);
    if (encoded.small)
      patchFiles.add(std::move(*encoded.small), geometry, groups[node]);
    document.geometries[geometry] = std::move(encoded.geometry);
  }
  if (!document.graph.isComplete)
    giveLooks(document);
  for (PatchFiles::Placed& placed : patchFiles.finish()) {
    document.geometries[placed.geometry].patches[0].data = std::move(placed.data);
    report.normalErrorDegrees = std::max(report.normalErrorDegrees, placed.normalError * (180 / std::numbers::pi));
  }
  bases.write(document.geometries);
  report.textures = writeTextures(document.graph, options, content.textures, report.warnings);
  if (!document.graph.isComplete)
    addDefaults(document, report.warnings);
  return document;
}

} // namespace imgeo
