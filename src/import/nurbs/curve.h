#pragma once
// Rational B-spline curves and surfaces, and their exact evaluation.

#include "base/vec.h"
#include "import/nurbs/basis.h"

#include <vector>

namespace imgeo::nurbs {

struct ControlPoint {
  Vec3d point;
  double weight = 1; ///< greater than 0
};

/// Curves of two dimensions have z = 0.
struct Curve {
  Basis basis;
  std::vector<ControlPoint> points; ///< basis.controlPoints() of them
};

struct Surface {
  Basis u, v;
  std::vector<ControlPoint> points; ///< u.controlPoints() * v.controlPoints(), u first
};

struct CurvePoint {
  Vec3d point, tangent; ///< the tangent is the first derivative
};

struct SurfacePoint {
  Vec3d point, alongU, alongV; ///< the first derivatives

  /// Points to where u runs to the right and v upwards; not of unit length.
  Vec3d normal() const { return cross(alongU, alongV); }
};

CurvePoint evaluate(const Curve& curve, std::size_t span, double t);
SurfacePoint evaluate(const Surface& surface, std::size_t uSpan, std::size_t vSpan, double u, double v);

/// A curve through the points, straight between them; there must be at least two. Parameter i is point i.
Curve polyline(const std::vector<Vec3d>& points);

/// X3D's field `closed`: a curve whose last control point repeats the first, but which does not end where it begins,
/// is continued periodically, so that it closes smoothly. Any other curve is returned as it is.
Curve closed(Curve curve);
/// The same for a surface in the direction of u (uClosed) and of v (vClosed).
Surface closedAlongU(const Surface& surface);
Surface closedAlongV(Surface surface);

} // namespace imgeo::nurbs
