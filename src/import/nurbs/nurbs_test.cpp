#include "import/nurbs/subdivide.h"
#include "import/nurbs/tessellate_surface.h"

#include "base/error.h"

#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <random>

namespace imgeo::nurbs {
namespace {

/// An arc of unit radius about the origin, in pieces of a quarter turn (The NURBS Book, 7.3).
Curve arc(int quarterTurns) {
  Curve curve{{3, {0, 0, 0}}, {{{1, 0, 0}, 1}}};
  for (int quarter = 1; quarter <= quarterTurns; ++quarter) {
    const auto directionAt = [](int turns) { // exact
      constexpr int cosines[]{1, 0, -1, 0};
      return Vec3d{double(cosines[turns % 4]), double(cosines[(turns + 3) % 4]), 0};
    };
    curve.points.push_back({directionAt(quarter - 1) + directionAt(quarter), std::sqrt(0.5)});
    curve.points.push_back({directionAt(quarter), 1});
    curve.basis.knots.insert(curve.basis.knots.end(), {double(quarter), double(quarter)});
  }
  curve.basis.knots.push_back(quarterTurns);
  return curve;
}

/// Revolves a profile of x, the distance from the axis, and y, the height. u runs around the y axis.
Surface revolved(const Curve& profile) {
  const Curve circle = arc(4);
  Surface surface{circle.basis, profile.basis, {}};
  for (const ControlPoint& height : profile.points)
    for (const ControlPoint& around : circle.points)
      surface.points.push_back({{height.point.x * around.point.x, height.point.y, -height.point.x * around.point.y},
                                height.weight * around.weight});
  return surface;
}

Surface sphere() {
  Curve meridian = arc(2); // from the south pole to the north pole
  for (ControlPoint& point : meridian.points)
    point.point = {point.point.y, -point.point.x, 0};
  return revolved(meridian);
}

/// A flat square from 0 to 1 along both parameters.
Surface square() {
  const Basis basis{2, {0, 0, 1, 1}};
  return {basis, basis, {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{1, 1, 0}}}};
}

Vec3d cornerOf(const SurfaceMesh& mesh, std::size_t corner) {
  return Vec3d(mesh.positions[mesh.corners[corner].position]);
}

double volumeOf(const SurfaceMesh& mesh) {
  double volume = 0;
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
    volume += dot(cornerOf(mesh, i), cross(cornerOf(mesh, i + 1), cornerOf(mesh, i + 2))) / 6;
  return volume;
}

/// The vector area in z.
double areaOf(const SurfaceMesh& mesh) {
  double area = 0;
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
    const double part =
        cross(cornerOf(mesh, i + 1) - cornerOf(mesh, i), cornerOf(mesh, i + 2) - cornerOf(mesh, i)).z / 2;
    EXPECT_GE(part, -1e-9);
    area += part;
  }
  return area;
}

/// The length of the edges that have a triangle on one side only. No edge may have two triangles on the same side.
double borderLength(const SurfaceMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    const std::uint32_t from = mesh.corners[i].position, to = mesh.corners[i % 3 == 2 ? i - 2 : i + 1].position;
    EXPECT_EQ(++edges[std::pair(from, to)], 1);
  }
  double sum = 0;
  for (const auto& [edge, count] : edges)
    if (!edges.contains(std::pair(edge.second, edge.first)))
      sum += length(Vec3d(mesh.positions[edge.first]) - Vec3d(mesh.positions[edge.second]));
  return sum;
}

TEST(Nurbs, BasisFunctionsAddUpToOneAndHaveTheirDerivatives) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    const std::size_t order = 2 + random() % 6, count = order + random() % 6;
    Basis basis{order, {}};
    for (std::size_t i = 0; i < order + count; ++i)
      basis.knots.push_back(double(random() % 8));
    std::ranges::sort(basis.knots);
    if (!areValidKnots(basis.knots, order, count))
      continue;
    const double t = basis.begin() + (basis.end() - basis.begin()) * double(random() % 1000) / 1000;
    const std::size_t span = basis.spanAt(t);
    ASSERT_LE(basis.knots[span], t);
    ASSERT_LT(basis.knots[span], basis.knots[span + 1]);
    constexpr double step = 1e-5;
    const BasisValues values = evaluate(basis, span, t), before = evaluate(basis, span, t - step),
                      after = evaluate(basis, span, t + step);
    double sum = 0, derivativeSum = 0;
    for (std::size_t i = 0; i < order; ++i) {
      sum += values.value[i];
      derivativeSum += values.derivative[i];
      EXPECT_NEAR(values.derivative[i], (after.value[i] - before.value[i]) / (2 * step), 1e-4);
    }
    EXPECT_NEAR(sum, 1, 1e-9);
    EXPECT_NEAR(derivativeSum, 0, 1e-7);
  }
}

