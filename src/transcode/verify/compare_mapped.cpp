#include "transcode/verify/compare_mapped.h"

#include "base/parallel.h"
#include "containers/read_mesh.h"
#include "containers/stored_coords.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

namespace imgeo {

namespace {

double largestAxis(const Vec3d& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Finds the nearest of many points.
class PointTree {
public:
  explicit PointTree(std::vector<Vec3d> points) : points_(std::move(points)) { build(0, points_.size(), 0); }

  /// The distance to the nearest point along its farthest axis; infinite if there is none within `bound`.
  double distanceFrom(const Vec3d& point, double bound) const {
    double nearest = bound;
    bool isFound = false;
    search(point, 0, points_.size(), 0, nearest, isFound);
    return isFound ? nearest : std::numeric_limits<double>::infinity();
  }

private:
  /// Brings the median along an axis to the middle of a range, and so on in both halves.
  void build(std::size_t begin, std::size_t end, int axis) {
    if (end - begin < 2)
      return;
    const auto at = [&](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(at(begin), at(middle), at(end),
                     [axis](const Vec3d& a, const Vec3d& b) { return a[axis] < b[axis]; });
    build(begin, middle, (axis + 1) % 3);
    build(middle + 1, end, (axis + 1) % 3);
  }

  void search(const Vec3d& point, std::size_t begin, std::size_t end, int axis, double& nearest, bool& isFound) const {
    if (begin == end || (isFound && nearest == 0))
      return;
    const std::size_t middle = begin + (end - begin) / 2;
    if (const double distance = largestAxis(points_[middle] - point); distance <= nearest) {
      nearest = distance;
      isFound = true;
    }
    const double offset = point[axis] - points_[middle][axis];
    const int next = (axis + 1) % 3;
    if (offset <= 0)
      search(point, begin, middle, next, nearest, isFound);
    else
      search(point, middle + 1, end, next, nearest, isFound);
    if (std::abs(offset) > nearest)
      return;
    if (offset <= 0)
      search(point, middle + 1, end, next, nearest, isFound);
    else
      search(point, begin, middle, next, nearest, isFound);
  }

  std::vector<Vec3d> points_;
};

std::vector<Vec3d> verticesOf(const Mesh& mesh) {
  std::vector<Vec3d> points;
  points.reserve(mesh.positions.size());
  for (const Vec3f& position : mesh.positions)
    points.push_back(Vec3d(position));
  return points;
}

std::vector<Vec3d> centersOf(const Mesh& mesh) {
  const std::size_t corners = cornersPerElement(mesh.topology);
  std::vector<Vec3d> points;
  points.reserve(mesh.elementCount());
  for (std::size_t element = 0; element < mesh.elementCount(); ++element) {
    Vec3d sum;
    for (std::size_t corner = 0; corner < corners; ++corner)
      sum += Vec3d(mesh.cornerPosition(corners * element + corner));
    points.push_back(sum * (1.0 / static_cast<double>(corners)));
  }
  return points;
}

/// The number of points that are farther than `bound` from all of `others`. Notes the largest distance of the rest.
std::size_t countApart(const std::vector<Vec3d>& points, const PointTree& others, double bound, double& largest) {
  std::vector<double> distances(points.size());
  parallelFor(points.size(), [&](std::size_t i) { distances[i] = others.distanceFrom(points[i], bound); });
  std::size_t apart = 0;
  for (const double distance : distances)
    if (std::isfinite(distance))
      largest = std::max(largest, distance);
    else
      ++apart;
  return apart;
}

/// How far operators may bring points apart that are half a step of the lattice from those of `plain`, the mesh without
/// operators.
double mappedBound(const GeometryDescription& geometry, const Mesh& plain) {
  const OperatorFrame frame = operatorFrameOf(geometry, plain);
  const double half = positionErrorBound(geometry);
  double bound = half;
  for (const Vec3f& position : plain.positions) {
    const Vec3d point(position), reach{half, half, half};
    const Box3d box = operatedBox(geometry.operators, {frame.toUnit(point - reach), frame.toUnit(point + reach)});
    bound = std::max(bound, largestAxis(frame.fromUnit(box.max) - frame.fromUnit(box.min)));
  }
  return bound;
}

} // namespace

void compareMapped(const ContainerReader& reader, const GeometryDescription& geometry, const Mesh& mesh,
                   VerifyReport& report, Findings& findings) {
  GeometryDescription plain = geometry;
  plain.operators.clear();
  const Mesh site = readMesh(reader, geometry, "the site");
  report.input.of(mesh.topology) += mesh.elementCount();
  report.site.of(site.topology) += site.elementCount();
  if (mesh.topology != site.topology || mesh.elementCount() != site.elementCount())
    return findings.add("The site draws {} {}, the input has {} {}.", site.elementCount(), nameOf(site.topology),
                        mesh.elementCount(), nameOf(mesh.topology));
  const Box3d box = boxOf(mesh);
  const double rounding = 8 * std::numeric_limits<float>::epsilon() * (largestAxis(box.min) + largestAxis(box.max)),
               bound = mappedBound(geometry, readMesh(reader, plain, "the site")) + rounding;
  const auto compare = [&](const char* what, const std::vector<Vec3d>& ofSite, const std::vector<Vec3d>& ofInput) {
    double largest = 0;
    const std::size_t extra = countApart(ofSite, PointTree(ofInput), bound, largest),
                      missing = countApart(ofInput, PointTree(ofSite), bound, largest);
    if (extra > 0 || missing > 0)
      findings.add("Operators map {} {} of the site to where the input has none, and none to {} of the input.", extra,
                   what, missing);
    return largest;
  };
  const double error = compare("vertices", verticesOf(site), verticesOf(mesh));
  compare(nameOf(mesh.topology), centersOf(site), centersOf(mesh));
  if (error * report.positionBound >= report.positionError * bound)
    report.positionError = error, report.positionBound = bound;
  visitAttributes(mesh, site, [&](const auto& row, const auto& ofMesh, const auto& ofSite) {
    if (ofMesh.empty() != ofSite.empty())
      findings.add("The {} has {}, the {} has none.", ofMesh.empty() ? "site" : "input", row.plural,
                   ofMesh.empty() ? "input" : "site");
  });
}

} // namespace imgeo
