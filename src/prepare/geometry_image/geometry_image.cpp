#include "prepare/geometry_image/geometry_image.h"

#include "base/error.h"
#include "base/parallel.h"
#include "prepare/geometry_image/seam_curves.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace imgeo {

namespace {

/// A point of the mesh: a triangle and barycentric coordinates.
struct SurfacePoint {
  std::uint32_t triangle = 0;
  Vec3d weights;
};

/// Interpolates the attributes of a mesh.
class AttributeSampler {
public:
  AttributeSampler(const Mesh& mesh, VertexAttributes& target) : mesh_(mesh), target_(target) {
    target_.texCoordMappings = mesh.texCoordMappings;
    target_.colorComponents = mesh.colorComponents;
    for (const NamedAttribute& attribute : mesh.namedAttributes)
      target_.namedAttributes.push_back({attribute.name, attribute.components, {}});
  }

  void add(const SurfacePoint& point) {
    const std::uint32_t* wedges = &mesh_.corners[std::size_t{3} * point.triangle];
    const auto mix = [&](auto valueOf) {
      return valueOf(wedges[0]) * point.weights.x + valueOf(wedges[1]) * point.weights.y +
             valueOf(wedges[2]) * point.weights.z;
    };
    if (!mesh_.normals.empty())
      addNormal(mix([&](std::uint32_t w) { return Vec3d(mesh_.normals[w]); }), wedges[0]);
    for (std::size_t set = 0; set < texCoordSetCount(mesh_); ++set) {
      const std::vector<Vec2f>& values = texCoordsOf(mesh_, set);
      texCoordsOf(target_, set)
          .push_back({static_cast<float>(mix([&](std::uint32_t w) { return double{values[w].x}; })),
                      static_cast<float>(mix([&](std::uint32_t w) { return double{values[w].y}; }))});
    }
    if (!mesh_.colors.empty()) {
      const auto channel = [&](float Rgba::*c) {
        return channelOf(mix([&](std::uint32_t w) { return double{mesh_.colors[w].*c}; }));
      };
      target_.colors.emplace_back(channel(&Rgba::r), channel(&Rgba::g), channel(&Rgba::b), channel(&Rgba::a));
    }
    for (std::size_t a = 0; a < mesh_.namedAttributes.size(); ++a) {
      const NamedAttribute& attribute = mesh_.namedAttributes[a];
      for (std::uint32_t c = 0; c < attribute.components; ++c)
        target_.namedAttributes[a].values.push_back(static_cast<float>(
            mix([&](std::uint32_t w) { return double{attribute.values[std::size_t{w} * attribute.components + c]}; })));
    }
  }

private:
  void addNormal(Vec3d sum, std::uint32_t wedge) {
    const double size = length(sum);
    target_.normals.push_back(size > 1e-6 ? Vec3f(sum * (1 / size)) : mesh_.normals[wedge]);
  }

  const Mesh& mesh_;
  VertexAttributes& target_;
};

/// Barycentric coordinates of a point of the plane in a triangle of a disk.
Vec3d barycentric(const DiskMesh& disk, const std::vector<Vec2d>& points, std::uint32_t triangle, Vec2d at) {
  const Vec2d &p = points[disk.corners[std::size_t{3} * triangle]], &q = points[disk.corners[3 * triangle + 1]],
              &r = points[disk.corners[3 * triangle + 2]];
  const auto doubled = [](Vec2d a, Vec2d b, Vec2d c) { return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y); };
  const double area = doubled(p, q, r);
  if (area == 0)
    return {-1, -1, -1};
  const double a = doubled(at, q, r) / area, b = doubled(p, at, r) / area;
  return {a, b, 1 - a - b};
}

/// For each texel inside of the border the triangle of the disk that covers its vertex.
class TexelTriangles {
public:
  static constexpr std::uint32_t none = noHalfEdge;

  TexelTriangles(const DiskMesh& disk, const std::vector<Vec2d>& points, GridSize size)
      : disk_(disk), points_(points), size_(size), triangles_(std::size_t{size.columns} * size.rows, none) {
    for (std::uint32_t t = 0; t < disk.triangleCount(); ++t)
      cover(t);
    fillGaps();
  }

