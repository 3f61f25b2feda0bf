#include "containers/blur.h"

#include "base/narrow.h"
#include "containers/image_file.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace imgeo {

namespace {

/// A row or column of points in an array.
struct PointLine {
  std::size_t first = 0, step = 1, count = 0;
  bool isClosed = false;
};

/// The points of one line, filtered along it.
void filterLine(std::vector<Vec3d>& points, const PointLine& line, std::span<const double> weights) {
  std::vector<Vec3d> before(line.count);
  for (std::size_t i = 0; i < line.count; ++i)
    before[i] = points[line.first + i * line.step];
  for (std::size_t i = 0; i < line.count; ++i) {
    const std::size_t reach =
        line.isClosed ? weights.size() - 1 : std::min({weights.size() - 1, i, line.count - 1 - i});
    Vec3d sum = before[i] * weights[0];
    double total = weights[0];
    for (std::size_t d = 1; d <= reach; ++d) {
      const std::size_t left = (i + line.count - d % line.count) % line.count, right = (i + d) % line.count;
      sum += (before[left] + before[right]) * weights[d];
      total += 2 * weights[d];
    }
    points[line.first + i * line.step] = sum * (1 / total);
  }
}

std::uint32_t columnsOf(const PatchDescription& patch, const GeometryDescription& geometry, const FetchFile& fetch) {
  if (geometry.grid || !patch.index)
    return patch.implicitMeshSize.x;
  return decodeImageFile(fetch(patch.coord[0].url), patch.coord[0].url).width;
}

} // namespace

std::vector<Vec3d> blurred(const PointImage& image, double radius) {
  assert(image.columns > 0);
  std::vector<Vec3d> points = image.points;
  if (!(radius > 0))
    return points;
  std::vector<double> weights;
  for (int d = 0; d <= std::ceil(radius); ++d)
    weights.push_back(std::exp(-2 * d * d / (radius * radius)));
  const std::size_t columns = image.columns, rows = points.size() / columns, rest = points.size() % columns;
  for (std::size_t row = 0; row < rows; ++row)
    filterLine(points, {row * columns, 1, columns, image.isClosed}, weights);
  if (rest > 0)
    filterLine(points, {rows * columns, 1, rest, false}, weights);
  for (std::size_t column = 0; column < columns && rows > 0; ++column)
    filterLine(points, {column, columns, rows, false}, weights);
  return points;
}

std::vector<Vec3d> blurredPoints(const IndexedPatch& decoded, const PatchDescription& patch,
                                 const GeometryDescription& geometry, const FetchFile& fetch) {
  PointImage image;
  image.columns = columnsOf(patch, geometry, fetch);
  image.isClosed = geometry.grid == GridKind::sculpt;
  for (const Vec3u& q : decoded.positions)
    image.points.push_back(geometry.lattice.point(q));
  return blurred(image, blurRadiusOf(geometry.operators));
}

} // namespace imgeo
