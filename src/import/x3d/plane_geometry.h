#pragma once
// X3D's round and rectangular geometry in the plane z = 0 (ISO/IEC 19775-1, clause 14), whose front is towards +z.
// web/src/tessellate/geometry2d.ts gives the same; vectors/tessellation/solids.json tests both.

#include "import/x3d/faces.h"

namespace imgeo::x3d {

/// From `start` to `end`, counter-clockwise, in radians; equal angles, and those a full turn apart, are a circle.
struct Arc {
  double radius = 1, start = 0, end = 0;
};

/// A polyline: its corners are one run.
void addArc(const Arc& arc, VertexData& data, Faces& faces);

/// An arc that is closed by a straight line (`isChord`), or by two lines to the centre.
void addClosedArc(const Arc& arc, bool isChord, VertexData& data, Faces& faces);

/// A disk, or a ring. Two equal radii make a circle, a polyline: then it returns false.
bool addDisk(double innerRadius, double outerRadius, VertexData& data, Faces& faces);

void addRectangle(Vec2<double> size, VertexData& data, Faces& faces);

} // namespace imgeo::x3d