  SurfacePoint operator()(std::uint32_t column, std::uint32_t row, const Chart& chart) const {
    const std::uint32_t triangle = triangles_[std::size_t{row} * size_.columns + column];
    Vec3d in = barycentric(disk_, points_, triangle, {double(column), double(row)});
    in = {std::max(in.x, 0.0), std::max(in.y, 0.0), std::max(in.z, 0.0)};
    const double sum = in.x + in.y + in.z;
    in = sum > 0 ? in * (1 / sum) : Vec3d{1, 0, 0};
    const std::array<Vec3d, 3>& weights = disk_.weights[triangle];
    return {chart.triangles[disk_.triangles[triangle]], weights[0] * in.x + weights[1] * in.y + weights[2] * in.z};
  }

private:
  void cover(std::uint32_t t) {
    Vec2d min{1e300, 1e300}, max{-1e300, -1e300};
    for (std::uint32_t s = 0; s < 3; ++s) {
      const Vec2d& point = points_[disk_.corners[3 * t + s]];
      min = {std::min(min.x, point.x), std::min(min.y, point.y)};
      max = {std::max(max.x, point.x), std::max(max.y, point.y)};
    }
    constexpr double slack = 1e-9;
    const auto first = [](double low) { return static_cast<std::uint32_t>(std::max(1.0, std::ceil(low - slack))); };
    const auto last = [](double high, std::uint32_t count) {
      return static_cast<std::int64_t>(std::min(static_cast<double>(count) - 2, std::floor(high + slack)));
    };
    for (std::int64_t row = first(min.y); row <= last(max.y, size_.rows); ++row)
      for (std::int64_t column = first(min.x); column <= last(max.x, size_.columns); ++column) {
        const Vec3d in = barycentric(disk_, points_, t, {double(column), double(row)});
        if (std::min({in.x, in.y, in.z}) >= -slack)
          triangles_[static_cast<std::size_t>(row) * size_.columns + static_cast<std::size_t>(column)] = t;
      }
  }

  /// Gives texels that no triangle covers, for want of numerical precision, the triangle of a neighbour.
  void fillGaps() {
    const std::size_t columns = size_.columns;
    for (bool isChanged = true; isChanged;) {
      isChanged = false;
      for (std::size_t row = 1; row + 1 < size_.rows; ++row)
        for (std::size_t column = 1; column + 1 < columns; ++column) {
          std::uint32_t& triangle = triangles_[row * columns + column];
          if (triangle != none)
            continue;
          for (const std::size_t neighbour : {row * columns + column - 1, (row - 1) * columns + column,
                                              row * columns + column + 1, (row + 1) * columns + column})
            if (triangle == none && triangles_[neighbour] != none) {
              triangle = triangles_[neighbour];
              isChanged = true;
            }
        }
    }
    std::ranges::replace(triangles_, none, 0u);
  }

  const DiskMesh& disk_;
  const std::vector<Vec2d>& points_;
  GridSize size_;
  std::vector<std::uint32_t> triangles_;
};

/// The points of a chart's vertices on a grid.
std::vector<Vec2d> gridPoints(const ParametrisedChart& chart, const GridBorder& border, GridSize size) {
  const Vec2d cells{double(size.columns - 1), double(size.rows - 1)};
  std::vector<Vec2d> points = chart.embedding.points;
  for (Vec2d& point : points)
    point = {point.x * cells.x, point.y * cells.y};
  if (chart.keepsTexCoords)
    return points;
  std::vector<Vec2d> boundary;
  for (const double distance : border.vertexDistances)
    boundary.push_back(borderPoint(distance, cells));
  return solve(chart.disk, boundary, chart.embedding.weights, points);
}

