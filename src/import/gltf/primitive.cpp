#include "import/gltf/primitive.h"

#include "import/gltf/deformation.h"
#include "import/mesh/texcoord_mapping.h"
#include "import/mesh/unit_normal.h"
#include "import/text/text_scanner.h"
#include "scene/color.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <memory>

namespace imgeo::gltf {

namespace {

constexpr std::uint32_t unset = 0xffffffff;

// Primitive modes, as the specification names them.
enum Mode : std::uint64_t { points, lines, lineLoop, lineStrip, triangles, triangleStrip, triangleFan };

Topology topologyOf(std::uint64_t mode) {
  return mode == points ? Topology::points : mode <= lineStrip ? Topology::lines : Topology::triangles;
}

/// The corners of the separate elements that a run of vertices stands for (glTF 2.0, 3.7.2.1). Vertices that do not
/// complete an element are dropped.
std::vector<std::uint32_t> separated(std::uint64_t mode, const std::vector<std::uint32_t>& run) {
  std::vector<std::uint32_t> corners;
  const std::size_t count = run.size();
  switch (mode) {
  case points:
    return run;
  case lines:
    return {run.begin(), run.begin() + static_cast<std::ptrdiff_t>(count / 2 * 2)};
  case triangles:
    return {run.begin(), run.begin() + static_cast<std::ptrdiff_t>(count / 3 * 3)};
  case lineStrip:
  case lineLoop:
    for (std::size_t i = 0; i + 1 < count; ++i)
      corners.insert(corners.end(), {run[i], run[i + 1]});
    if (mode == lineLoop && count > 2)
      corners.insert(corners.end(), {run[count - 1], run[0]});
    return corners;
  case triangleStrip:
    for (std::size_t i = 0; i + 2 < count; ++i)
      corners.insert(corners.end(), {run[i], run[i + 1 + i % 2], run[i + 2 - i % 2]});
    return corners;
  default:
    for (std::size_t i = 0; i + 2 < count; ++i)
      corners.insert(corners.end(), {run[i + 1], run[i + 2], run[0]});
    return corners;
  }
}

} // namespace

const PrimitiveData::Attribute* PrimitiveData::find(const std::string& name) const {
  const auto found = std::ranges::find(attributes, name, &Attribute::name);
  return found == attributes.end() ? nullptr : &*found;
}

void PrimitiveReader::addAccessors(const Value& primitive, PrimitiveData& data) {
  const Value names = primitive["attributes"];
  if (!names.json().is_object())
    names.fail(ErrorKind::malformed, "is missing");
  std::optional<std::size_t> vertexCount;
  for (const auto& [name, unused] : names.json().items()) {
    const std::optional<std::size_t> index = names.index(name.c_str(), document_.array("accessors"));
    if (!index)
      names.fail(ErrorKind::malformed, fmt::format("has no accessor for '{}'", asPrintable(name)));
    const auto accessor = std::make_shared<Accessor>(document_.accessor(*index));
    if (vertexCount && *vertexCount != accessor->count())
      names[name.c_str()].fail(ErrorKind::malformed, fmt::format("has {} elements, another attribute has {}",
                                                                 accessor->count(), *vertexCount));
    vertexCount = accessor->count();
    data.attributes.push_back({name, accessor->components(),
                               [accessor](std::size_t vertex, std::uint32_t c) { return accessor->real(vertex, c); }});
  }
  data.vertexCount = vertexCount.value_or(0);
  const std::optional<std::size_t> indices = primitive.index("indices", document_.array("accessors"));
  if (!indices)
    return;
  const Accessor accessor = document_.accessor(*indices);
  if (accessor.components() != 1 || !accessor.isUnsigned())
    primitive["indices"].fail(ErrorKind::malformed, "are no whole numbers");
  document_.spend(primitive, accessor.count() * 4);
  data.indexed = true;
  data.indices.resize(accessor.count());
  for (std::size_t i = 0; i < accessor.count(); ++i) {
    data.indices[i] = accessor.whole(i, 0);
    if (data.indices[i] >= data.vertexCount)
      primitive["indices"].fail(ErrorKind::malformed,
                                fmt::format("name vertex {} of {}", data.indices[i], data.vertexCount));
  }
}

PrimitiveData PrimitiveReader::dataOf(const Value& primitive) {
  const Value draco = primitive["extensions"]["KHR_draco_mesh_compression"];
  if (!draco.isAbsent())
    return readDraco(document_, primitive, draco);
  PrimitiveData data;
  addAccessors(primitive, data);
  return data;
}

/// Renumbers the used vertices in the order of first use; returns them, and changes `corners` to the new numbers.
std::vector<std::uint32_t> PrimitiveReader::renumberVertices(std::vector<std::uint32_t>& corners,
                                                             std::size_t vertexCount) {
  if (localVertex_.size() < vertexCount)
    localVertex_.resize(vertexCount, unset);
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t& corner : corners) {
    std::uint32_t& local = localVertex_[corner];
    if (local == unset) {
      local = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back(corner);
    }
    corner = local;
  }
  for (const std::uint32_t vertex : vertices)
    localVertex_[vertex] = unset;
  return vertices;
}

