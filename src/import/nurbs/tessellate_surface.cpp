#include "import/nurbs/tessellate_surface.h"

#include "base/error.h"
#include "import/nurbs/subdivide.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <unordered_map>

namespace imgeo::nurbs {

namespace {

/// Limit of the number of vertices of the grid of parameters.
constexpr std::size_t maxGridVertices = std::size_t{1} << 21;

/// Edges that are closer than this, relative to the size of the surface, coincide; edges shorter than this are poles.
constexpr double samePosition = 1e-7;

/// The grid is refined at most this many times where the middles of its cells are too far from the surface.
constexpr int maxRefinements = 4;

/// About this many parameters of one direction are examined when the other direction is divided (samplesOf).
constexpr std::size_t maxSamples = 48;

/// Parameters at which a direction is examined: several within each interval of its knots.
std::vector<double> samplesOf(const Basis& basis) {
  const std::vector<double> breaks = basis.breaks();
  const std::size_t intervals = breaks.size() - 1;
  const std::size_t perInterval = std::clamp<std::size_t>(maxSamples / intervals, 1, basis.order);
  const std::size_t step = std::max<std::size_t>(intervals / maxSamples, 1);
  std::vector<double> samples;
  for (std::size_t i = 0; i < intervals; i += step)
    for (std::size_t j = 0; j < perInterval; ++j)
      samples.push_back(breaks[i] +
                        (breaks[i + 1] - breaks[i]) * static_cast<double>(j) / static_cast<double>(perInterval));
  samples.push_back(breaks.back());
  return samples;
}

struct Grid {
  std::vector<double> us, vs;
  double error = 0; ///< the largest distance between the surface and the triangles of the grid that was measured
};

/// Whether the quadrilateral a, b, c, d is divided between a and c, not between b and d.
bool isRisingDiagonalShorter(Vec3d a, Vec3d b, Vec3d c, Vec3d d) {
  return length(c - a) <= length(d - b);
}

class GridMaker {
public:
  GridMaker(const Surface& surface, const Tolerance& tolerance) : surface_(surface), tolerance_(tolerance) {}

  Grid make() {
    // Distances along both directions add up: refine() divides further where the sum is too large.
    grid_.us = subdivided(surface_.u.breaks(), [&, vs = samplesOf(surface_.v)](double begin, double end) {
      const std::size_t span = surface_.u.spanAt((begin + end) / 2);
      return std::ranges::any_of(vs, [&](double v) {
        const std::size_t vSpan = surface_.v.spanAt(v);
        return isBent(
            [&](double u) {
              const SurfacePoint point = evaluate(surface_, span, vSpan, u, v);
              return CurvePoint{point.point, point.alongU};
            },
            begin, end, tolerance_);
      });
    });
    grid_.vs = subdivided(surface_.v.breaks(), [&, us = samplesOf(surface_.u)](double begin, double end) {
      const std::size_t span = surface_.v.spanAt((begin + end) / 2);
      return std::ranges::any_of(us, [&](double u) {
        const std::size_t uSpan = surface_.u.spanAt(u);
        return isBent(
            [&](double v) {
              const SurfacePoint point = evaluate(surface_, uSpan, span, u, v);
              return CurvePoint{point.point, point.alongV};
            },
            begin, end, tolerance_);
      });
    });
    for (int i = 0; i < maxRefinements && refine(); ++i) {
    }
    return std::move(grid_);
  }

private:
  Vec3d at(double u, double v) const {
    return evaluate(surface_, surface_.u.spanAt(u), surface_.v.spanAt(v), u, v).point;
  }