GeometryImage imageOf(const Mesh& mesh, const ParametrisedChart& chart, const GridBorder& border, GridSize size) {
  const auto [columns, rows] = size;
  const std::vector<Vec2d> points = gridPoints(chart, border, size);
  const TexelTriangles inner(chart.disk, points, size);
  GeometryImage image;
  image.columns = columns;
  image.rows = rows;
  image.positions.reserve(std::size_t{columns} * rows);
  AttributeSampler attributes(mesh, image);
  const auto positionAt = [&](const SurfacePoint& point) {
    const auto corner = [&](std::uint32_t s) {
      return Vec3d(mesh.cornerPosition(std::size_t{3} * point.triangle + s));
    };
    return Vec3f(corner(0) * point.weights.x + corner(1) * point.weights.y + corner(2) * point.weights.z);
  };
  const auto borderIndex = [&](std::uint32_t column, std::uint32_t row) -> std::size_t {
    if (column == 0)
      return row;
    if (row == rows - 1)
      return row + column;
    if (column == columns - 1)
      return std::size_t{rows - 1} + (columns - 1) + (rows - 1 - row);
    return std::size_t{2} * (rows - 1) + (columns - 1) + (columns - 1 - column);
  };
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      if (row > 0 && row < rows - 1 && column > 0 && column < columns - 1) {
        const SurfacePoint point = inner(column, row, chart.chart);
        image.positions.push_back(positionAt(point));
        attributes.add(point);
        continue;
      }
      const BorderTexel& texel = border.texels[borderIndex(column, row)];
      const std::uint32_t halfEdge = chart.boundary[texel.edge];
      SurfacePoint point{chart.chart.triangles[halfEdge / 3], {}};
      point.weights[static_cast<int>(halfEdge % 3)] = 1 - texel.share;
      point.weights[static_cast<int>(nextHalfEdge(halfEdge) % 3)] = texel.share;
      image.positions.push_back(texel.position);
      attributes.add(point);
    }
  return image;
}

/// Columns of grids of several charts are rounded to few different numbers, so that grids share images.
std::uint32_t roundedColumns(double columns) {
  const std::uint32_t step = columns < 24 ? 4 : columns < 64 ? 8 : columns < 256 ? 16 : 64;
  return std::max(static_cast<std::uint32_t>(columns / step + 0.5) * step, 4u);
}

/// `share` is that of the chart in all texels.
GridSize gridSizeOf(const ParametrisedChart& chart, double share, bool isOnly, GridSize smallest,
                    std::uint32_t gridEdge, std::uint32_t maxEdge) {
  if (smallest.columns > maxEdge || smallest.rows > maxEdge)
    throw Error(ErrorKind::limit, "",
                "a chart of the surface meets more charts than a grid of " + std::to_string(maxEdge) +
                    " columns and rows has cells on a side");
  const double texels = share * gridEdge * gridEdge;
  // The only chart, if its author mapped it to a rectangle, gets the stated grid.
  const double aspect = isOnly && chart.keepsTexCoords ? 1 : chart.aspect;
  double columns = std::sqrt(texels * aspect);
  if (!isOnly)
    columns = roundedColumns(columns);
  columns = std::clamp(std::round(columns), double(smallest.columns), double(maxEdge));
  const double rows = std::clamp(std::round(texels / columns), double(smallest.rows), double(maxEdge));
  return {static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows)};
}

} // namespace

std::vector<GeometryImage> geometryImages(const Mesh& mesh, std::span<const ParametrisedChart> charts,
                                          std::uint32_t gridEdge, std::uint32_t maxEdge) {
  assert(gridEdge >= 2);
  const SeamNetwork network = seamNetworkOf(mesh, charts);
  double area = 0;
  for (const ParametrisedChart& chart : charts)
    area += chart.area;
  std::vector<GridSize> sizes;
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const double share = area > 0 ? charts[i].area / area : 1.0 / static_cast<double>(charts.size());
    sizes.push_back(gridSizeOf(charts[i], share, charts.size() == 1, smallestGrid(network.runs[i]), gridEdge, maxEdge));
  }
  const std::vector<GridBorder> borders = gridBorders(mesh, charts, network, sizes);
  std::vector<GeometryImage> images(charts.size());
  parallelFor(charts.size(), [&](std::size_t i) { images[i] = imageOf(mesh, charts[i], borders[i], sizes[i]); });
  return images;
}

} // namespace imgeo
