#include "transcode/verify/element_list.h"

#include <algorithm>
#include <cassert>

namespace imgeo {

namespace {

VertexAttributes withOpaqueColors(VertexAttributes attributes) {
  if (attributes.colorComponents == 3)
    for (Rgba& color : attributes.colors)
      color.a = 1;
  return attributes;
}

/// Adds an element unless two of its corners are the same vertex or, without an index, the same lattice point.
void addElement(ElementList& list, std::array<std::uint32_t, 3> corners, ElementKind kind) {
  const auto differ = [&](std::size_t a, std::size_t b) {
    return kind.isUnindexed ? list.positions[corners[a]] != list.positions[corners[b]] : corners[a] != corners[b];
  };
  const bool hasDistinctCorners = kind.keepsAll || list.cornerCount == 1 || (list.cornerCount == 2 && differ(0, 1)) ||
                                  (list.cornerCount == 3 && differ(0, 1) && differ(1, 2) && differ(2, 0));
  if (hasDistinctCorners)
    list.elements.push_back(corners);
}

} // namespace

ElementList elementsOf(const Mesh& mesh, const std::vector<Vec3u>& positions, ElementKind kind) {
  ElementList list;
  list.cornerCount = cornersPerElement(kind.topology);
  static_cast<VertexAttributes&>(list) = withOpaqueColors(mesh);
  list.positions = gather(positions, mesh.wedgePositions);
  if (kind.topology == Topology::points) {
    for (std::uint32_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge)
      addElement(list, {wedge}, kind);
    list.copies.assign(mesh.wedgeCount(), 0);
    for (const std::uint32_t wedge : mesh.corners)
      ++list.copies[wedge];
    return list;
  }
  assert(mesh.topology == kind.topology);
  for (std::size_t first = 0; first < mesh.corners.size(); first += list.cornerCount) {
    std::array<std::uint32_t, 3> corners{};
    std::copy_n(&mesh.corners[first], list.cornerCount, corners.begin());
    addElement(list, corners, kind);
  }
  return list;
}

std::vector<std::uint32_t> pointsOf(const IndexedPatch& patch) {
  std::size_t drawn = 0;
  for (const Draw& draw : patch.draws)
    drawn += elementsOf(draw).points;
  std::vector<std::uint32_t> points(
      patch.indices.begin(), patch.indices.begin() + static_cast<std::ptrdiff_t>(patch.indices.empty() ? 0 : drawn));
  for (std::size_t i = points.size(); i < drawn; ++i)
    points.push_back(static_cast<std::uint32_t>(i));
  return points;
}

ElementList elementsOf(const std::vector<IndexedPatch>& patches, ElementKind kind) {
  ElementList list;
  list.cornerCount = cornersPerElement(kind.topology);
  for (const IndexedPatch& patch : patches) {
    const std::uint32_t base = static_cast<std::uint32_t>(list.positions.size());
    append(list, list.vertexCount(), withOpaqueColors(patch), patch.vertexCount());
    list.positions.insert(list.positions.end(), patch.positions.begin(), patch.positions.end());
    if (kind.topology == Topology::triangles)
      for (const Vec3u t : trianglesOf(patch))
        addElement(list, {base + t.x, base + t.y, base + t.z}, kind);
    if (kind.topology == Topology::lines)
      for (const Vec2<std::uint32_t> line : linesOf(patch))
        addElement(list, {base + line.x, base + line.y}, kind);
    if (kind.topology == Topology::points)
      for (const std::uint32_t point : pointsOf(patch))
        addElement(list, {base + point}, kind);
  }
  return list;
}

} // namespace imgeo
