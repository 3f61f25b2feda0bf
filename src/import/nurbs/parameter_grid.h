#pragma once
// Divides the parameters of a NURBS surface into cells whose triangles keep to a tolerance.

#include "import/nurbs/curve.h"
#include "import/nurbs/subdivide.h"

#include <vector>

namespace imgeo::nurbs {

/// The lines of a grid, in ascending order, from the beginning of the surface's domain to its end.
struct ParameterGrid {
  std::vector<double> us, vs;
  double error = 0; ///< the largest distance between the surface and the triangles of the grid that was measured
};

/// Whether the quadrilateral a, b, c, d is divided between a and c, not between b and d.
bool isRisingDiagonalShorter(Vec3d a, Vec3d b, Vec3d c, Vec3d d);

/// A grid of at most two million vertices; a surface that needs more has a larger error.
ParameterGrid parameterGridOf(const Surface& surface, const Tolerance& tolerance);

} // namespace imgeo::nurbs
