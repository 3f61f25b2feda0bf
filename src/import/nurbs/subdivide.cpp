#include "import/nurbs/subdivide.h"

#include <algorithm>
#include <cmath>

namespace imgeo::nurbs {

namespace {

/// A piece is divided at most this many times.
constexpr int maxBisections = 10;

constexpr double quarters[] = {0.25, 0.5, 0.75};

double angleBetween(Vec3d a, Vec3d b) {
  return std::atan2(length(cross(a, b)), dot(a, b)); // 0 where one of them is zero
}

void bisect(double begin, double end, int depth, std::size_t maxCount, const NeedsDivision& needsDivision,
            std::vector<double>& parameters) {
  const double middle = (begin + end) / 2;
  const bool canDivide = depth < maxBisections && parameters.size() < maxCount && begin < middle && middle < end;
  if (canDivide && needsDivision(begin, end)) {
    bisect(begin, middle, depth + 1, maxCount, needsDivision, parameters);
    bisect(middle, end, depth + 1, maxCount, needsDivision, parameters);
  } else {
    parameters.push_back(end);
  }
}

} // namespace

Tolerance toleranceFor(const std::vector<ControlPoint>& points) {
  Box3d box;
  for (const ControlPoint& point : points)
    box.add(point.point);
  return {length(box.size()) * relativeTolerance};
}

std::vector<double> subdivided(const std::vector<double>& breaks, const NeedsDivision& needsDivision) {
  std::vector<double> parameters{breaks.front()};
  for (std::size_t i = 1; i < breaks.size(); ++i)
    bisect(breaks[i - 1], breaks[i], 0, std::max(maxParameters, 4 * breaks.size()), needsDivision, parameters);
  return parameters;
}

double distanceToSegment(Vec3d point, Vec3d begin, Vec3d end) {
  const Vec3d along = end - begin, to = point - begin;
  const double square = dot(along, along);
  const double t = square > 0 ? std::clamp(dot(to, along) / square, 0.0, 1.0) : 0;
  return length(to - along * t);
}

double distanceToTriangle(Vec3d point, Vec3d a, Vec3d b, Vec3d c) {
  const Vec3d normal = cross(b - a, c - a);
  const double area = length(normal);
  const auto isInside = [&](Vec3d from, Vec3d to) { return dot(cross(to - from, point - from), normal) >= 0; };
  if (area > 0 && isInside(a, b) && isInside(b, c) && isInside(c, a))
    return std::abs(dot(point - a, normal)) / area;
  return std::min({distanceToSegment(point, a, b), distanceToSegment(point, b, c), distanceToSegment(point, c, a)});
}

bool isBent(const std::function<CurvePoint(double)>& at, double begin, double end, const Tolerance& tolerance) {
  const CurvePoint first = at(begin), last = at(end);
  Vec3d tangent = first.tangent;
  for (const double quarter : quarters) {
    const CurvePoint point = at(begin + (end - begin) * quarter);
    if (distanceToSegment(point.point, first.point, last.point) > tolerance.distance ||
        angleBetween(tangent, point.tangent) > tolerance.angle)
      return true;
  }
  return angleBetween(tangent, last.tangent) > tolerance.angle;
}

Polyline tessellate(const Curve& curve, const Tolerance& tolerance) {
  Polyline line;
  const std::vector<double> breaks = curve.basis.breaks();
  line.parameters = subdivided(breaks, [&](double begin, double end) {
    const std::size_t span = curve.basis.spanAt((begin + end) / 2);
    return isBent([&](double t) { return evaluate(curve, span, t); }, begin, end, tolerance);
  });
  for (const double t : line.parameters)
    line.points.push_back(evaluate(curve, curve.basis.spanAt(t), t).point);
  for (std::size_t i = 1; i < line.points.size(); ++i)
    for (const double quarter : quarters) {
      const double t = line.parameters[i - 1] + (line.parameters[i] - line.parameters[i - 1]) * quarter;
      const Vec3d point = evaluate(curve, curve.basis.spanAt(t), t).point;
      line.error = std::max(line.error, distanceToSegment(point, line.points[i - 1], line.points[i]));
    }
  return line;
}

} // namespace imgeo::nurbs
