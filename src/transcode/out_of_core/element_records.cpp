#include "transcode/out_of_core/element_records.h"

#include <algorithm>

namespace imgeo {

RecordLayout RecordLayout::of(const Mesh& mesh) {
  RecordLayout layout;
  layout.topology = mesh.topology;
  layout.normals = !mesh.normals.empty();
  layout.texCoordSets = static_cast<std::uint32_t>(texCoordSetCount(mesh));
  layout.texCoordMappings = mesh.texCoordMappings;
  layout.colors = !mesh.colors.empty();
  layout.colorComponents = mesh.colorComponents;
  for (const NamedAttribute& attribute : mesh.namedAttributes)
    layout.named.push_back({attribute.name, attribute.components, {}});
  return layout;
}

bool RecordLayout::hasSameAttributes(const RecordLayout& other) const {
  return normals == other.normals && texCoordSets == other.texCoordSets && colors == other.colors &&
         named == other.named;
}

std::size_t RecordLayout::cornerFloats() const {
  std::size_t count = (normals ? 3 : 0) + 2 * std::size_t{texCoordSets} + (colors ? 4 : 0);
  for (const NamedAttribute& attribute : named)
    count += attribute.components;
  return count;
}

void RecordLayout::append(std::vector<float>& records, std::uint32_t tag, const Mesh& mesh, std::size_t element) const {
  const std::size_t cornerCount = corners();
  records.push_back(std::bit_cast<float>(tag));
  for (std::size_t i = 0; i < cornerCount; ++i) {
    const Vec3f& at = mesh.cornerPosition(cornerCount * element + i);
    records.insert(records.end(), {at.x, at.y, at.z});
  }
  for (std::size_t i = 0; i < cornerCount; ++i) {
    const std::uint32_t wedge = mesh.corners[cornerCount * element + i];
    if (normals) {
      const Vec3f& normal = mesh.normals[wedge];
      records.insert(records.end(), {normal.x, normal.y, normal.z});
    }
    for (std::size_t set = 0; set < texCoordSets; ++set) {
      const Vec2f& texCoord = texCoordsOf(mesh, set)[wedge];
      records.insert(records.end(), {texCoord.x, texCoord.y});
    }
    if (colors) {
      const Rgba& color = mesh.colors[wedge];
      records.insert(records.end(), {color.r, color.g, color.b, color.a});
    }
    for (const NamedAttribute& attribute : mesh.namedAttributes) {
      const auto first =
          attribute.values.begin() + static_cast<std::ptrdiff_t>(std::size_t{wedge} * attribute.components);
      records.insert(records.end(), first, first + attribute.components);
    }
  }
}

Mesh RecordLayout::meshOf(std::span<const float> records) const {
  Mesh mesh;
  mesh.topology = topology;
  const std::size_t size = recordFloats(), cornerCount = corners() * (records.size() / size),
                    perCorner = cornerFloats();
  mesh.positions.reserve(cornerCount);
  mesh.corners.resize(cornerCount);
  mesh.texCoordMappings = texCoordMappings;
  mesh.colorComponents = colorComponents;
  mesh.namedAttributes = named;
  for (NamedAttribute& attribute : mesh.namedAttributes)
    attribute.values.reserve(cornerCount * attribute.components);
  if (normals)
    mesh.normals.reserve(cornerCount);
  for (std::size_t set = 0; set < texCoordSets; ++set)
    texCoordsOf(mesh, set).reserve(cornerCount);
  if (colors)
    mesh.colors.reserve(cornerCount);
  for (std::size_t begin = 0; begin + size <= records.size(); begin += size) {
    const float* record = records.data() + begin;
    for (std::size_t i = 0; i < corners(); ++i) {
      mesh.positions.push_back(positionOf(record, i));
      const float* at = record + attributesOffset() + i * perCorner;
      if (normals)
        mesh.normals.push_back({at[0], at[1], at[2]}), at += 3;
      for (std::size_t set = 0; set < texCoordSets; ++set, at += 2)
        texCoordsOf(mesh, set).push_back({at[0], at[1]});
      if (colors)
        mesh.colors.push_back({at[0], at[1], at[2], at[3]}), at += 4;
      for (NamedAttribute& attribute : mesh.namedAttributes)
        attribute.values.insert(attribute.values.end(), at, at + attribute.components), at += attribute.components;
    }
  }
  for (std::uint32_t corner = 0; corner < mesh.corners.size(); ++corner)
    mesh.corners[corner] = corner;
  mesh.wedgePositions = mesh.corners;
  return mesh;
}

} // namespace imgeo
