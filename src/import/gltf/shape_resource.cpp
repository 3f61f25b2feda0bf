#include "import/gltf/shape_resource.h"

#include "import/gltf/gltf1.h"
#include "import/gltf/primitive.h"
#include "import/gltf/shape_resource_materials.h"
#include "import/gltf/shape_resource_upgrade.h"
#include "import/import.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

namespace imgeo::gltf {

namespace {

struct Container {
  std::string_view json;
  ByteSpan body;
};

/// The header's JSON and the bytes after it. Both layouts begin with a magic number and a version.
Container containerOf(ByteSpan bytes, const std::string& name) {
  const bool isGltf = isGlb(bytes);
  const std::size_t fixedBytes = isGltf ? 20 : 12;
  if (bytes.size() < fixedBytes)
    throw Error(ErrorKind::truncated, name, fmt::format("a container has a header of at least {} bytes", fixedBytes));
  const auto word = [&](std::size_t index) { return loadLittle<std::uint32_t>(bytes.data() + 4 * index); };
  if (isGltf && word(1) != 1)
    throw Error(ErrorKind::unsupported, name, fmt::format("is glTF {}, which an Inline can name", word(1)));
  if (isGltf && word(2) > bytes.size())
    throw Error(ErrorKind::truncated, name, fmt::format("has {} bytes, but its header says {}", bytes.size(), word(2)));
  // glTF: magic, version, length of the file, length of the JSON, its format (0). Before: magic, version, length of the
  // JSON.
  const std::uint32_t jsonBytes = word(isGltf ? 3 : 2);
  if (jsonBytes == 0 || jsonBytes > bytes.size() - fixedBytes)
    throw Error(jsonBytes == 0 ? ErrorKind::malformed : ErrorKind::truncated, name,
                fmt::format("has a header of {} bytes, where {} follow", jsonBytes, bytes.size() - fixedBytes));
  if (isGltf && word(4) != 0)
    throw Error(ErrorKind::unsupported, name, "has a header that is no JSON");
  const ByteSpan body = bytes.subspan(fixedBytes + jsonBytes);
  return {asText(bytes.subspan(fixedBytes, jsonBytes)), body};
}

/// The names of the meshes to read, each once.
std::vector<std::string> meshesToRead(const Value& root, const std::string& mesh) {
  const Value meshes = root["meshes"], nodes = root["nodes"];
  std::vector<std::string> names;
  if (!mesh.empty()) {
    if (!meshes.has(mesh.c_str()))
      meshes.fail(ErrorKind::malformed, fmt::format("has no mesh \"{}\"", mesh));
    return {mesh};
  }
  const std::string scene = root["scene"].text();
  if (scene.empty() || !root["scenes"].has(scene.c_str())) {
    for (const auto& [name, unused] : meshes.json().items())
      names.push_back(name);
    return names;
  }
  std::set<std::string> seenNodes, seenMeshes;
  std::vector<Value> lists{root["scenes"][scene.c_str()]["nodes"]};
  while (!lists.empty()) {
    const Value list = lists.back();
    lists.pop_back();
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string key = list[i].text();
      if (!seenNodes.insert(key).second || !nodes.has(key.c_str()))
        continue;
      const Value node = nodes[key.c_str()], ofNode = node["meshes"];
      for (std::size_t n = 0; n < ofNode.size(); ++n)
        if (std::string name = ofNode[n].text(); seenMeshes.insert(name).second)
          names.push_back(std::move(name));
      lists.push_back(node["children"]);
    }
  }
  return names;
}

/// Takes a named attribute out of a mesh; empty where it has none.
std::optional<NamedAttribute> taken(Mesh& mesh, const char* storedName) {
  const auto found = std::ranges::find(mesh.namedAttributes, storedName + 1, &NamedAttribute::name);
  if (found == mesh.namedAttributes.end())
    return {};
  NamedAttribute attribute = std::move(*found);
  mesh.namedAttributes.erase(found);
  return attribute;
}

/// Makes the stored colours and texture coordinates those of the mesh.
void readStored(Mesh& mesh, bool isUpsideDown, const Value& location) {
  if (const auto colors = taken(mesh, storedColor)) {
    if (colors->components != 3 && colors->components != 4)
      location.fail(ErrorKind::malformed, "has colors of the wrong number of components");
    for (std::size_t i = 0; i < colors->values.size(); i += colors->components) {
      const float* value = &colors->values[i];
      const float alpha = colors->components == 4 ? channelOf(value[3]) : 1;
      mesh.colors.emplace_back(channelOf(value[0]), channelOf(value[1]), channelOf(value[2]), alpha);
    }
    mesh.colorComponents = colors->components;
  }
  if (const auto texCoords = taken(mesh, storedTexCoord)) {
    if (texCoords->components != 2)
      location.fail(ErrorKind::malformed, "has texture coordinates of the wrong number of components");
    for (std::size_t i = 0; i < texCoords->values.size(); i += 2)
      mesh.texCoords.push_back(
          {texCoords->values[i], isUpsideDown ? 1 - texCoords->values[i + 1] : texCoords->values[i + 1]});
  }
}

void append(Mesh& mesh, const Mesh& more, const Value& location) {
  const std::size_t before = mesh.wedgeCount(), positions = mesh.positions.size();
  if (std::max(before + more.wedgeCount(), mesh.corners.size() + more.corners.size()) >
      std::numeric_limits<std::uint32_t>::max())
    location.fail(ErrorKind::limit, "has more vertices than 32 bits count");
  append(mesh, before, more, more.wedgeCount());
  mesh.positions.insert(mesh.positions.end(), more.positions.begin(), more.positions.end());
  for (const std::uint32_t position : more.wedgePositions)
    mesh.wedgePositions.push_back(static_cast<std::uint32_t>(positions + position));
  for (const std::uint32_t corner : more.corners)
    mesh.corners.push_back(static_cast<std::uint32_t>(before + corner));
}

} // namespace

