#include "prepare/primitives.h"

#include "base/narrow.h"
#include "prepare/fan_order.h"
#include "prepare/line_strips.h"
#include "prepare/triangle_strips.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

namespace imgeo {

namespace {

/// Makes vertices of wedges: vertex i is wedge order[i].
IndexedPatch verticesOf(const Patch& patch, const std::vector<std::uint32_t>& order) {
  IndexedPatch result;
  static_cast<VertexAttributes&>(result) = gather(patch, order);
  result.positions = gather(patch.positions, gather(patch.wedgePositions, order));
  return result;
}

/// Makes a patch that draws a sequence of wedges; vertices are numbered by first use.
IndexedPatch drawWedges(const Patch& patch, std::vector<Draw> draws, std::vector<std::uint32_t> wedges) {
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
  result.draws = std::move(draws);
  result.indices = std::move(wedges);
  return result;
}

/// The same with one draw.
IndexedPatch drawWedges(const Patch& patch, Primitive primitive, std::vector<std::uint32_t> wedges) {
  const auto count = narrow<std::uint32_t>(wedges.size());
  return drawWedges(patch, std::vector<Draw>{{primitive, count}}, std::move(wedges));
}

/// The wedges of all corners, with the triangles in fan order. Fans are formed around positions and not around wedges,
/// so that the order crosses creases and seams and keeps neighbours in space together
/// (docs/decisions/vertex-order.md).
std::vector<std::uint32_t> inFanOrder(const Patch& patch) {
  std::vector<std::uint32_t> cornerPositions = patch.corners;
  for (std::uint32_t& corner : cornerPositions)
    corner = patch.wedgePositions[corner];
  std::vector<std::uint32_t> wedges = fanOrder(cornerPositions, patch.positions.size());
  for (std::uint32_t& corner : wedges)
    corner = patch.corners[corner];
  return wedges;
}

/// Minimum number of lines of a strip. A draw takes some twenty bytes of the document and one draw call in each frame,
/// and saves less than an index a line.
constexpr std::size_t minStripLines = 64;

/// Draws line strips of at least `minLines` lines as strips, then the lines of all others separately.
IndexedPatch drawLineStrips(const Patch& patch, std::size_t minLines) {
  assert(patch.topology == Topology::lines);
  const std::vector<std::uint32_t>& corners = patch.corners;
  const LineStrips strips = findLineStrips(corners, patch.wedgeCount());
  std::vector<Draw> draws;
  std::vector<std::uint32_t> wedges, separate;
  for (std::size_t i = 0; i < strips.count(); ++i) {
    const std::span<const std::uint32_t> strip = strips.strip(i);
    const bool isStrip = strip.size() >= minLines;
    if (isStrip) {
      draws.push_back({Primitive::lineStrip, narrow<std::uint32_t>(strip.size() + 1)});
      wedges.push_back(corners[strip.front()]);
    }
    for (const std::uint32_t corner : strip)
      if (isStrip)
        wedges.push_back(corners[corner ^ 1]);
      else
        separate.insert(separate.end(), {corners[corner], corners[corner ^ 1]});
  }
  if (!separate.empty())
    draws.push_back({Primitive::lines, narrow<std::uint32_t>(separate.size())});
  wedges.insert(wedges.end(), separate.begin(), separate.end());
  return drawWedges(patch, std::move(draws), std::move(wedges));
}

/// Calls visit(primitive, begin, end) for each draw of a patch; begin and end are positions in the sequence of drawn
/// vertices.
template <typename Visit> void visitDraws(const IndexedPatch& patch, Visit visit) {
  std::size_t first = 0;
  for (const Draw& draw : patch.draws) {
    visit(draw.primitive, first, first + draw.count);
    first += draw.count;
  }
}

std::uint32_t vertexAt(const IndexedPatch& patch, std::size_t drawn) {
  return patch.indices.empty() ? static_cast<std::uint32_t>(drawn) : patch.indices[drawn];
}

/// Whether two drawn vertices have different indices or, without indices, different positions.
bool differ(const IndexedPatch& patch, std::uint32_t a, std::uint32_t b) {
  return patch.indices.empty() ? patch.positions[a] != patch.positions[b] : a != b;
}

} // namespace

Topology topologyOf(Primitive primitive) {
  switch (primitive) {
  case Primitive::points:
    return Topology::points;
  case Primitive::lines:
  case Primitive::lineStrip:
  case Primitive::lineLoop:
    return Topology::lines;
  case Primitive::triangles:
  case Primitive::triangleStrip:
  case Primitive::triangleFan:
    break;
  }
  return Topology::triangles;
}

IndexedPatch asTriangles(const Patch& patch) {
  assert(patch.topology == Topology::triangles);
  return drawWedges(patch, Primitive::triangles, inFanOrder(patch));
}

IndexedPatch asStrips(const Patch& patch, int effort) {
  assert(patch.topology == Topology::triangles);
  TriangleStrips strips = makeTriangleStrips(inFanOrder(patch), patch.wedgeCount(), effort);
  if (strips.strip.empty() && strips.triangles.empty())
    return asTriangles(patch); // all are degenerate: a patch must not be empty
  std::vector<Draw> draws;
  if (!strips.strip.empty())
    draws.push_back({Primitive::triangleStrip, narrow<std::uint32_t>(strips.strip.size())});
  if (!strips.triangles.empty())
    draws.push_back({Primitive::triangles, narrow<std::uint32_t>(strips.triangles.size())});
  strips.strip.insert(strips.strip.end(), strips.triangles.begin(), strips.triangles.end());
  return drawWedges(patch, std::move(draws), std::move(strips.strip));
}

IndexedPatch asLines(const Patch& patch) {
  return drawLineStrips(patch, std::numeric_limits<std::size_t>::max());
}

IndexedPatch asLineStrips(const Patch& patch) {
  return drawLineStrips(patch, minStripLines);
}

// Chan, "Closest-point problems simplified on the RAM", 2002: the axis whose coordinates differ in the highest bit
// decides the Morton order.
bool isBeforeInMortonOrder(Vec3u a, Vec3u b) {
  const auto lowerHighestBit = [](std::uint32_t x, std::uint32_t y) { return x < y && x < (x ^ y); };
  int decidingAxis = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (lowerHighestBit(a[decidingAxis] ^ b[decidingAxis], a[axis] ^ b[axis]))
      decidingAxis = axis;
  return a[decidingAxis] < b[decidingAxis];
}

std::vector<std::uint32_t> mortonOrder(const Patch& patch) {
  std::vector<std::uint32_t> order(patch.wedgeCount());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return isBeforeInMortonOrder(patch.positions[patch.wedgePositions[a]], patch.positions[patch.wedgePositions[b]]);
  });
  return order;
}