  /// Measures the distance between surface and triangles at the middle of each cell, and divides the rows or columns of
  /// cells that are too far away, in the direction that bends more. Returns whether it divided any.
  bool refine() {
    const auto& [us, vs, error] = grid_;
    std::vector<Vec3d> points;
    for (const double v : vs)
      for (const double u : us)
        points.push_back(at(u, v));
    std::vector<double> newUs, newVs;
    double maxDistance = 0;
    std::vector<bool> dividesRow(vs.size()), dividesColumn(us.size());
    for (std::size_t row = 0; row + 1 < vs.size(); ++row)
      for (std::size_t column = 0; column + 1 < us.size(); ++column) {
        const Vec3d* const low = &points[row * us.size() + column];
        const Vec3d* const high = low + us.size();
        const double u = (us[column] + us[column + 1]) / 2, v = (vs[row] + vs[row + 1]) / 2;
        const Vec3d middle = at(u, v);
        const bool isRising = isRisingDiagonalShorter(low[0], low[1], high[1], high[0]);
        const double distance = isRising ? std::min(distanceToTriangle(middle, low[0], low[1], high[1]),
                                                    distanceToTriangle(middle, low[0], high[1], high[0]))
                                         : std::min(distanceToTriangle(middle, low[0], low[1], high[0]),
                                                    distanceToTriangle(middle, low[1], high[1], high[0]));
        const double alongU = distanceToSegment(at(u, vs[row]), low[0], low[1]),
                     alongV = distanceToSegment(at(us[column], v), low[0], high[0]);
        maxDistance = std::max({maxDistance, distance, alongU, alongV});
        if (distance > tolerance_.distance)
          (alongU > alongV ? dividesColumn[column] : dividesRow[row]) = true;
      }
    grid_.error = maxDistance;
    const std::vector<double> finerUs = divided(us, dividesColumn), finerVs = divided(vs, dividesRow);
    const bool isFiner = finerUs.size() + finerVs.size() > us.size() + vs.size();
    if (!isFiner || finerUs.size() * finerVs.size() > maxGridVertices)
      return false;
    grid_.us = finerUs;
    grid_.vs = finerVs;
    return true;
  }

  static std::vector<double> divided(const std::vector<double>& values, const std::vector<bool>& divides) {
    std::vector<double> finer;
    for (std::size_t i = 0; i < values.size(); ++i) {
      finer.push_back(values[i]);
      if (i + 1 < values.size() && divides[i])
        finer.push_back((values[i] + values[i + 1]) / 2);
    }
    return finer;
  }

  const Surface& surface_;
  Tolerance tolerance_;
  Grid grid_;
};

/// The polygon of a contour. Pieces of curves are short enough that their images on the surface keep to the tolerance.
Loop loopOf(const Contour& contour, const Surface& surface, const Tolerance& tolerance) {
  Loop loop;
  for (const Curve& curve : contour) {
    const auto isBentOnSurface = [&](double begin, double end) {
      const std::size_t span = curve.basis.spanAt((begin + end) / 2);
      const auto onSurface = [&](double t) {
        const CurvePoint parameters = evaluate(curve, span, t);
        const double u = std::clamp(parameters.point.x, surface.u.begin(), surface.u.end());
        const double v = std::clamp(parameters.point.y, surface.v.begin(), surface.v.end());
        const SurfacePoint point = evaluate(surface, surface.u.spanAt(u), surface.v.spanAt(v), u, v);
        return CurvePoint{point.point, point.alongU * parameters.tangent.x + point.alongV * parameters.tangent.y};
      };
      return isBent(onSurface, begin, end, tolerance);
    };
    // cells() cuts straight pieces at the lines of the grid.
    const bool isStraight = curve.basis.order == 2;
    for (const double t : isStraight ? curve.basis.breaks() : subdivided(curve.basis.breaks(), isBentOnSurface)) {
      const Vec3d point = evaluate(curve, curve.basis.spanAt(t), t).point;
      const Parameters corner{point.x, point.y};
      if (!std::isfinite(corner.x) || !std::isfinite(corner.y))
        throw Error(ErrorKind::malformed, "", "a contour has points that are no finite numbers");
      if (loop.empty() || loop.back() != corner)
        loop.push_back(corner);
    }
  }
  return loop;
}

/// Makes the vertices of a surface; equal positions are one.
class Vertices {
public:
  Vertices(const Surface& surface, const std::optional<Surface>& texCoords, const Grid& grid, SurfaceMesh& mesh)
      : surface_(surface), texCoords_(texCoords), mesh_(mesh) {
    Box3d box;
    for (const ControlPoint& point : surface.points)
      box.add(point.point);
    maxDistance_ = length(box.size()) * samePosition;
    closesU_ = std::ranges::all_of(grid.vs, [&](double v) { return isSame(u0(), v, u1(), v); });
    closesV_ = std::ranges::all_of(grid.us, [&](double u) { return isSame(u, v0(), u, v1()); });
    isPoleV0_ = std::ranges::all_of(grid.us, [&](double u) { return isSame(u0(), v0(), u, v0()); });
    isPoleV1_ = std::ranges::all_of(grid.us, [&](double u) { return isSame(u0(), v1(), u, v1()); });
    isPoleU0_ = std::ranges::all_of(grid.vs, [&](double v) { return isSame(u0(), v0(), u0(), v); });
    isPoleU1_ = std::ranges::all_of(grid.vs, [&](double v) { return isSame(u1(), v0(), u1(), v); });
  }