ShapeResource readShapeResource(ByteSpan bytes, const std::string& name, const std::string& mesh, bool withMaterials) {
  const Container container = containerOf(bytes, name);
  const Json json = parseJson(container.json, name);
  const Value root(json, name, ", ");
  ShapeResourceUpgrade upgrade(root, container.body);
  for (const std::string& key : meshesToRead(root, mesh))
    upgrade.addMesh(key);

  const References references(ImportOptions{}, name); // everything is in the container
  Document document(upgrade.json(), upgrade.buffer(), references, name, bytes.size());
  const AttributeChoice stored{.all = false, .names = {storedColor + 1, storedTexCoord + 1}};
  PrimitiveReader primitives(document, stored, true);
  ShapeResource resource;
  std::map<std::string, std::size_t> materials;
  std::map<std::pair<std::string, Topology>, std::size_t> shapes; ///< by material and kind of element
  const Value meshes = document.array("meshes");
  for (std::size_t i = 0; i < meshes.size(); ++i)
    for (std::size_t n = 0; n < meshes[i]["primitives"].size(); ++n) {
      const Value primitive = meshes[i]["primitives"][n];
      const Value location(primitive.json(), fmt::format("{}, mesh \"{}\"", name, meshes[i]["name"].text()));
      Mesh part;
      try {
        part = primitives.read(primitive, {}, 0);
      } catch (const Error& error) { // located in the JSON that the file does not have
        throw Error(error.kind(), location.location(), error.message());
      }
      readStored(part, withMaterials, location);
      const std::string material = withMaterials ? ShapeResourceUpgrade::materialOf(primitive) : "";
      const auto [shape, isNew] = shapes.try_emplace({material, part.topology}, resource.shapes.size());
      if (isNew) {
        resource.shapes.push_back({});
        resource.shapes.back().mesh.topology = part.topology;
        resource.shapes.back().mesh.name = meshes[i]["name"].text();
      }
      append(resource.shapes[shape->second].mesh, part, location);
      if (!isNew || material.empty() || !root["materials"].has(material.c_str()))
        continue;
      const auto [found, isNewMaterial] = materials.try_emplace(material, resource.materials.size());
      if (isNewMaterial)
        resource.materials.push_back(readResourceMaterial(root, upgrade, material));
      resource.shapes[shape->second].material = found->second;
    }
  return resource;
}

} // namespace imgeo::gltf