Mesh PrimitiveReader::read(const Value& primitive, const std::set<std::size_t>& texCoordSets, std::size_t jointCount) {
  std::uint64_t mode = primitive["mode"].whole(triangles);
  if (mode > triangleFan)
    primitive["mode"].fail(ErrorKind::malformed, "is no mode that glTF has");
  const PrimitiveData data = dataOf(primitive);
  if (data.isTriangles)
    mode = triangles;
  std::vector<std::uint32_t> run = data.indices;
  const std::size_t drawn = data.indexed ? data.indices.size() : data.vertexCount;
  document_.spend(primitive, std::uint64_t{drawn} * 40); // its corners and their vertices
  if (!data.indexed)
    for (std::size_t i = 0; i < data.vertexCount; ++i)
      run.push_back(static_cast<std::uint32_t>(i));
  checkWhole(primitive, mode, run.size());
  Mesh mesh;
  mesh.topology = topologyOf(mode);
  mesh.corners = separated(mode, run);
  const std::vector<std::uint32_t> vertices = renumberVertices(mesh.corners, data.vertexCount);
  for (std::uint32_t i = 0; i < vertices.size(); ++i)
    mesh.wedgePositions.push_back(i);
  addVertices(primitive, data, vertices, mesh);
  mesh.creaseDegrees = 0; // without normals: glTF 2.0, 3.7.2.1
  addTexCoords(primitive, data, vertices, texCoordSets, mesh);
  addNamedAttributes(primitive, data, vertices, mesh);
  if (jointCount > 0)
    omissions.scaledWeights += addJoints(primitive, data, vertices, jointCount, mesh);
  addTargets(primitive, data, vertices, mesh);
  return mesh;
}

void PrimitiveReader::checkWhole(const Value& primitive, std::uint64_t mode, std::size_t drawn) {
  const std::size_t size = mode == triangles ? 3 : mode == lines ? 2 : 1;
  if (drawn % size == 0)
    return;
  if (isStrict_)
    primitive.fail(ErrorKind::malformed, fmt::format("draws {} vertices, which is no multiple of {}", drawn, size));
  omissions.surplusVertices += drawn % size;
}

/// Adds the morph targets; damaged ones are left out together, unless strict.
void PrimitiveReader::addTargets(const Value& primitive, const PrimitiveData& data,
                                 const std::vector<std::uint32_t>& vertices, Mesh& mesh) {
  const std::size_t before = mesh.namedAttributes.size();
  try {
    addDisplacements(document_, primitive, data.vertexCount, vertices, mesh);
  } catch (const Error& error) {
    if (isStrict_ || error.kind() == ErrorKind::limit)
      throw;
    mesh.namedAttributes.resize(before);
    omissions.damage.push_back(fmt::format("Left out its morph targets: {}.", error.what()));
  }
}

void PrimitiveReader::addVertices(const Value& primitive, const PrimitiveData& data,
                                  const std::vector<std::uint32_t>& vertices, Mesh& mesh) {
  const auto attribute = [&](const char* name, std::uint32_t minComponents, std::uint32_t maxComponents) {
    const PrimitiveData::Attribute* found = data.find(name);
    if (found && (found->components < minComponents || found->components > maxComponents))
      primitive["attributes"][name].fail(ErrorKind::malformed, "has the wrong number of components");
    return found;
  };
  const auto vec3 = [](const PrimitiveData::Attribute& from, std::uint32_t vertex) {
    return Vec3f(Vec3d{from.number(vertex, 0), from.number(vertex, 1), from.number(vertex, 2)});
  };
  const PrimitiveData::Attribute *positions = attribute("POSITION", 3, 3),
                                 *normals = attribute(attributeRow<VertexRole::normal>.gltfName, 3, 3),
                                 *colors = attribute(attributeRow<VertexRole::color>.gltfName, 3, 4);
  if (!positions)
    primitive["attributes"].fail(ErrorKind::malformed, "has no POSITION");
  for (const std::uint32_t vertex : vertices) {
    const Vec3f position = vec3(*positions, vertex);
    if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z))
      primitive["attributes"]["POSITION"].fail(ErrorKind::malformed,
                                               fmt::format("of vertex {} is not a number", vertex));
    mesh.positions.push_back(position);
    if (normals) {
      mesh.normals.push_back(vec3(*normals, vertex));
      omissions.unusableNormals += !makeUnit(mesh.normals.back());
    }
    if (colors) { // linear in glTF
      const auto channel = [&](std::uint32_t c) { return channelOf(srgbOfLinear(colors->number(vertex, c))); };
      const float alpha = colors->components == 4 ? channelOf(colors->number(vertex, 3)) : 1;
      mesh.colors.emplace_back(channel(0), channel(1), channel(2), alpha);
    }
  }
  const bool isOpaque = std::ranges::all_of(mesh.colors, [](const Rgba& color) { return color.a == 1; });
  mesh.colorComponents = isOpaque ? 3 : 4;
}

