#pragma once
// From a patch to what a GPU draws: vertices in an order that makes images
// small, and primitives over them. Pure functions that a container's writer calls.

#include "prepare/patches.h"

#include <cstdint>
#include <vector>

namespace imgeo {

enum class Primitive : std::uint8_t { points, lines, lineStrip, triangles, triangleStrip };

/// What kind of element a primitive draws.
Topology topologyOf(Primitive primitive);

/// `count` indices drawn as one kind of primitive, following the previous draw's.
struct Draw {
  Primitive primitive = Primitive::triangles;
  std::uint32_t count = 0;
  friend bool operator==(const Draw&, const Draw&) = default;
};

/// A patch as classic SIG and BG store it: wedges split into vertices.
struct IndexedPatch : VertexAttributes {
  std::vector<Vec3u> positions;       ///< per vertex, on the lattice
  std::vector<std::uint32_t> indices; ///< empty: vertices are drawn in order
  std::vector<Draw> draws;            ///< counts sum to indices.size(), or positions.size() where it is empty

  std::size_t vertexCount() const { return positions.size(); }
};

/// Indexed triangles in fan order (breadth-first conquest: vertices are numbered
/// when discovered, triangles grouped into the fans of their first vertex).
/// Images of it are a sixth smaller than those of strips, at no cost to decode:
/// docs/decisions/vertex-order.md. The triangles and their orientation are the patch's.
IndexedPatch asTriangles(const Patch& patch);

/// One stitched triangle strip, then the lone triangles that it would only be longer for
/// (docs/decisions/strips.md). Draws exactly the patch's non-degenerate triangles with
/// their orientation. On scans 1.16 to 1.34 indices a triangle at effort 5, for a microsecond
/// each; 1.13 to 1.3 at effort 9, for fifteen. Effort is 0 .. 9.
IndexedPatch asStrips(const Patch& patch, int effort);

/// Indexed lines, one behind the other along trails (prepare/line_strips.h), each
/// between the wedges it has in the patch, in either direction.
IndexedPatch asLines(const Patch& patch);

/// The same as a strip for each long trail, then the lines that are left: a draw
/// of its own costs more than a short strip saves.
IndexedPatch asLineStrips(const Patch& patch);

/// Whether one place comes before another in Morton order, which keeps near ones together.
bool beforeInMortonOrder(Vec3u a, Vec3u b);

/// The wedges of a patch in the Morton order of their positions.
std::vector<std::uint32_t> mortonOrder(const Patch& patch);

/// Every wedge as a point, in Morton order, without indices; for point clouds
/// and for meshes shown as points.
IndexedPatch asPoints(const Patch& patch);

/// The same draws over vertices that repeat instead of being named by indices.
IndexedPatch withoutIndices(const IndexedPatch& patch);

/// How many elements a draw is of; those of a triangle strip with the degenerate
/// ones that join its parts.
ElementCounts elementsOf(const Draw& draw);

/// The triangles that the draws of a patch produce, as vertex index triples in
/// their drawn orientation; degenerate ones (two equal indices, or without
/// indices two vertices at one place) left out.
std::vector<Vec3u> trianglesOf(const IndexedPatch& patch);

/// The lines that the draws of a patch produce, as pairs of vertex indices;
/// degenerate ones left out likewise.
std::vector<Vec2<std::uint32_t>> linesOf(const IndexedPatch& patch);

} // namespace imgeo
