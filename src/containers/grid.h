#pragma once
// Surfaces over the grid of an image: height maps, geometry images and sculpted prims (paper, figure 3). The vertices
// are the texels; the triangles follow from the size. web/src/decode/classic/classicGrid.ts computes the same.

#include "containers/geometry_description.h"
#include "containers/stored_coords.h"

#include <span>
#include <vector>

namespace imgeo {

/// Columns and rows of all patches of a height map together.
Vec2<std::uint32_t> heightMapSize(const GeometryDescription& geometry);

/// The lattice of a height map of `size` vertices whose heights have 16, 24 or 32 bits: its x and z are columns and
/// rows, its y are stored heights. `box` is the node's decode box.
Lattice heightMapLattice(const DecodeFields& box, Vec2<std::uint32_t> size, std::uint32_t bits);

/// The decode box of a height map; inverse of heightMapLattice.
DecodeFields heightMapBox(const Lattice& lattice, Vec2<std::uint32_t> size);

/// Vertex indices of the triangles of a grid, counterclockwise where columns run to the right and rows down. A
/// triangle with two corners at one point, as there are at the poles of sculpts, is left out.
std::vector<std::uint32_t> gridTriangles(GridKind kind, Vec2<std::uint32_t> size, std::span<const Vec3u> positions);

/// Normals of a grid of points by the slope between the neighbours of each, as the following function.
std::vector<Vec3f> slopeNormals(GridKind kind, Vec2<std::uint32_t> size, std::span<const Vec3d> points, bool ccw);

/// Normals of a grid by the slope between the neighbours of each vertex. At a pole, where all points of a row coincide,
/// they are those of the next row. `ccw`: whether triangles of gridTriangles() are seen from the front.
std::vector<Vec3f> slopeNormals(GridKind kind, Vec2<std::uint32_t> size, std::span<const Vec3u> positions,
                                const Lattice& lattice, bool ccw);

} // namespace imgeo
