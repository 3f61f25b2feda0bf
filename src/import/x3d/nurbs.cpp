#include "import/x3d/nurbs.h"

#include "import/nurbs/subdivide.h"
#include "import/nurbs/tessellate_surface.h"
#include "import/x3d/extrusion.h"
#include "import/x3d/texture_coordinates.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace imgeo::x3d {

namespace {

using nurbs::ControlPoint;
using nurbs::Curve;
using nurbs::Surface;

std::vector<Vec3d> pointsOf(const std::vector<double>& numbers, std::size_t dimensions) {
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i + dimensions <= numbers.size(); i += dimensions)
    points.push_back({numbers[i], numbers[i + 1], dimensions == 3 ? numbers[i + 2] : 0});
  return points;
}

double diagonalOf(const std::vector<ControlPoint>& points) {
  Box3d box;
  for (const ControlPoint& point : points)
    box.add(point.point);
  return length(box.size());
}

/// Points in rows along u.
struct Net {
  std::size_t columns = 0, rows = 0;
  std::vector<Vec3d> points;
};

/// Reads the fields that NURBS nodes share.
class NurbsFields {
public:
  NurbsFields(const Source& source, pugi::xml_node node) : source_(source), node_(node) {}

  [[noreturn]] void fail(ErrorKind kind, const std::string& message) const { source_.fail(node_, kind, message); }

  /// The value of a field, which must be a whole number from 0 to `maximum`.
  std::size_t count(const char* field, double fallback, std::size_t maximum) const {
    const double value = source_.real(node_, field, fallback);
    if (!(value >= 0) || value > static_cast<double>(maximum) || value != std::floor(value))
      fail(ErrorKind::malformed, fmt::format("{} is {}, which is no whole number up to {}", field, value, maximum));
    return static_cast<std::size_t>(value);
  }

  /// The given knots, or clamped ones for invalid knots. `repeatsFirst`: the node is closed, and its last control point
  /// repeats the first.
  nurbs::Basis basis(const char* orderField, const char* knotField, std::size_t controlPoints,
                     bool repeatsFirst) const {
    nurbs::Basis basis{count(orderField, 3, nurbs::maxOrder), source_.reals(node_, knotField)};
    if (basis.order < 2)
      fail(ErrorKind::malformed, fmt::format("{} is less than 2", orderField));
    if (controlPoints < basis.order)
      fail(ErrorKind::malformed, fmt::format("has {} control points, fewer than {}", controlPoints, orderField));
    if (!nurbs::areValidKnots(basis.knots, basis.order, controlPoints)) {
      basis.knots = nurbs::clampedKnots(basis.order, controlPoints);
      if (repeatsFirst) // evenly spaced, so that the curve can be continued
        std::iota(basis.knots.begin(), basis.knots.end(), 0.0);
    }
    return basis;
  }

  /// The standard gives a control point as (x, y, z, weight). X_ITE, X3DOM and FreeWRL take these as homogeneous
  /// coordinates, so that the point itself is (x, y, z) / weight.
  std::vector<ControlPoint> weighted(const std::vector<Vec3d>& points) const {
    const std::vector<double> weights = source_.reals(node_, "weight");
    if (std::ranges::any_of(weights, [](double weight) { return !(weight > 0); }))
      fail(ErrorKind::malformed, "has weights that are not greater than 0");
    std::vector<ControlPoint> controls;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double weight = weights.size() == points.size() ? weights[i] : 1;
      controls.push_back({points[i] * (1 / weight), weight});
    }
    return controls;
  }

  std::vector<Vec3d> points2D(const char* field) const { return pointsOf(source_.reals(node_, field), 2); }

  /// The points of a Coordinate or CoordinateDouble.
  std::vector<Vec3d> points3D() const {
    for (const char* name : {"Coordinate", "CoordinateDouble"})
      if (const pugi::xml_node child = node_.child(name))
        return pointsOf(source_.reals(source_.resolved(child), "point"), 3);
    fail(ErrorKind::unsupported, "has no Coordinate or CoordinateDouble as control points");
  }

  /// The first uDimension * vDimension points.
  Net net(std::vector<Vec3d> points) const {
    constexpr std::size_t maxDimension = std::size_t{1} << 24;
    const std::size_t columns = count("uDimension", 0, maxDimension), rows = count("vDimension", 0, maxDimension);
    if (columns * rows > points.size() || columns * rows == 0)
      fail(ErrorKind::malformed, fmt::format("has {} control points and needs {} x {}", points.size(), columns, rows));
    points.resize(columns * rows);
    return {columns, rows, std::move(points)};
  }

  Curve curve(const std::vector<Vec3d>& points) const {
    Curve curve{{}, weighted(points)};
    const bool repeats = source_.boolean(node_, "closed", false) && !points.empty() && points.front() == points.back();
    curve.basis = basis("order", "knot", points.size(), repeats);
    return repeats ? nurbs::closed(std::move(curve)) : curve;
  }

