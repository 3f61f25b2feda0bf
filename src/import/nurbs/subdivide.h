#pragma once
// Divides the parameters of curves and surfaces until straight pieces approximate them.

#include "import/nurbs/curve.h"

#include <functional>
#include <vector>

namespace imgeo::nurbs {

/// What tessellations keep to, unless a limit of their size stops them.
struct Tolerance {
  double distance = 0;     ///< between a curve and its chords, in units of the geometry
  double angle = 0.261799; ///< between the tangents at the ends of a piece, in radians: 15 degrees
};

/// The tolerance for geometry with these control points: 1/2000 of the diagonal of their box.
inline constexpr double relativeTolerance = 1.0 / 2000;
Tolerance toleranceFor(const std::vector<ControlPoint>& points);

/// No piece is divided where there are more parameters along a curve, or along a direction of a surface, than these, or
/// four for each interval of knots.
inline constexpr std::size_t maxParameters = 512;

/// Whether the piece between two parameters must be divided.
using NeedsDivision = std::function<bool(double begin, double end)>;

/// Adds parameters between those of `breaks`, by bisection, until no piece needs division.
std::vector<double> subdivided(const std::vector<double>& breaks, const NeedsDivision& needsDivision);

/// Whether the piece of a curve between two parameters is farther from its chord than the tolerance, or turns more.
/// Measured at the quarters of the piece.
bool isBent(const std::function<CurvePoint(double)>& at, double begin, double end, const Tolerance& tolerance);

double distanceToSegment(Vec3d point, Vec3d begin, Vec3d end);
double distanceToTriangle(Vec3d point, Vec3d a, Vec3d b, Vec3d c);

/// Points along the curve, and the largest distance between curve and chords that was measured.
struct Polyline {
  std::vector<Vec3d> points;
  std::vector<double> parameters;
  double error = 0;
};
Polyline tessellate(const Curve& curve, const Tolerance& tolerance);

} // namespace imgeo::nurbs
