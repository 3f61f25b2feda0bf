#pragma once
// X3D's Box, Sphere, Cylinder and Cone (ISO/IEC 19775-1, 13.3) as polygons with normals and texture coordinates.
// web/src/tessellate/solids.ts gives the same; vectors/tessellation/solids.json tests both.

#include "import/x3d/faces.h"

namespace imgeo::x3d {

void addBox(const Vec3d& size, VertexData& data, Faces& faces);

void addSphere(double radius, VertexData& data, Faces& faces);

/// A cylinder, or a cone where `topRadius` is 0, along y, its centre at the origin.
struct RoundSolid {
  double topRadius = 1, bottomRadius = 1, height = 2;
  bool hasSide = true, hasTop = true, hasBottom = true;
};
void addRoundSolid(const RoundSolid& solid, VertexData& data, Faces& faces);

} // namespace imgeo::x3d