IndexedPatch asPoints(const Patch& patch) {
  const std::vector<std::uint32_t> order = mortonOrder(patch);
  IndexedPatch result = verticesOf(patch, order);
  result.draws = {{Primitive::points, narrow<std::uint32_t>(order.size())}};
  return result;
}

IndexedPatch withoutIndices(const IndexedPatch& patch) {
  if (patch.indices.empty())
    return patch;
  IndexedPatch result;
  static_cast<VertexAttributes&>(result) = gather(patch, patch.indices);
  result.positions = gather(patch.positions, patch.indices);
  result.draws = patch.draws;
  return result;
}

ElementCounts elementsOf(const Draw& draw) {
  const auto indicesAfter = [&](std::uint32_t first) { return std::max(draw.count, first) - first; };
  switch (draw.primitive) {
  case Primitive::points:
    return {.points = draw.count};
  case Primitive::lines:
    return {.lines = draw.count / 2};
  case Primitive::lineStrip:
    return {.lines = indicesAfter(1)};
  case Primitive::lineLoop:
    return {.lines = draw.count < 2 ? 0 : draw.count};
  case Primitive::triangles:
    return {.triangles = draw.count / 3};
  case Primitive::triangleStrip:
  case Primitive::triangleFan:
    return {.triangles = indicesAfter(2)};
  }
  return {};
}

std::vector<Vec3u> trianglesOf(const IndexedPatch& patch) {
  std::vector<Vec3u> triangles;
  const auto add = [&](std::size_t i, std::size_t j, std::size_t k) {
    const Vec3u t{vertexAt(patch, i), vertexAt(patch, patch.ccw ? j : k), vertexAt(patch, patch.ccw ? k : j)};
    if (differ(patch, t.x, t.y) && differ(patch, t.y, t.z) && differ(patch, t.z, t.x))
      triangles.push_back(t);
  };
  visitDraws(patch, [&](Primitive primitive, std::size_t first, std::size_t end) {
    if (primitive == Primitive::triangles)
      for (std::size_t i = first; i + 3 <= end; i += 3)
        add(i, i + 1, i + 2);
    if (primitive == Primitive::triangleStrip)
      for (std::size_t i = first; i + 3 <= end; ++i) {
        const std::size_t odd = (i - first) % 2; // every second triangle of a strip is reversed
        add(i + odd, i + 1 - odd, i + 2);
      }
    if (primitive == Primitive::triangleFan)
      for (std::size_t i = first; i + 3 <= end; ++i)
        add(first, i + 1, i + 2);
  });
  return triangles;
}

std::vector<Vec2<std::uint32_t>> linesOf(const IndexedPatch& patch) {
  std::vector<Vec2<std::uint32_t>> lines;
  const auto add = [&](std::size_t i, std::size_t j) {
    const Vec2<std::uint32_t> line{vertexAt(patch, i), vertexAt(patch, j)};
    if (differ(patch, line.x, line.y))
      lines.push_back(line);
  };
  visitDraws(patch, [&](Primitive primitive, std::size_t first, std::size_t end) {
    if (topologyOf(primitive) != Topology::lines)
      return;
    for (std::size_t i = first; i + 2 <= end; i += primitive == Primitive::lines ? 2 : 1)
      add(i, i + 1);
    if (primitive == Primitive::lineLoop && end - first >= 2)
      add(end - 1, first);
  });
  return lines;
}

} // namespace imgeo