TEST(Nurbs, RationalArcsAreExactCircles) {
  const Curve circle = arc(4);
  for (double t = 0; t <= 4; t += 0.01) {
    const CurvePoint point = evaluate(circle, circle.basis.spanAt(t), t);
    EXPECT_NEAR(length(point.point), 1, 1e-14);
    EXPECT_NEAR(dot(point.point, point.tangent), 0, 1e-12);
  }
  const Tolerance tolerance = toleranceFor(circle.points);
  const Polyline line = tessellate(circle, tolerance);
  EXPECT_LE(line.error, tolerance.distance);
  EXPECT_LT(line.points.size(), 140u);
  EXPECT_EQ(line.points.front(), line.points.back());
}

TEST(Nurbs, StraightCurvesNeedNoFurtherPoints) {
  EXPECT_EQ(tessellate(polyline({{0, 0, 0}, {3, 0, 0}, {3, 4, 0}}), {0.001}).points.size(), 3u);
}

TEST(Nurbs, ClosedCurvesAreContinuedSmoothly) {
  Curve curve{{4, {0, 1, 2, 3, 4, 5, 6, 7, 8}}, {{{1, 0, 0}}, {{0, 1, 0}}, {{-1, 0, 0}}, {{0, -1, 0}}, {{1, 0, 0}}}};
  curve = closed(curve);
  const CurvePoint begin = evaluate(curve, curve.basis.spanAt(curve.basis.begin()), curve.basis.begin()),
                   end = evaluate(curve, curve.basis.spanAt(curve.basis.end()), curve.basis.end());
  EXPECT_NEAR(length(begin.point - end.point), 0, 1e-12);
  EXPECT_NEAR(length(begin.tangent - end.tangent), 0, 1e-12);
  EXPECT_EQ(curve.basis.breaks().size(), 5u);  // four pieces
  EXPECT_EQ(closed(arc(4)).points.size(), 9u); // it ends where it begins
}