  /// The corner at these parameters, with the normal of the knot interval that contains the cell's middle.
  MeshCorner at(Parameters parameters, Parameters middle) {
    Vertex& vertex = vertices_[parameters];
    if (vertex.normals.empty()) {
      vertex.position = positionAt(canonical(parameters));
      vertex.texCoord = static_cast<std::uint32_t>(mesh_.texCoords.size());
      mesh_.texCoords.push_back(texCoordAt(parameters));
    } else if (!surface_.u.mayHaveCorner(parameters.x) && !surface_.v.mayHaveCorner(parameters.y)) {
      return {vertex.position, vertex.normals.front(), vertex.texCoord};
    }
    return {vertex.position, normalOf(vertex, parameters, middle), vertex.texCoord};
  }

  Vec3d position(const MeshCorner& corner) const { return Vec3d(mesh_.positions[corner.position]); }

private:
  struct Vertex {
    std::uint32_t position = 0, texCoord = 0;
    std::vector<std::uint32_t> normals; ///< several at a crease
  };

  struct ParametersHash {
    std::size_t operator()(const Parameters& p) const {
      return std::hash<double>()(p.x) * 0x9e3779b97f4a7c15 ^ std::hash<double>()(p.y);
    }
  };

  double u0() const { return surface_.u.begin(); }
  double u1() const { return surface_.u.end(); }
  double v0() const { return surface_.v.begin(); }
  double v1() const { return surface_.v.end(); }

  Vec3d pointAt(double u, double v) const {
    return evaluate(surface_, surface_.u.spanAt(u), surface_.v.spanAt(v), u, v).point;
  }

  bool isSame(double u, double v, double otherU, double otherV) const {
    return length(pointAt(u, v) - pointAt(otherU, otherV)) <= maxDistance_;
  }

  /// One of all parameters that have the same position, for closed edges and poles.
  Parameters canonical(Parameters p) const {
    if (closesU_ && p.x == u1())
      p.x = u0();
    if (closesV_ && p.y == v1())
      p.y = v0();
    if ((isPoleV0_ && p.y == v0()) || (isPoleV1_ && p.y == v1()))
      p.x = u0();
    if ((isPoleU0_ && p.x == u0()) || (isPoleU1_ && p.x == u1()))
      p.y = v0();
    return p;
  }

  std::uint32_t positionAt(Parameters p) {
    const auto [found, isNew] = positions_.try_emplace(p, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (isNew)
      mesh_.positions.push_back(Vec3f(pointAt(p.x, p.y)));
    return found->second;
  }

  Vec2f texCoordAt(Parameters p) const {
    const double s = (p.x - u0()) / (u1() - u0()), t = (p.y - v0()) / (v1() - v0());
    if (!texCoords_)
      return {static_cast<float>(s), static_cast<float>(t)};
    const auto& [u, v, points] = *texCoords_;
    const double ownU = u.begin() + s * (u.end() - u.begin()), ownV = v.begin() + t * (v.end() - v.begin());
    const Vec3d value = evaluate(*texCoords_, u.spanAt(ownU), v.spanAt(ownV), ownU, ownV).point;
    return {static_cast<float>(value.x), static_cast<float>(value.y)};
  }

  std::uint32_t normalOf(Vertex& vertex, Parameters p, Parameters middle) {
    const Vec3f normal(normalAt(p, middle));
    for (const std::uint32_t known : vertex.normals)
      if (dot(mesh_.normals[known], normal) > 0.99999f)
        return known;
    vertex.normals.push_back(static_cast<std::uint32_t>(mesh_.normals.size()));
    mesh_.normals.push_back(normal);
    return vertex.normals.back();
  }

  /// The unit normal. At a pole, where one derivative vanishes, that of a point nearby inside of the cell.
  Vec3d normalAt(Parameters p, Parameters middle) const {
    const std::size_t uSpan = surface_.u.spanAt(middle.x), vSpan = surface_.v.spanAt(middle.y);
    for (const double inwards : {0.0, 1e-4, 1e-2, 1.0}) {
      const SurfacePoint point =
          evaluate(surface_, uSpan, vSpan, p.x + (middle.x - p.x) * inwards, p.y + (middle.y - p.y) * inwards);
      const Vec3d normal = point.normal();
      const double size = length(normal);
      if (size > 1e-9 * length(point.alongU) * length(point.alongV) &&
          length(point.alongU) > minDerivative(surface_.u) && length(point.alongV) > minDerivative(surface_.v))
        return normal * (1 / size);
    }
    return {0, 0, 1};
  }

  /// A derivative shorter than this counts as zero.
  double minDerivative(const Basis& basis) const { return maxDistance_ / (basis.end() - basis.begin()); }

  const Surface& surface_;
  const std::optional<Surface>& texCoords_;
  SurfaceMesh& mesh_;
  double maxDistance_ = 0;
  bool closesU_ = false, closesV_ = false, isPoleU0_ = false, isPoleU1_ = false, isPoleV0_ = false, isPoleV1_ = false;
  std::unordered_map<Parameters, Vertex, ParametersHash> vertices_;
  std::unordered_map<Parameters, std::uint32_t, ParametersHash> positions_;
};

class Triangles {
public:
  Triangles(Vertices& vertices, const Grid& grid, SurfaceMesh& mesh) : vertices_(vertices), grid_(grid), mesh_(mesh) {}