void PrimitiveReader::addTexCoords(const Value& primitive, const PrimitiveData& data,
                                   const std::vector<std::uint32_t>& vertices, const std::set<std::size_t>& sets,
                                   Mesh& mesh) {
  constexpr std::string_view prefix = "TEXCOORD_";
  std::map<std::size_t, const PrimitiveData::Attribute*> kept;
  for (const PrimitiveData::Attribute& attribute : data.attributes) {
    if (!attribute.name.starts_with(prefix))
      continue;
    const std::string_view digits = std::string_view(attribute.name).substr(prefix.size());
    std::size_t set = 0;
    if (std::from_chars(digits.data(), digits.data() + digits.size(), set).ec != std::errc{})
      continue;
    if (sets.contains(set) || (sets.empty() && set == 0) || choice_.has(attribute.name))
      kept[set] = &attribute;
    else if (set > 0)
      omissions.attributes.insert(attribute.name);
  }
  for (; kept.size() > maxTexCoordSets; kept.erase(std::prev(kept.end())))
    omissions.attributes.insert(kept.rbegin()->second->name);
  std::size_t keptCount = 0;
  for (const auto& [set, attribute] : kept) {
    const Value name = primitive["attributes"][attribute->name.c_str()];
    if (attribute->components != 2)
      name.fail(ErrorKind::malformed, "has the wrong number of components");
    std::vector<Vec2f>& texCoords = texCoordsOf(mesh, keptCount++);
    texCoords.reserve(vertices.size());
    for (const std::uint32_t vertex : vertices) {
      texCoords.push_back({static_cast<float>(attribute->number(vertex, 0)),
                           static_cast<float>(1 - attribute->number(vertex, 1))}); // glTF measures v down
      if (!std::isfinite(texCoords.back().x) || !std::isfinite(texCoords.back().y))
        name.fail(ErrorKind::malformed, fmt::format("of vertex {} is not a number", vertex));
    }
    mesh.texCoordMappings.push_back(mappingOf(set));
  }
  if (kept.size() == 1)
    mesh.texCoordMappings.clear(); // a single set serves all textures
}

/// Application-specific attributes are named "_NAME". Those of skins are read with the skin (deformation.h); the
/// remaining ones are sets of texture coordinates that no texture uses.
void PrimitiveReader::addNamedAttributes(const Value& primitive, const PrimitiveData& data,
                                         const std::vector<std::uint32_t>& vertices, Mesh& mesh) {
  for (const PrimitiveData::Attribute& attribute : data.attributes) {
    const std::string& name = attribute.name;
    bool isRead = name == "POSITION" || name.starts_with("TEXCOORD_");
    visitAttributeRows([&](const auto& row) { isRead = isRead || name == row.gltfName; });
    const bool isOfSkin = name == "JOINTS_0" || name == "WEIGHTS_0" || name == "JOINTS_1" || name == "WEIGHTS_1";
    if (isRead || isOfSkin)
      continue;
    const bool isFurther = name.starts_with("_") && attribute.components <= 4;
    const std::string furtherName = isFurther ? name.substr(1) : "";
    if (!furtherName.empty())
      furtherAttributes.insert(furtherName);
    if (!isFurther || furtherName.empty() || !choice_.has(furtherName) || isOfDeformation(furtherName)) {
      omissions.attributes.insert(name);
      continue;
    }
    NamedAttribute named{furtherName, attribute.components, {}};
    for (const std::uint32_t vertex : vertices)
      for (std::uint32_t c = 0; c < attribute.components; ++c) {
        named.values.push_back(static_cast<float>(attribute.number(vertex, c)));
        if (!std::isfinite(named.values.back()))
          primitive["attributes"][name.c_str()].fail(ErrorKind::malformed,
                                                     fmt::format("of vertex {} is not a number", vertex));
      }
    mesh.namedAttributes.push_back(std::move(named));
  }
}

} // namespace imgeo::gltf
