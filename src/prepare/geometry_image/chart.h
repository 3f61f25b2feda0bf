#pragma once
// Charts: connected pieces of a triangle mesh, each of which becomes one geometry image.

#include "prepare/half_edges.h"
#include "scene/mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace imgeo {

/// A connected piece of a triangle mesh: a manifold with a boundary. Where triangles of the mesh touch at a vertex
/// alone, the chart has several vertices of that position. Half-edges are those of `corners`.
struct Chart {
  std::vector<std::uint32_t> triangles; ///< of the mesh, ascending
  std::vector<std::uint32_t> corners;   ///< 3 for each triangle: vertices of the chart
  std::vector<std::uint32_t> positions; ///< vertex -> position of the mesh
  std::vector<std::uint32_t> opposites; ///< by half-edge; noHalfEdge: on the boundary

  std::size_t vertexCount() const { return positions.size(); }
  std::size_t triangleCount() const { return triangles.size(); }
};

/// The charts into which a mesh of triangles falls: pieces in which texture coordinates are continuous and which have
/// no creases. Across a crease stored normals differ by more than 30 degrees. An edge belongs to a seam if the values
/// differ at both of its ends: so the fan around the pole of a globe is one piece. Triangles with two corners at one
/// position are in no chart.
std::vector<Chart> chartsOf(const Mesh& mesh);

/// Divides a chart of at least two triangles into two connected pieces of about the same width: those nearer to one
/// and to the other of two triangles that are far apart on the surface.
std::array<Chart, 2> divide(const Mesh& mesh, const Chart& chart);

/// Whether a chart has the topology of a disk: one boundary, no handles.
bool isDisk(const Chart& chart);

/// The half-edges of the boundary of a disk, one after the other.
std::vector<std::uint32_t> boundaryOf(const Chart& disk);

} // namespace imgeo
