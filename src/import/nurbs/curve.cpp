#include "import/nurbs/curve.h"

#include <algorithm>
#include <cmath>

namespace imgeo::nurbs {

namespace {

/// A point and its derivatives before the division by the weight.
struct Homogeneous {
  Vec3d point;
  double weight = 0;

  void add(const ControlPoint& control, double factor) {
    point += control.point * (control.weight * factor);
    weight += control.weight * factor;
  }
};

/// The derivative of point / weight.
Vec3d quotientDerivative(const Homogeneous& derivative, Vec3d quotient, double weight) {
  return (derivative.point - quotient * derivative.weight) * (1 / weight);
}

bool isSame(const ControlPoint& a, const ControlPoint& b) {
  return a.point == b.point && a.weight == b.weight;
}

/// Whether curves of this basis begin and end in their first and last control points.
bool isClamped(const Basis& basis) {
  return basis.knots.front() == basis.begin() && basis.knots.back() == basis.end();
}

/// Appends knots for `degree - 1` more control points, at the distances of the first ones.
void continueKnots(Basis& basis) {
  for (std::size_t i = 1; i < basis.degree(); ++i)
    basis.knots.push_back(basis.knots.back() + basis.knots[i] - basis.knots[i - 1]);
}

Surface transposed(const Surface& surface) {
  Surface result{surface.v, surface.u, {}};
  const std::size_t columns = surface.u.controlPoints(), rows = surface.v.controlPoints();
  for (std::size_t column = 0; column < columns; ++column)
    for (std::size_t row = 0; row < rows; ++row)
      result.points.push_back(surface.points[row * columns + column]);
  return result;
}

} // namespace

CurvePoint evaluate(const Curve& curve, std::size_t span, double t) {
  const BasisValues basis = evaluate(curve.basis, span, t);
  Homogeneous point, derivative;
  for (std::size_t i = 0; i < curve.basis.order; ++i) {
    const ControlPoint& control = curve.points[span - curve.basis.degree() + i];
    point.add(control, basis.value[i]);
    derivative.add(control, basis.derivative[i]);
  }
  const Vec3d quotient = point.point * (1 / point.weight);
  return {quotient, quotientDerivative(derivative, quotient, point.weight)};
}

SurfacePoint evaluate(const Surface& surface, std::size_t uSpan, std::size_t vSpan, double u, double v) {
  const BasisValues alongU = evaluate(surface.u, uSpan, u), alongV = evaluate(surface.v, vSpan, v);
  const std::size_t columns = surface.u.controlPoints();
  Homogeneous point, uDerivative, vDerivative;
  for (std::size_t j = 0; j < surface.v.order; ++j)
    for (std::size_t i = 0; i < surface.u.order; ++i) {
      const ControlPoint& control =
          surface.points[(vSpan - surface.v.degree() + j) * columns + uSpan - surface.u.degree() + i];
      point.add(control, alongU.value[i] * alongV.value[j]);
      uDerivative.add(control, alongU.derivative[i] * alongV.value[j]);
      vDerivative.add(control, alongU.value[i] * alongV.derivative[j]);
    }
  const Vec3d quotient = point.point * (1 / point.weight);
  return {quotient, quotientDerivative(uDerivative, quotient, point.weight),
          quotientDerivative(vDerivative, quotient, point.weight)};
}

Curve polyline(const std::vector<Vec3d>& points) {
  Curve curve{{2, {0}}, {}};
  for (const Vec3d& point : points) {
    curve.basis.knots.push_back(static_cast<double>(curve.points.size()));
    curve.points.push_back({point, 1});
  }
  curve.basis.knots.push_back(curve.basis.knots.back());
  return curve;
}

Curve closed(Curve curve) {
  if (isClamped(curve.basis) || !isSame(curve.points.front(), curve.points.back()))
    return curve;
  continueKnots(curve.basis);
  for (std::size_t i = 1; i < curve.basis.degree(); ++i)
    curve.points.push_back(ControlPoint(curve.points[i]));
  return curve;
}

Surface closedAlongV(Surface surface) {
  const auto columns = static_cast<std::ptrdiff_t>(surface.u.controlPoints());
  const bool repeats = std::equal(surface.points.begin(), surface.points.begin() + columns,
                                  surface.points.end() - columns, surface.points.end(), isSame);
  if (isClamped(surface.v) || !repeats)
    return surface;
  const std::size_t repeated = surface.v.degree() - 1;
  continueKnots(surface.v);
  const std::vector<ControlPoint> first = surface.points;
  surface.points.insert(surface.points.end(), first.begin() + columns,
                        first.begin() + columns * static_cast<std::ptrdiff_t>(1 + repeated));
  return surface;
}

Surface closedAlongU(const Surface& surface) {
  return transposed(closedAlongV(transposed(surface)));
}

} // namespace imgeo::nurbs
