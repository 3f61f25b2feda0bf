#include "containers/geometry_description.h"

#include "containers/encodings.h"
#include "containers/normals.h"

#include <algorithm>

namespace imgeo {

const char* nameOf(Role role) {
  switch (role) {
  case Role::index:
    return "index";
  case Role::coord:
    return "coord";
  case Role::attribute:
    return "attribute";
  case Role::patch:
    return "patch";
  case Role::base:
    return "base";
  case Role::levels:
    return "levels";
  case Role::chips:
    return "chips";
  case Role::normal:
  case Role::texCoord:
  case Role::texCoord1:
  case Role::texCoord2:
  case Role::texCoord3:
  case Role::color:
    break;
  }
  return nameOf(*vertexRoleOf(role));
}

std::optional<VertexRole> vertexRoleOf(Role role) {
  const auto* found = std::ranges::find(vertexRoles, role, fileRoleOf);
  return found == vertexRoles.end() ? std::nullopt : std::optional(*found);
}

const char* nameOf(Primitive primitive) {
  constexpr const char* names[] = {"POINTS",    "LINES",         "LINESTRIP",  "LINELOOP",
                                   "TRIANGLES", "TRIANGLESTRIP", "TRIANGLEFAN"};
  return names[static_cast<std::size_t>(primitive)];
}

const char* nameOf(GridKind kind) {
  constexpr const char* names[] = {"heightMap", "geometryImage", "sculpt"};
  return names[static_cast<std::size_t>(kind)];
}

std::uint64_t gridTriangleCount(GridKind kind, Vec2<std::uint32_t> size) {
  const std::uint64_t columns = kind == GridKind::sculpt ? size.x : size.x - 1;
  return 2 * columns * (size.y - 1);
}

const char* nameOf(NormalEncoding encoding) {
  constexpr const char* names[] = {"rgb", "octahedral", "spherical", "palette", "derived"};
  return names[static_cast<std::size_t>(encoding)];
}

const char* nameOf(ElementType type) {
  constexpr const char* names[] = {"Int8", "Uint8", "Int16", "Uint16", "Int32", "Uint32", "Float32"};
  return names[static_cast<std::size_t>(type)];
}

std::uint32_t byteSizeOf(ElementType type) {
  constexpr std::uint32_t sizes[] = {1, 1, 2, 2, 4, 4, 4};
  return sizes[static_cast<std::size_t>(type)];
}

std::size_t imageCountOf(VertexRole role, NormalEncoding normals, std::uint32_t bits) {
  const bool isWhole = bits == 8 || bits == 16 || bits == 24;
  if (role != VertexRole::normal)
    return !isWhole ? 0 : isTexCoord(role) ? (bits + 15) / 16 : bits / 8;
  if (!isWhole || bits == 24 || (bits == 16 && normals == NormalEncoding::palette))
    return 0;
  return isPair(normals) ? 1 : bits / 8;
}

std::uint32_t bitsOfImages(VertexRole role, NormalEncoding normals, std::size_t imageCount) {
  if (role == VertexRole::normal && isPair(normals))
    return defaultImageBits[role];
  return defaultImageBits[role] + 8 * static_cast<std::uint32_t>(imageCount - 1);
}

ByteLocation normalInCoords(const ByteLocation& coord) {
  return {coord.byteOffset + 6, coord.byteStride != 0 ? coord.byteStride : 8};
}

Reference normalInCoords(const Reference& coord) {
  return {coord.url, normalInCoords(std::get<ByteLocation>(coord.location)), coord.furtherUrls};
}

bool hasNormalsInCoords(const GeometryDescription& geometry) {
  return hasElementTypes(geometry.encoding) && geometry.normalEncoding == NormalEncoding::spherical &&
         geometry.attributeTypes[VertexRole::normal] == ElementType::uint8 && byteSizeOf(geometry.coordType) == 2 &&
         std::ranges::all_of(geometry.patches, [](const PatchDescription& patch) {
           return patch.coord.size() == 1 &&
                  patch.vertexAttributes[VertexRole::normal] == normalInCoords(patch.coord[0]);
         });
}

namespace {

/// The kinds of elements that a geometry draws, in the order of their first draws.
std::vector<Topology> topologiesOf(const GeometryDescription& geometry) {
  std::vector<Topology> topologies;
  for (const PatchDescription& patch : geometry.patches)
    for (const Draw& draw : patch.draws)
      if (const Topology topology = topologyOf(draw.primitive);
          std::ranges::find(topologies, topology) == topologies.end())
        topologies.push_back(topology);
  return topologies;
}

/// The box around those of the patches; empty if one of them does not state its box.
Box3d boxOfPatches(const GeometryDescription& geometry) {
  Box3d box;
  for (const PatchDescription& patch : geometry.patches) {
    if (patch.box.empty())
      return {};
    box.add(patch.box.min);
    box.add(patch.box.max);
  }
  return box;
}

} // namespace

bool drawsSeveralTopologies(const GeometryDescription& geometry) {
  return !geometry.topology && topologiesOf(geometry).size() > 1;
}

std::vector<GeometryDescription> splitByTopology(const GeometryDescription& geometry) {
  if (!drawsSeveralTopologies(geometry))
    return {geometry};
  std::vector<GeometryDescription> geometries;
  for (const Topology topology : topologiesOf(geometry)) {
    GeometryDescription& part = geometries.emplace_back(geometry);
    part.topology = topology;
    const std::size_t left = std::erase_if(part.patches, [&](const PatchDescription& patch) {
      return std::ranges::none_of(patch.draws,
                                  [&](const Draw& draw) { return topologyOf(draw.primitive) == topology; });
    });
    if (left > 0)
      part.box = boxOfPatches(part);
  }
  return geometries;
}

bool isUnsigned(ElementType type) {
  return type == ElementType::uint8 || type == ElementType::uint16 || type == ElementType::uint32;
}

double maximumOf(ElementType type) {
  constexpr double maxima[] = {127, 255, 32767, 65535, 2147483647, 4294967295, 1};
  return maxima[static_cast<std::size_t>(type)];
}

} // namespace imgeo
