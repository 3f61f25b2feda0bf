#include "import/x3d/container_geometry.h"

#include "base/first_readable.h"
#include "containers/choose_urls.h"
#include "containers/encodings.h"
#include "containers/levels/level_patches.h"
#include "containers/read_mesh.h"
#include "documents/geometry_reader.h"
#include "import/x3d/pop_geometry.h"
#include "scene/mf_string.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <utility>

namespace imgeo::x3d {

namespace {

bool isPatchGeometry(std::string_view element) {
  return element == "ImageGeometry" || element == "BinaryGeometry";
}

} // namespace

bool isContainerGeometry(std::string_view element) {
  return isPatchGeometry(element) || element == "PopGeometry" || element == "ExternalGeometry";
}

std::vector<pugi::xml_node> geometriesOfPatches(const Source& source, pugi::xml_node group) {
  std::vector<pugi::xml_node> geometries;
  if (std::string_view(group.name()) != "Group" || !group.attribute("bboxSize"))
    return {};
  pugi::xml_node appearance;
  for (const pugi::xml_node& shape : group.children()) {
    if (shape.type() == pugi::node_comment)
      continue;
    pugi::xml_node geometry, ownAppearance;
    for (const pugi::xml_node& child : shape.children()) {
      const bool isAppearance = std::string_view(child.name()) == "Appearance";
      pugi::xml_node& part = isAppearance ? ownAppearance : geometry;
      if (part || !(isAppearance || isPatchGeometry(child.name())))
        return {};
      part = isAppearance ? source.resolved(child) : child;
    }
    const bool isShape =
        std::string_view(shape.name()) == "Shape" && !shape.attribute("DEF") && !shape.attribute("USE");
    if (!isShape || !ownAppearance || (appearance && appearance != ownAppearance) || !geometry ||
        geometry.attribute("DEF") || geometry.attribute("USE") || geometry.child("GeometryPatch"))
      return {};
    appearance = ownAppearance;
    geometries.push_back(geometry);
  }
  return geometries;
}

/// The description of a node. Its Shape's box stands in for those of patches that have none.
GeometryDescription ContainerGeometries::describe(pugi::xml_node node) const {
  GeometryDescription geometry = readGeometry(source_.documentText(), node, warnings_);
  if (const std::vector<Error> errors = chooseUrls(geometry, fetch_); !errors.empty())
    throw joined(errors);
  if (geometry.levels)
    readLevels(geometry, fetch_);
  if (!geometry.operators.empty())
    geometry.box = FieldReader(source_.documentText(), node.parent()).box();
  return geometry;
}

bool ContainerGeometries::isSolid(pugi::xml_node node) const {
  return readSolid(FieldReader(source_.documentText(), node, warnings_));
}

std::optional<std::vector<Mesh>> ContainerGeometries::read(std::span<const pugi::xml_node> nodes,
                                                           const AttributeChoice& kept,
                                                           std::set<std::string>& attributes,
                                                           bool keepsVertices) const {
  if (!isPatchGeometry(nodes[0].name()))
    return std::vector{readPopGeometry(source_, nodes[0], fetch_)};
  GeometryDescription geometry = describe(nodes[0]);
  std::vector<PatchDescription> patches = std::exchange(geometry.patches, {});
  for (const pugi::xml_node& node : nodes.subspan(1)) {
    GeometryDescription more = describe(node);
    std::ranges::move(std::exchange(more.patches, {}), std::back_inserter(patches));
    if (!(more == geometry))
      return {};
  }
  geometry.patches = std::move(patches);
  std::vector<Mesh> meshes;
  for (const GeometryDescription& part : splitByTopology(geometry)) {
    meshes.push_back(readMesh(reader_, part, source_.locationOf(nodes[0]), keepsVertices));
    chooseAttributes(meshes.back(), kept, attributes);
  }
  return meshes;
}

gltf::ShapeResource ContainerGeometries::readExternal(pugi::xml_node node, bool withMaterials) const {
  const std::vector<std::string> urls = parseStrings(node.attribute("url").value());
  if (urls.empty())
    throw Error(ErrorKind::malformed, source_.locationOf(node), "there is no url");
  return firstReadable(urls, [&](const std::string& url) {
    // What follows '#' names a mesh of the file.
    const std::size_t hash = std::min(url.find('#'), url.size());
    const std::string file = url.substr(0, hash), mesh = url.substr(std::min(hash + 1, url.size()));
    return gltf::readShapeResource(fetch_(file), file, mesh, withMaterials);
  });
}

std::map<std::uint32_t, ContainerGeometries::SharedPatch>
ContainerGeometries::readShared(pugi::xml_node node, const std::set<std::uint32_t>& indices,
                                const AttributeChoice& kept, std::set<std::string>& attributes) const {
  GeometryDescription geometry = describe(node);
  if (rowOf(geometry).storage != PatchStorage::packed || geometry.patches.size() != 1)
    source_.fail(node, ErrorKind::unsupported, "is no patch of compact, whose file Shapes can share");
  const std::string location = source_.locationOf(node);
  std::map<std::uint32_t, SharedPatch> patches;
  for (const std::uint32_t index : indices)
    try {
      geometry.patches[0].data->location = PatchLocation{index};
      Mesh mesh = readMesh(reader_, geometry, location);
      if (mesh.corners.empty())
        throw Error(ErrorKind::malformed, geometry.patches[0].data->url, fmt::format("patch {} is empty", index));
      chooseAttributes(mesh, kept, attributes);
      patches.emplace(index, std::move(mesh));
    } catch (const Error& error) {
      patches.emplace(index, error);
    }
  return patches;
}

void ContainerGeometries::chooseAttributes(Mesh& mesh, const AttributeChoice& kept, std::set<std::string>& attributes) {
  for (const NamedAttribute& attribute : mesh.namedAttributes)
    attributes.insert(attribute.name);
  std::erase_if(mesh.namedAttributes, [&](const NamedAttribute& attribute) { return !kept.has(attribute.name); });
}

} // namespace imgeo::x3d
