#pragma once
// X3D's Extrusion (ISO/IEC 19775-1, 13.3.5): a cross-section carried along a spine.

#include "import/x3d/faces.h"

#include <array>
#include <vector>

namespace imgeo::x3d {

struct Extrusion {
  std::vector<Vec2<double>> crossSection{{1, 1}, {1, -1}, {-1, -1}, {-1, 1}, {1, 1}}; ///< x and z
  std::vector<Vec3d> spine{{0, 0, 0}, {0, 1, 0}};
  std::vector<Vec2<double>> scale{{1, 1}};                      ///< by point of the spine; the last is repeated
  std::vector<std::array<double, 4>> orientation{{0, 0, 1, 0}}; ///< likewise: axis and angle in radians
  bool beginCap = true, endCap = true;
};

/// Appends the vertices, with texture coordinates, and the faces of an extrusion. The ends of closed curves share their
/// positions; caps have vertices of their own. Appends nothing where the spine or the cross-section has fewer than two
/// points.
/// web/src/tessellate/extrusion.ts gives the same; vectors/tessellation/extrusion.json tests both.
void extrude(const Extrusion& extrusion, VertexData& data, Faces& faces);

} // namespace imgeo::x3d
