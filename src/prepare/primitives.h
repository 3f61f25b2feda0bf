#pragma once
// Conversion of patches to indexed primitives: triangles, triangle strips, lines, line strips or points over vertices
// in an order that compresses well. Pure functions for the writers of containers.

#include "prepare/patches.h"

#include <cstdint>
#include <vector>

namespace imgeo {

/// Writers of this project use all but loops and fans.
enum class Primitive : std::uint8_t { points, lines, lineStrip, lineLoop, triangles, triangleStrip, triangleFan };

/// The kind of element that a primitive draws.
Topology topologyOf(Primitive primitive);

/// Draws `count` indices, which follow those of the previous draw, as one kind of primitive.
struct Draw {
  Primitive primitive = Primitive::triangles;
  std::uint32_t count = 0;
  friend bool operator==(const Draw&, const Draw&) = default;
};

/// A patch as classic SIG and BG store it: each wedge is a vertex.
struct IndexedPatch : VertexAttributes {
  std::vector<Vec3u> positions;       ///< by vertex, on the lattice
  std::vector<std::uint32_t> indices; ///< empty: vertices are drawn in order
  std::vector<Draw> draws;            ///< counts sum to indices.size(), or to positions.size() if there are none
  bool ccw = true;                    ///< false: the front of a drawn triangle is clockwise

  std::size_t vertexCount() const { return positions.size(); }
};

/// Indexed triangles in fan order (prepare/fan_order.h: vertices are numbered when they are discovered, triangles are
/// grouped into the fans of their first vertex). Their images are a sixth smaller than those of strips, at no cost to
/// decode: docs/decisions/vertex-order.md. The triangles and their orientation are the patch's.
IndexedPatch asTriangles(const Patch& patch);

/// One triangle strip, then separate triangles that would lengthen it (docs/decisions/strips.md). Draws exactly the
/// patch's non-degenerate triangles in their orientation. Effort is 0 .. 9: scans get 1.16 to 1.34 indices per triangle
/// at effort 5, in a microsecond per triangle, and 1.13 to 1.3 at effort 9, in 15 microseconds.
IndexedPatch asStrips(const Patch& patch, int effort);

/// Indexed lines in the order of line strips (prepare/line_strips.h). A line keeps its wedges, but not always its
/// direction.
IndexedPatch asLines(const Patch& patch);

/// Line strips, one draw each, then the lines of strips that are too short to save more than a draw costs.
IndexedPatch asLineStrips(const Patch& patch);

/// Whether a comes before b in Morton order (Z-order), which keeps neighbours in space close together.
bool isBeforeInMortonOrder(Vec3u a, Vec3u b);

/// The wedges of a patch in the Morton order of their positions.
std::vector<std::uint32_t> mortonOrder(const Patch& patch);

/// Every wedge as a point, in Morton order, without indices; for point clouds and for meshes drawn as points.
IndexedPatch asPoints(const Patch& patch);

/// The patch with the same draws but without indices: vertices are repeated instead.
IndexedPatch withoutIndices(const IndexedPatch& patch);

/// Number of elements of a draw; in a triangle strip degenerate triangles are included.
ElementCounts elementsOf(const Draw& draw);

/// The triangles that the draws of a patch produce, as triples of vertex indices, counterclockwise seen from the front.
/// Degenerate triangles (two equal indices or, without indices, two equal positions) are left out.
std::vector<Vec3u> trianglesOf(const IndexedPatch& patch);

/// The lines that the draws of a patch produce, as pairs of vertex indices. Degenerate lines are left out.
std::vector<Vec2<std::uint32_t>> linesOf(const IndexedPatch& patch);

} // namespace imgeo
