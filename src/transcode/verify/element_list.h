#pragma once
// A mesh as the multiset of its elements on a lattice. In this form an input and a site's geometry can be compared:
// neither the order of elements nor patches nor strips matter.

#include "scene/mesh.h"
#include "transcode/verify/attribute_difference.h"

#include <array>
#include <cstdint>
#include <vector>

namespace imgeo {

/// Elements of a mesh. Attributes are per vertex; alpha is 1 if colours have three components.
struct ElementList : VertexAttributes {
  std::vector<Vec3u> positions;  ///< per vertex, on the lattice
  std::uint32_t cornerCount = 3; ///< corners of an element: 3 for triangles, 2 for lines, 1 for points
  std::vector<std::array<std::uint32_t, 3>> elements; ///< vertex indices; unused corners are 0
  std::vector<std::uint32_t> copies; ///< maximum number of times that the site may draw each element; empty: once

  std::size_t vertexCount() const { return positions.size(); }
};

/// Which elements are compared. Points: all wedges of the mesh; a wedge at the border of patches may be drawn by each
/// of them. Lines and triangles: those whose corners are different wedges.
struct ElementKind {
  Topology topology = Topology::triangles;
  /// The corners must be different lattice points as well: without an index, two vertices at one lattice point cannot
  /// be told apart.
  bool isUnindexed = false;
  /// All elements of a mesh: that their corners are different vertices has been seen before.
  bool keepsAll = false;
};

/// Order of lattice points by x, then y, then z.
constexpr bool precedes(const Vec3u& a, const Vec3u& b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// The elements of a prepared mesh; `positions` are its own, quantised.
ElementList elementsOf(const Mesh& mesh, const std::vector<Vec3u>& positions, ElementKind kind);

/// The vertices that a decoded patch draws as points.
std::vector<std::uint32_t> pointsOf(const IndexedPatch& patch);

/// The elements that decoded patches draw, joined.
ElementList elementsOf(const std::vector<IndexedPatch>& patches, ElementKind kind);

/// The differences of the elements of an input and of a site. Those of their attributes are between an element and its
/// best match.
struct ElementDifference : AttributeDifference {
  std::size_t missing = 0;         ///< elements of the input that the site lacks
  std::size_t extra = 0;           ///< elements of the site that the input lacks
  std::size_t colorsDiffering = 0; ///< elements without a match whose colours are within their bound
};

/// Matches elements whose corners lie on the same lattice points in the same cyclic order (lines in either direction),
/// and measures the differences of their attributes. If several elements coincide on the lattice, each is compared with
/// its best match in the other list, in both directions.
ElementDifference compare(ElementList input, ElementList site, const AttributeBounds& bounds);

} // namespace imgeo
