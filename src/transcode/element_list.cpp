#include "transcode/element_list.h"

#include <algorithm>

namespace imgeo {

namespace {

Rgba8 opaque(Rgba8 color, std::uint32_t components) {
  if (components == 3)
    color.a = 255;
  return color;
}

void addPoint(ElementList& list, std::uint32_t vertex) {
  list.elements.push_back({vertex, vertex, vertex});
}

} // namespace

ElementList elementsOf(const Mesh& mesh, const std::vector<Vec3u>& positions, ElementKind kind) {
  ElementList list;
  const bool asPoints = kind == ElementKind::points;
  list.cornerCount = asPoints ? 1 : 3;
  list.normals = mesh.normals;
  list.texCoords = mesh.texCoords;
  for (const std::uint32_t position : mesh.wedgePositions)
    list.positions.push_back(positions[position]);
  for (const Rgba8 color : mesh.colors)
    list.colors.push_back(opaque(color, mesh.colorComponents));
  if (asPoints) {
    for (std::uint32_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge)
      addPoint(list, wedge);
    list.copies.assign(mesh.wedgeCount(), 0);
    for (const std::uint32_t wedge : mesh.corners)
      ++list.copies[wedge];
    return list;
  }
  for (std::size_t corner = 0; corner + 2 < mesh.corners.size(); corner += 3) {
    const std::uint32_t a = mesh.corners[corner], b = mesh.corners[corner + 1], c = mesh.corners[corner + 2];
    const auto differ = [&](std::uint32_t first, std::uint32_t second) {
      return kind == ElementKind::triangles ? first != second
                                            : list.positions[first] != list.positions[second];
    };
    if (differ(a, b) && differ(b, c) && differ(c, a))
      list.elements.push_back({a, b, c});
  }
  return list;
}

ElementList elementsOf(const std::vector<IndexedPatch>& patches, ElementKind kind) {
  ElementList list;
  const bool asPoints = kind == ElementKind::points;
  list.cornerCount = asPoints ? 1 : 3;
  for (const IndexedPatch& patch : patches) {
    const std::uint32_t base = static_cast<std::uint32_t>(list.positions.size());
    list.positions.insert(list.positions.end(), patch.positions.begin(), patch.positions.end());
    list.normals.insert(list.normals.end(), patch.normals.begin(), patch.normals.end());
    list.texCoords.insert(list.texCoords.end(), patch.texCoords.begin(), patch.texCoords.end());
    for (const Rgba8 color : patch.colors)
      list.colors.push_back(opaque(color, patch.colorComponents));
    if (!asPoints) {
      for (const Vec3u t : trianglesOf(patch))
        list.elements.push_back({base + t.x, base + t.y, base + t.z});
      continue;
    }
    std::size_t drawn = 0;
    for (const Draw& draw : patch.draws)
      drawn += draw.primitive == Primitive::points ? draw.count : 0;
    for (std::size_t i = 0; i < drawn; ++i)
      addPoint(list, base + (patch.indices.empty() ? static_cast<std::uint32_t>(i) : patch.indices[i]));
  }
  return list;
}

} // namespace imgeo