TEST(Nurbs, ASphereIsClosedSmoothAndWithinTheTolerance) {
  const Surface surface = sphere();
  const SurfaceMesh mesh = tessellate(surface, {}, {});
  const double tolerance = toleranceFor(surface.points).distance;
  EXPECT_EQ(borderLength(mesh), 0);
  EXPECT_LE(mesh.error, tolerance);
  EXPECT_GT(volumeOf(mesh), 4.0 / 3 * std::numbers::pi * (1 - 3 * tolerance));
  EXPECT_LT(volumeOf(mesh), 4.0 / 3 * std::numbers::pi);
  EXPECT_LT(mesh.corners.size() / 3, 13'000u);
  for (const MeshCorner& corner : mesh.corners) {
    EXPECT_NEAR(length(Vec3d(mesh.positions[corner.position])), 1, 1e-6);
    EXPECT_GT(dot(mesh.positions[corner.position], mesh.normals[corner.normal]), 0.9999f);
  }
}

TEST(Nurbs, CreasesHaveTwoNormals) {
  // A roof: degree 1 with a ridge in the middle.
  const Surface roof{{2, {0, 0, 1, 2, 2}},
                     {2, {0, 0, 1, 1}},
                     {{{0, 0, 0}}, {{1, 0, 1}}, {{2, 0, 0}}, {{0, 1, 0}}, {{1, 1, 1}}, {{2, 1, 0}}}};
  const SurfaceMesh mesh = tessellate(roof, {}, {});
  EXPECT_EQ(mesh.positions.size(), 6u);
  EXPECT_EQ(mesh.corners.size(), 12u);
  EXPECT_EQ(mesh.normals.size(), 8u);
  EXPECT_EQ(mesh.error, 0);
}

TEST(Nurbs, TextureCoordinatesFollowTheParametersOrASurfaceOfTheirOwn) {
  EXPECT_EQ(tessellate(square(), {}, {}).texCoords.at(0), (Vec2f{0, 0}));
  const Basis basis{2, {5, 5, 7, 7}};
  const Surface own{basis, basis, {{{3, 3, 0}}, {{4, 3, 0}}, {{3, 5, 0}}, {{4, 5, 0}}}};
  const SurfaceMesh mesh = tessellate(square(), {}, own);
  for (const MeshCorner& corner : mesh.corners) {
    const Vec3f position = mesh.positions[corner.position];
    EXPECT_EQ(mesh.texCoords[corner.texCoord], (Vec2f{3 + position.x, 3 + 2 * position.y}));
  }
}

Contour polygon(std::vector<Vec3d> corners) {
  corners.push_back(Vec3d(corners.front()));
  return {polyline(corners)};
}

Contour circle(double x, double y, double radius) {
  Curve curve = arc(4);
  for (ControlPoint& point : curve.points)
    point.point = point.point * radius + Vec3d{x, y, 0};
  return {curve};
}

TEST(Nurbs, TrimmingKeepsWhatIsInsideOfAnOddNumberOfContours) {
  const Contour outer = polygon({{0.1, 0.1, 0}, {0.9, 0.1, 0}, {0.9, 0.9, 0}, {0.1, 0.9, 0}});
  EXPECT_NEAR(areaOf(tessellate(square(), {outer}, {})), 0.64, 1e-6);
  const SurfaceMesh holed = tessellate(square(), {outer, circle(0.5, 0.5, 0.3)}, {});
  EXPECT_NEAR(areaOf(holed), 0.64 - std::numbers::pi * 0.09, 2e-3);
  EXPECT_NEAR(borderLength(holed), 3.2 + 0.6 * std::numbers::pi, 2e-3);
  const Contour all = polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  EXPECT_NEAR(areaOf(tessellate(square(), {all}, {})), 1, 1e-6);
}

TEST(Nurbs, TrimmedCellsMeetCornerToCorner) {
  std::mt19937 random(2);
  const auto between = [&](double low, double high) { return low + (high - low) * double(random() % 10'000) / 10'000; };
  Surface surface = square(); // with enough knots for a grid
  surface.u = {2, {0, 0, 0.25, 0.5, 0.6, 1, 1}};
  surface.v = {2, {0, 0, 0.3, 0.5, 0.9, 1, 1}};
  surface.points.clear();
  for (const double v : {0.0, 0.3, 0.5, 0.9, 1.0})
    for (const double u : {0.0, 0.25, 0.5, 0.6, 1.0})
      surface.points.push_back({{u, v, 0}});
  for (int round = 0; round < 50; ++round) {
    // A star about the middle, with the hole of a smaller star: corners at rising angles.
    std::vector<Vec3d> outer, hole;
    const int count = 3 + int(random() % 12);
    double outerArea = 0, holeArea = 0, border = 0;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count, radius = between(0.3, 0.5);
      const Vec3d direction{std::cos(angle), std::sin(angle), 0};
      // Some corners lie exactly on lines of the grid.
      outer.push_back(Vec3d{0.5, 0.5, 0} + direction * (i % 3 == 0 ? 0.5 : radius));
      hole.push_back(Vec3d{0.5, 0.5, 0} + direction * between(0.02, 0.14));
    }
    for (std::size_t i = 0; i < outer.size(); ++i) {
      const auto areaOfEdge = [&](const std::vector<Vec3d>& loop) {
        const Vec3d a = loop[i], b = loop[(i + 1) % loop.size()];
        border += length(b - a);
        return (a.x * b.y - a.y * b.x) / 2;
      };
      outerArea += areaOfEdge(outer);
      holeArea += areaOfEdge(hole);
    }
    const SurfaceMesh mesh = tessellate(surface, {polygon(outer), polygon(hole)}, {});
    EXPECT_NEAR(areaOf(mesh), outerArea - holeArea, 1e-5);
    EXPECT_NEAR(borderLength(mesh), border, 1e-4); // no gaps inside
  }
}

TEST(Nurbs, ContoursHaveALimit) {
  std::vector<Vec3d> corners;
  for (std::size_t i = 0; i <= maxContourCorners; ++i)
    corners.push_back({double(i % 2), double(i) / maxContourCorners, 0});
  EXPECT_THROW(tessellate(square(), {polygon(corners)}, {}), Error);
}

} // namespace
} // namespace imgeo::nurbs
