#pragma once
// A mesh as the multiset of its elements on a lattice: the form in which an
// input and what a site holds of it can be compared, whatever order, patches or
// strips they came in.

#include "containers/geometry_description.h"
#include "scene/mesh.h"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace imgeo {

/// The attributes are those of its vertices; alpha is 255 where it does not count.
struct ElementList : VertexAttributes {
  std::vector<Vec3u> positions;                       ///< per vertex, on the lattice
  std::uint32_t cornerCount = 3;                      ///< of an element: 3 triangles, 2 lines, 1 points
  std::vector<std::array<std::uint32_t, 3>> elements; ///< vertices; the corners behind cornerCount are 0
  std::vector<std::uint32_t> copies;                  ///< how often an element may be drawn; empty: once

  std::size_t vertexCount() const { return positions.size(); }
};

/// What sites hold of a mesh: points are its wedges, of which patches may each draw
/// their copy of a border wedge; lines and triangles those of different wedges.
struct ElementKind {
  Topology topology = Topology::triangles;
  /// Those of different lattice points: without an index two vertices at one place
  /// cannot be told from one.
  bool byPlace = false;
};

/// An order of lattice points: by x, then by y, then by z.
constexpr bool precedes(const Vec3u& a, const Vec3u& b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// The elements of a prepared mesh; `positions` are its own, quantised.
ElementList elementsOf(const Mesh& mesh, const std::vector<Vec3u>& positions, ElementKind kind);

/// The elements that decoded patches draw, joined.
ElementList elementsOf(const std::vector<IndexedPatch>& patches, ElementKind kind);

/// What two lists may differ by, where they are the same elements.
struct AttributeBounds {
  double normalDegrees = 0;
  Vec2<double> texCoord;
  std::map<std::string, std::vector<double>> named; ///< by further attribute and component
};

struct ElementDifference {
  std::size_t missing = 0;         ///< elements of the input that the site lacks
  std::size_t extra = 0;           ///< elements of the site that the input lacks
  double normalDegrees = 0;        ///< largest between an element's corners and the best element at its place
  Vec2<double> texCoord;           ///< likewise, an axis
  double named = 0;                ///< largest of a further attribute's number, in parts of its bound
  std::size_t colorsDiffering = 0; ///< elements for which no element at the place has the same colours
};

/// Pairs the elements whose corners lie on the same lattice points in the same
/// cyclic order (so lines in either direction), and measures how far the attributes of pairs are apart. Where
/// several elements coincide on the lattice, each is measured against the one of
/// the other list that fits best, in both directions.
ElementDifference compare(const ElementList& input, const ElementList& site, const AttributeBounds& bounds);

} // namespace imgeo
