#include "prepare/primitives.h"

#include "base/narrow.h"
#include "prepare/fan_order.h"
#include "prepare/strips.h"

#include <cassert>
#include <limits>
#include <numeric>

namespace imgeo {

namespace {

template <typename T>
std::vector<T> gather(const std::vector<T>& values, const std::vector<std::uint32_t>& from) {
  std::vector<T> result;
  if (values.empty())
    return result;
  result.reserve(from.size());
  for (const std::uint32_t i : from)
    result.push_back(values[i]);
  return result;
}

/// Splits wedges into vertices: vertex i is wedge order[i].
IndexedPatch verticesOf(const Patch& patch, const std::vector<std::uint32_t>& order) {
  IndexedPatch result;
  result.positions = gather(patch.positions, gather(patch.wedgePositions, order));
  result.normals = gather(patch.normals, order);
  result.texCoords = gather(patch.texCoords, order);
  result.colors = gather(patch.colors, order);
  result.colorComponents = patch.colorComponents;
  return result;
}

/// One draw over a sequence of wedges; vertices are numbered by first use.
IndexedPatch drawWedges(const Patch& patch, Primitive primitive, std::vector<std::uint32_t> wedges) {
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> vertexOf(patch.wedgeCount(), none), order;
  order.reserve(patch.wedgeCount());
  for (std::uint32_t& wedge : wedges) {
    if (vertexOf[wedge] == none) {
      vertexOf[wedge] = static_cast<std::uint32_t>(order.size());
      order.push_back(wedge);
    }
    wedge = vertexOf[wedge];
  }
  IndexedPatch result = verticesOf(patch, order);
  result.draws = {{primitive, narrow<std::uint32_t>(wedges.size())}};
  result.indices = std::move(wedges);
  return result;
}

/// The corners' wedges, triangles in fan order. The fans are those of positions,
/// not of wedges: an order that crosses creases and seams keeps neighbours in
/// space together (docs/decisions/vertex-order.md).
std::vector<std::uint32_t> inFanOrder(const Patch& patch) {
  std::vector<std::uint32_t> cornerPositions = patch.corners;
  for (std::uint32_t& corner : cornerPositions)
    corner = patch.wedgePositions[corner];
  std::vector<std::uint32_t> wedges = fanOrder(cornerPositions, patch.positions.size());
  for (std::uint32_t& corner : wedges)
    corner = patch.corners[corner];
  return wedges;
}

/// Chan, "Closest-point problems simplified on the RAM", 2002: the axis whose
/// coordinates differ in the highest bit decides the Morton order.
bool beforeInMortonOrder(Vec3u a, Vec3u b) {
  const auto lowerHighestBit = [](std::uint32_t x, std::uint32_t y) { return x < y && x < (x ^ y); };
  int deciding = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (lowerHighestBit(a[deciding] ^ b[deciding], a[axis] ^ b[axis]))
      deciding = axis;
  return a[deciding] < b[deciding];
}

} // namespace

IndexedPatch asTriangles(const Patch& patch) {
  assert(patch.topology == Topology::triangles);
  return drawWedges(patch, Primitive::triangles, inFanOrder(patch));
}

IndexedPatch asStrips(const Patch& patch) {
  assert(patch.topology == Topology::triangles);
  return drawWedges(patch, Primitive::triangleStrip, stitchedStrip(inFanOrder(patch), patch.wedgeCount()));
}

IndexedPatch asPoints(const Patch& patch) {
  std::vector<std::uint32_t> order(patch.wedgeCount());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return beforeInMortonOrder(patch.positions[patch.wedgePositions[a]],
                               patch.positions[patch.wedgePositions[b]]);
  });
  IndexedPatch result = verticesOf(patch, order);
  result.draws = {{Primitive::points, narrow<std::uint32_t>(order.size())}};
  return result;
}

IndexedPatch withoutIndices(const IndexedPatch& patch) {
  if (patch.indices.empty())
    return patch;
  IndexedPatch result;
  result.positions = gather(patch.positions, patch.indices);
  result.normals = gather(patch.normals, patch.indices);
  result.texCoords = gather(patch.texCoords, patch.indices);
  result.colors = gather(patch.colors, patch.indices);
  result.colorComponents = patch.colorComponents;
  result.draws = patch.draws;
  return result;
}

std::vector<Vec3u> trianglesOf(const IndexedPatch& patch) {
  std::vector<Vec3u> triangles;
  const auto index = [&](std::size_t i) {
    return patch.indices.empty() ? static_cast<std::uint32_t>(i) : patch.indices[i];
  };
  const auto differ = [&](std::uint32_t a, std::uint32_t b) {
    return patch.indices.empty() ? patch.positions[a] != patch.positions[b] : a != b;
  };
  const auto add = [&](Vec3u t) {
    if (differ(t.x, t.y) && differ(t.y, t.z) && differ(t.z, t.x))
      triangles.push_back(t);
  };
  std::size_t first = 0;
  for (const Draw& draw : patch.draws) {
    const std::size_t end = first + draw.count;
    if (draw.primitive == Primitive::triangles)
      for (std::size_t i = first; i + 3 <= end; i += 3)
        add({index(i), index(i + 1), index(i + 2)});
    if (draw.primitive == Primitive::triangleStrip)
      for (std::size_t i = first; i + 3 <= end; ++i) {
        const std::size_t odd = (i - first) % 2; // every second triangle of a strip is mirrored
        add({index(i + odd), index(i + 1 - odd), index(i + 2)});
      }
    first = end;
  }
  return triangles;
}

} // namespace imgeo