  void add(const CellPolygon& polygon) {
    const auto& [us, vs, error] = grid_;
    const Parameters middle{(us[polygon.column] + us[polygon.column + 1]) / 2,
                            (vs[polygon.row] + vs[polygon.row + 1]) / 2};
    std::vector<MeshCorner> corners;
    for (const Parameters& parameters : polygon.corners)
      corners.push_back(vertices_.at(parameters, middle));
    if (corners.size() <= 4) {
      addSmall(corners);
      return;
    }
    Parameters center;
    for (const auto& [u, v] : polygon.corners)
      center = {center.x + u / static_cast<double>(corners.size()), center.y + v / static_cast<double>(corners.size())};
    const MeshCorner hub = vertices_.at(center, middle);
    for (std::size_t i = 0; i < corners.size(); ++i)
      addTriangle(hub, corners[i], corners[(i + 1) % corners.size()]);
  }

private:
  void addSmall(const std::vector<MeshCorner>& c) {
    if (c.size() == 3) {
      addTriangle(c[0], c[1], c[2]);
      return;
    }
    const auto at = [&](std::size_t i) { return vertices_.position(c[i]); };
    if (isRisingDiagonalShorter(at(0), at(1), at(2), at(3))) {
      addTriangle(c[0], c[1], c[2]);
      addTriangle(c[0], c[2], c[3]);
    } else {
      addTriangle(c[0], c[1], c[3]);
      addTriangle(c[1], c[2], c[3]);
    }
  }

  /// Leaves out triangles whose corners coincide, as at poles.
  void addTriangle(const MeshCorner& a, const MeshCorner& b, const MeshCorner& c) {
    if (a.position != b.position && b.position != c.position && c.position != a.position)
      mesh_.corners.insert(mesh_.corners.end(), {a, b, c});
  }

  Vertices& vertices_;
  const Grid& grid_;
  SurfaceMesh& mesh_;
};

} // namespace

SurfaceMesh tessellate(const Surface& surface, const std::vector<Contour>& contours,
                       const std::optional<Surface>& texCoords) {
  const Tolerance tolerance = toleranceFor(surface.points);
  const Grid grid = GridMaker(surface, tolerance).make();
  std::vector<Loop> loops;
  std::size_t corners = 0;
  for (const Contour& contour : contours) {
    loops.push_back(loopOf(contour, surface, tolerance));
    corners += loops.back().size();
    if (corners > maxContourCorners)
      throw Error(ErrorKind::limit, "", fmt::format("contours have more than {} corners", maxContourCorners));
  }
  SurfaceMesh mesh;
  mesh.error = grid.error;
  Vertices vertices(surface, texCoords, grid, mesh);
  Triangles triangles(vertices, grid, mesh);
  for (const CellPolygon& polygon : cells(grid.us, grid.vs, loops))
    triangles.add(polygon);
  return mesh;
}

} // namespace imgeo::nurbs
