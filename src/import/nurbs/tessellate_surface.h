#pragma once
// Turns NURBS surfaces into triangles.

#include "import/nurbs/curve.h"
#include "import/nurbs/trim.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace imgeo::nurbs {

/// One closed contour in the surface's parameters, as curves one after the other.
using Contour = std::vector<Curve>;

/// Indices into the lists of a SurfaceMesh.
struct MeshCorner {
  std::uint32_t position = 0, normal = 0, texCoord = 0;
};

struct SurfaceMesh {
  std::vector<Vec3f> positions, normals;
  std::vector<Vec2f> texCoords;
  std::vector<MeshCorner> corners; ///< three for each triangle, counter-clockwise where the normal points to the viewer
  double error = 0;                ///< the largest distance between surface and triangles that was measured
};

/// Triangles that differ from the surface by the tolerance for its control points (subdivide.h), with exact normals.
/// Closed edges share their positions. What lies within an odd number of the contours is kept; without contours all.
/// `texCoords` gives texture coordinates as x and y, its domain mapped to that of the surface; without it they run from
/// 0 to 1 along u and v. Throws Error{limit} for contours of more than maxContourCorners corners, Error{malformed} for
/// contours that are not finite.
SurfaceMesh tessellate(const Surface& surface, const std::vector<Contour>& contours,
                       const std::optional<Surface>& texCoords);

} // namespace imgeo::nurbs
