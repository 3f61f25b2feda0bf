#include "import/nurbs/tessellate_surface.h"

#include "base/error.h"
#include "import/nurbs/parameter_grid.h"
#include "import/nurbs/subdivide.h"
#include "import/nurbs/surface_vertices.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace imgeo::nurbs {

namespace {

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

class Triangles {
public:
  Triangles(SurfaceVertices& vertices, const ParameterGrid& grid, SurfaceMesh& mesh)
      : vertices_(vertices), grid_(grid), mesh_(mesh) {}

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

  SurfaceVertices& vertices_;
  const ParameterGrid& grid_;
  SurfaceMesh& mesh_;
};

} // namespace

SurfaceMesh tessellate(const Surface& surface, const std::vector<Contour>& contours,
                       const std::optional<Surface>& texCoords) {
  const Tolerance tolerance = toleranceFor(surface.points);
  const ParameterGrid grid = parameterGridOf(surface, tolerance);
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
  SurfaceVertices vertices(surface, texCoords, grid, mesh);
  Triangles triangles(vertices, grid, mesh);
  for (const CellPolygon& polygon : cells(grid.us, grid.vs, loops))
    triangles.add(polygon);
  return mesh;
}

} // namespace imgeo::nurbs