private:
  const Source& source_;
  pugi::xml_node node_;
};

bool isCurve2D(std::string_view element) {
  return element == "NurbsCurve2D" || element == "ContourPolyline2D";
}

/// A NurbsCurve2D or ContourPolyline2D.
Curve curve2D(const Source& source, pugi::xml_node node) {
  const NurbsFields fields(source, node);
  const std::vector<Vec3d> points = fields.points2D("controlPoint");
  if (std::string_view(node.name()) == "NurbsCurve2D")
    return fields.curve(points);
  if (points.size() < 2)
    fields.fail(ErrorKind::malformed, "has fewer than two points");
  return nurbs::polyline(points);
}

class NurbsReader {
public:
  NurbsReader(const Source& source, pugi::xml_node node, VertexData& data, Faces& faces)
      : source_(source), node_(node), fields_(source, node), data_(data), faces_(faces) {}

  double read() {
    const std::string_view name = node_.name();
    const bool isSwept = name == "NurbsSweptSurface" || name == "NurbsSwungSurface";
    const double error = name == "NurbsCurve" ? readCurve() : isSwept ? readSwept() : readSurface();
    const bool isFinite =
        std::ranges::all_of(data_.positions,
                            [](Vec3f p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }) &&
        std::ranges::all_of(data_.texCoords, [](Vec2f t) { return std::isfinite(t.x) && std::isfinite(t.y); });
    if (!isFinite) // tiny weights or intervals of knots
      fields_.fail(ErrorKind::malformed, "has points that are no finite numbers");
    return error;
  }

private:
  double readCurve() {
    const Curve curve = fields_.curve(fields_.points3D());
    const nurbs::Polyline line = nurbs::tessellate(curve, nurbs::toleranceFor(curve.points));
    faces_.topology = Topology::lines;
    for (const Vec3d& point : line.points)
      data_.positions.push_back(Vec3f(point));
    for (std::uint32_t i = 1; i < data_.positions.size(); ++i)
      faces_.corners.insert(faces_.corners.end(), {{i - 1, none, none, none}, {i, none, none, none}});
    return relative(line.error, diagonalOf(curve.points));
  }

  static double relative(double error, double size) { return size > 0 ? error / size : 0; }

  Surface surface() const {
    const Net net = fields_.net(fields_.points3D());
    const auto& [columns, rows, points] = net;
    bool repeatsU = source_.boolean(node_, "uClosed", false), repeatsV = source_.boolean(node_, "vClosed", false);
    for (std::size_t row = 0; row < rows; ++row)
      repeatsU = repeatsU && points[row * columns] == points[(row + 1) * columns - 1];
    for (std::size_t column = 0; column < columns; ++column)
      repeatsV = repeatsV && points[column] == points[(rows - 1) * columns + column];
    Surface surface{fields_.basis("uOrder", "uKnot", columns, repeatsU),
                    fields_.basis("vOrder", "vKnot", rows, repeatsV), fields_.weighted(points)};
    if (repeatsU)
      surface = nurbs::closedAlongU(surface);
    return repeatsV ? nurbs::closedAlongV(std::move(surface)) : surface;
  }

  /// The surface of texture coordinates that a TextureCoordinate, with one value for each control point, or a
  /// NurbsTextureCoordinate describes.
  std::optional<Surface> texCoords() const {
    if (const pugi::xml_node child = source_.resolved(node_.child("NurbsTextureCoordinate"))) {
      const NurbsFields own(source_, child);
      const Net net = own.net(own.points2D("controlPoint"));
      return Surface{own.basis("uOrder", "uKnot", net.columns, false), own.basis("vOrder", "vKnot", net.rows, false),
                     own.weighted(net.points)};
    }
    const std::vector<pugi::xml_node> sets = texCoordNodes(source_, node_);
    if (sets.empty() || texCoordGeneratorOf(sets[0]))
      return {};
    const Net net = fields_.net(pointsOf(source_.reals(sets[0], "point"), 2));
    Surface surface{
        fields_.basis("uOrder", "uKnot", net.columns, false), fields_.basis("vOrder", "vKnot", net.rows, false), {}};
    for (const Vec3d& point : net.points)
      surface.points.push_back({point, 1});
    return surface;
  }

  std::vector<nurbs::Contour> contours() const {
    std::vector<nurbs::Contour> contours;
    if (std::string_view(node_.name()) != "NurbsTrimmedSurface")
      return contours;
    for (const pugi::xml_node& child : node_.children("Contour2D")) {
      nurbs::Contour contour;
      for (const pugi::xml_node& curve : source_.resolved(child).children())
        if (isCurve2D(curve.name()))
          contour.push_back(curve2D(source_, source_.resolved(curve)));
      if (!contour.empty())
        contours.push_back(std::move(contour));
    }
    return contours;
  }

