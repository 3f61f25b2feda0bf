#include "transcode/out_of_core/triangle_records.h"

#include <algorithm>

namespace imgeo {

RecordLayout RecordLayout::of(const VertexAttributes& attributes) {
  RecordLayout layout;
  layout.normals = !attributes.normals.empty();
  layout.colors = !attributes.colors.empty();
  layout.colorComponents = attributes.colorComponents;
  for (const NamedAttribute& attribute : attributes.namedAttributes)
    layout.named.push_back({attribute.name, attribute.components, {}});
  return layout;
}

bool RecordLayout::hasSameAttributes(const RecordLayout& other) const {
  return normals == other.normals && colors == other.colors && named == other.named;
}

std::size_t RecordLayout::cornerFloats() const {
  std::size_t count = (normals ? 3 : 0) + (colors ? 4 : 0);
  for (const NamedAttribute& attribute : named)
    count += attribute.components;
  return count;
}

void RecordLayout::append(std::vector<float>& records, std::uint32_t tag, const Mesh& mesh,
                          std::size_t triangle) const {
  records.push_back(std::bit_cast<float>(tag));
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3f& at = mesh.cornerPosition(3 * triangle + i);
    records.insert(records.end(), {at.x, at.y, at.z});
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t wedge = mesh.corners[3 * triangle + i];
    if (normals) {
      const Vec3f& normal = mesh.normals[wedge];
      records.insert(records.end(), {normal.x, normal.y, normal.z});
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
  const std::size_t size = recordFloats(), count = records.size() / size, perCorner = cornerFloats();
  mesh.positions.reserve(3 * count);
  mesh.corners.resize(3 * count);
  mesh.colorComponents = colorComponents;
  mesh.namedAttributes = named;
  for (NamedAttribute& attribute : mesh.namedAttributes)
    attribute.values.reserve(3 * count * attribute.components);
  if (normals)
    mesh.normals.reserve(3 * count);
  if (colors)
    mesh.colors.reserve(3 * count);
  for (std::size_t triangle = 0; triangle < count; ++triangle) {
    const float* record = records.data() + triangle * size;
    for (std::size_t i = 0; i < 3; ++i) {
      mesh.positions.push_back(positionOf(record, i));
      const float* at = record + 10 + i * perCorner;
      if (normals)
        mesh.normals.push_back({at[0], at[1], at[2]}), at += 3;
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