  double readSurface() {
    const Surface controlled = surface();
    nurbs::SurfaceMesh mesh;
    try {
      mesh = nurbs::tessellate(controlled, contours(), texCoords());
    } catch (const Error& error) {
      if (error.location().empty())
        fields_.fail(error.kind() == ErrorKind::limit ? ErrorKind::unsupported : error.kind(), error.message());
      throw;
    }
    data_.positions = std::move(mesh.positions);
    data_.normals = std::move(mesh.normals);
    data_.texCoords = std::move(mesh.texCoords);
    for (const nurbs::MeshCorner& corner : mesh.corners) {
      faces_.corners.push_back({corner.position, corner.normal, corner.texCoord, none});
      if (faces_.corners.size() % 3 == 0)
        faces_.ends.push_back(faces_.corners.size());
    }
    return relative(mesh.error, diagonalOf(controlled.points));
  }

  /// The curve of a child with this containerField; without that field the `position`-th curve of two dimensions.
  Curve childCurve2D(std::string_view containerField, std::size_t position) const {
    std::size_t at = 0;
    for (const pugi::xml_node& child : node_.children()) {
      if (!isCurve2D(child.name()))
        continue;
      const pugi::xml_attribute field = child.attribute("containerField");
      if (field ? field.value() == containerField : at == position)
        return curve2D(source_, source_.resolved(child));
      ++at;
    }
    fields_.fail(ErrorKind::malformed, fmt::format("has no {}", containerField));
  }

  /// Carries a cross-section along a curve, as Extrusion does: constant, and perpendicular to the curve. The
  /// trajectory of a NurbsSwungSurface lies in the plane of x and z.
  double readSwept() {
    const bool isSwung = std::string_view(node_.name()) == "NurbsSwungSurface";
    const Curve section = childCurve2D(isSwung ? "profileCurve" : "crossSectionCurve", 0);
    Curve trajectory = isSwung ? childCurve2D("trajectoryCurve", 1) : trajectory3D();
    if (isSwung)
      for (ControlPoint& point : trajectory.points)
        point.point = {point.point.x, 0, point.point.y};
    double reach = 0; // the largest distance of the cross-section from the trajectory
    for (const ControlPoint& point : section.points)
      reach = std::max(reach, length(point.point));
    const double size = diagonalOf(trajectory.points) + 2 * reach;
    // A third each for the cross-section, the trajectory, and what the bends of the trajectory add far away from it.
    nurbs::Tolerance tolerance{size * nurbs::relativeTolerance / 3};
    const nurbs::Polyline ring = nurbs::tessellate(section, tolerance);
    // What is `reach` away from the trajectory is off by another reach * angle^2 / 8.
    if (reach > 0)
      tolerance.angle = std::min(tolerance.angle, std::sqrt(8 * tolerance.distance / reach));
    const nurbs::Polyline spine = nurbs::tessellate(trajectory, tolerance);
    constexpr std::size_t maxVertices = std::size_t{1} << 22;
    if (ring.points.size() * spine.points.size() > maxVertices)
      fields_.fail(ErrorKind::unsupported, fmt::format("has more than {} vertices", maxVertices));
    Extrusion extrusion;
    extrusion.beginCap = extrusion.endCap = false;
    extrusion.crossSection.clear();
    for (const Vec3d& point : ring.points)
      extrusion.crossSection.push_back({point.x, point.y});
    extrusion.spine = spine.points;
    extrude(extrusion, data_, faces_);
    return relative(ring.error + spine.error + reach * tolerance.angle * tolerance.angle / 8, size);
  }

  Curve trajectory3D() const {
    const pugi::xml_node node = source_.resolved(node_.child("NurbsCurve"));
    if (!node)
      fields_.fail(ErrorKind::malformed, "has no NurbsCurve as trajectoryCurve");
    const NurbsFields fields(source_, node);
    return fields.curve(fields.points3D());
  }

  const Source& source_;
  pugi::xml_node node_;
  NurbsFields fields_;
  VertexData& data_;
  Faces& faces_;
};

} // namespace

bool isNurbs(std::string_view element) {
  return element == "NurbsCurve" || element == "NurbsPatchSurface" || element == "NurbsTrimmedSurface" ||
         element == "NurbsSweptSurface" || element == "NurbsSwungSurface";
}

double addNurbs(const Source& source, pugi::xml_node node, VertexData& data, Faces& faces) {
  return NurbsReader(source, node, data, faces).read();
}

} // namespace imgeo::x3d
