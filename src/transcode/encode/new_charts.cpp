#include "transcode/encode/new_charts.h"

#include "base/error.h"
#include "transcode/encode/chip_limits.h"
#include "transcode/encode/pack_rectangles.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <tuple>
#include <unordered_map>

namespace imgeo {

namespace {

using Normal = Vec3<std::int64_t>;

/// A cell whose direction is chosen has an edge of at most so many texels, and of more than half of them; the cell of a
/// chart has eight times that edge.
constexpr double maxCellTexels = 128;
constexpr std::uint32_t chartCellShift = 3;
/// Cells of a triangle have 19 bits along each axis, beside three of the direction and four of the layer.
constexpr std::uint32_t cellBits = 19, minCellShift = 5, directionBits = 3, layerBits = 4;
constexpr std::uint32_t maxLayers = 1u << layerBits;
/// The density is lowered until images of groups have about as many texels as they may, but not to less than this share
/// of the texels.
constexpr double minKeptShare = 1.0 / 3;
/// Triangles of the highest level at most, of which each has a quarter of those below.
constexpr double highestLevelTriangles = 8192;
/// Triangles that are looked at once more after the first layer; they are kept in memory.
constexpr std::size_t maxCoveredTriangles = std::size_t{1} << 22;
/// A triangle has the direction of its cell where the cosine of its normal's angle to it is at least this.
constexpr double minCosine = 0.3;

/// Along the normal, twice the area long.
Normal normalOf(const TexturedTriangle& triangle) {
  const auto& [a, b, c] = triangle.points;
  return cross(Normal(b) - Normal(a), Normal(c) - Normal(a));
}

double areaOf(const Normal& normal) { // twice
  return length(Vec3d(normal));
}

Direction dominant(const Normal& normal) {
  int axis = 0;
  for (int other = 1; other < 3; ++other)
    if (std::abs(normal[other]) > std::abs(normal[axis]))
      axis = other;
  return static_cast<Direction>(2 * axis + (normal[axis] < 0 ? 1 : 0));
}

std::int64_t along(const Normal& normal, Direction direction) {
  return direction % 2 == 0 ? normal[direction / 2] : -normal[direction / 2];
}

std::uint64_t cellOf(const TexturedTriangle& triangle, std::uint32_t shift) {
  const auto& [a, b, c] = triangle.points;
  std::uint64_t cell = 0;
  for (int axis = 0; axis < 3; ++axis)
    cell = cell << cellBits | (a[axis] + b[axis] + c[axis]) / 3 >> shift;
  return cell;
}

/// Which triangle of several at a texel of a chart is drawn there: the one nearest to where the projection looks from.
std::uint64_t rankOf(const TexturedTriangle& triangle, Direction direction, std::uint64_t identity) {
  constexpr std::uint32_t identityBits = 38, depthBits = 64 - identityBits;
  const auto& [a, b, c] = triangle.points;
  const int axis = direction / 2;
  const std::uint64_t depth = std::uint64_t{a[axis]} + b[axis] + c[axis];
  return (direction % 2 == 0 ? depth : (1u << depthBits) - 1 - depth) << identityBits | identity >> depthBits;
}

/// Sums that do not depend on the order, and stay at the largest number.
void addBounded(std::uint64_t& sum, double value) {
  const auto added = static_cast<std::uint64_t>(std::llround(std::min(value, 0x1p62)));
  sum = sum + added < sum ? UINT64_MAX : sum + added;
}

template <typename Row, typename Key> auto rowOf(const std::vector<Row>& rows, std::uint64_t key, Key Row::*of) {
  const auto found = std::ranges::lower_bound(rows, key, {}, of);
  return found != rows.end() && (*found).*of == key ? found : rows.end();
}

} // namespace

/// Finds the charts of a mesh, step by step.
class ChartFinder {
public:
  explicit ChartFinder(const TriangleVisits& triangles) : triangles_(triangles) {}

  std::optional<NewCharts> find(RasterSize source, std::uint32_t groupTriangles, std::uint64_t maxPixels) {
    if (!measure(source))
      return std::nullopt;
    chooseDirections();
    if (!measureProjections(source, groupTriangles) || !divideIntoLayers(maxPixels) || !pack(maxPixels))
      return std::nullopt;
    return std::move(charts_);
  }

private:
  /// The bounds of the triangles of a chart, as its projection sees them.
  struct Bounds {
    std::uint32_t left = UINT32_MAX, top = UINT32_MAX, right = 0, bottom = 0;

    void add(const TexturedTriangle& triangle, Direction direction) {
      for (const Vec3u& point : triangle.points) {
        const Vec2<std::uint32_t> at = projected(point, direction);
        left = std::min(left, at.x), right = std::max(right, at.x);
        top = std::min(top, at.y), bottom = std::max(bottom, at.y);
      }
    }
  };
  using BoundsOfCharts = std::unordered_map<std::uint64_t, Bounds>;

  /// A chart while its texels are counted: from 0, 0 on.
  struct Sheet {
    NewCharts::Chart chart;
    std::size_t first = 0; ///< texel
  };

  static Direction directionOfKey(std::uint64_t key) {
    return static_cast<Direction>(key >> layerBits & ((1u << directionBits) - 1));
  }

  /// Chooses the cells by the areas of all triangles, on the lattice and in the image.
  bool measure(RasterSize source) {
    constexpr double parts = 65536; // of a texel
    std::uint64_t area = 0, texels = 0;
    triangles_([&](const TexturedTriangle& triangle) {
      addBounded(area, areaOf(normalOf(triangle)));
      std::array<Vec2<double>, 3> at;
      for (std::size_t i = 0; i < 3; ++i)
        at[i] = texelOf(triangle.texCoords[i], source.width, source.height);
      addBounded(texels, parts * std::abs((at[1].x - at[0].x) * (at[2].y - at[0].y) -
                                          (at[1].y - at[0].y) * (at[2].x - at[0].x)));
    });
    if (area == 0 || texels == 0)
      return false;
    texelArea_ = static_cast<double>(texels) / parts;
    const double density = std::sqrt(texelArea_ / static_cast<double>(area));
    charts_.cellShift = minCellShift;
    while (charts_.cellShift < 24 && std::ldexp(density, static_cast<int>(charts_.cellShift) + 1) <= maxCellTexels)
      ++charts_.cellShift;
    return true;
  }

  void chooseDirections() {
    std::unordered_map<std::uint64_t, std::array<std::uint64_t, 3>> sums; // modulo 2^64
    triangles_([&](const TexturedTriangle& triangle) {
      ++triangleCount_;
      const Normal normal = normalOf(triangle);
      std::array<std::uint64_t, 3>& sum = sums[cellOf(triangle, charts_.cellShift)];
      for (int axis = 0; axis < 3; ++axis)
        sum[static_cast<std::size_t>(axis)] += static_cast<std::uint64_t>(normal[axis]);
    });
    for (const auto& [cell, sum] : sums) {
      constexpr int halved = 1; // so that the least number has an absolute value
      const auto component = [&](std::size_t axis) { return static_cast<std::int64_t>(sum[axis]) >> halved; };
      charts_.cells.push_back({cell, dominant({component(0), component(1), component(2)})});
    }
    std::ranges::sort(charts_.cells, {}, &NewCharts::Cell::cell);
  }

  /// Chooses the density, so that the charts have as many texels as those of the source, or as many fewer as images of
  /// groups can have.
  bool measureProjections(RasterSize source, std::uint32_t groupTriangles) {
    std::uint64_t area = 0; // twice
    triangles_([&](const TexturedTriangle& triangle) {
      const std::uint64_t key = charts_.keyOf(triangle, 0);
      const Direction direction = directionOfKey(key);
      addBounded(area, static_cast<double>(std::max<std::int64_t>(along(normalOf(triangle), direction), 0)));
      bounds_[key].add(triangle, direction);
    });
    if (area == 0)
      return false;
    const double maxTexels = maxChipShare * source.width * source.height;
    double texels = texelArea_ / 2;
    for (constexpr double step = 0.98; texelsOfChips(texels, groupTriangles) > maxTexels; texels *= step)
      if (texels < minKeptShare * texelArea_ / 2)
        return false;
    density_ = std::sqrt(2 * texels / static_cast<double>(area));
    return true;
  }

  /// About how many texels the images of groups have on all levels, where the charts have so many together.
  double texelsOfChips(double texels, std::uint32_t groupTriangles) const {
    // As measured on reliefs: rectangles around pieces of charts, in an image, have so many times their texels, and a
    // group whose charts continue in others has at least so many pieces.
    constexpr double ofPieces = 1.3, ofImages = 1.2, minPieces = 4;
    constexpr double gutters = 2 * chipGutter + chipGutter / 2.0; // of both sides, and what is aligned
    const auto charts = static_cast<double>(bounds_.size());
    double sum = 0;
    for (double triangles = static_cast<double>(triangleCount_);; triangles /= 4, texels /= 4) {
      const double groups = std::max(triangles / groupTriangles, 1.0);
      const double pieces = minPieces + charts / groups, texelsOfGroup = texels / groups;
      sum += ofImages * texels * (ofPieces + 2 * gutters * std::sqrt(ofPieces * pieces / texelsOfGroup));
      if (triangles <= std::min<double>(groupTriangles, highestLevelTriangles))
        return sum;
    }
  }

  /// Moves triangles that would be covered by others of their chart to further charts of the same cell and direction.
  bool divideIntoLayers(std::uint64_t maxPixels) {
    std::vector<TexturedTriangle> covered;
    std::map<std::uint64_t, std::uint32_t> layers;
    std::uint64_t pixels = 0;
    for (std::uint32_t layer = 0; layer == 0 || !covered.empty(); ++layer) {
      if (layer == maxLayers)
        return false;
      if (layer > 0) {
        bounds_.clear();
        for (const TexturedTriangle& triangle : covered) {
          const std::uint64_t key = charts_.keyOf(triangle, layer);
          bounds_[key].add(triangle, directionOfKey(key));
          layers[identityOf(triangle)] = layer;
        }
      }
      if (!laySheets(maxPixels, pixels))
        return false;
      const std::optional<std::vector<TexturedTriangle>> next =
          layer == 0 ? coveredOf(triangles_, 0)
                     : coveredOf([&](const auto& visit) { std::ranges::for_each(covered, visit); }, layer);
      if (!next)
        return false;
      for (const auto& [key, sheet] : sheets_)
        charts_.charts.push_back(sheet.chart);
      covered = *next;
    }
    for (const auto& [triangle, layer] : layers)
      charts_.layers.push_back({triangle, layer});
    return true;
  }

  static bool fits(std::uint64_t pixels, std::uint64_t maxPixels) {
    if (pixels > maxPixels && maxPixels < maxAtlasPixels)
      throw Error(ErrorKind::limit, "its new charts", fmt::format("have {} pixels, more than {}", pixels, maxPixels));
    return pixels <= maxPixels;
  }

  bool laySheets(std::uint64_t maxPixels, std::uint64_t& pixels) {
    sheets_.clear();
    std::size_t texels = 0;
    for (const auto& [key, bounds] : bounds_) {
      const double left = std::floor(bounds.left * density_), top = std::floor(bounds.top * density_);
      const double width = std::max(std::ceil(bounds.right * density_) - left, 1.0),
                   height = std::max(std::ceil(bounds.bottom * density_) - top, 1.0);
      if (std::max(width, height) > maxRasterEdge)
        return false;
      Sheet& sheet = sheets_[key];
      sheet.chart = {key,
                     {0, 0, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)},
                     {directionOfKey(key), density_, -left, -top}};
      sheet.first = texels;
      texels += std::size_t{sheet.chart.rect.width} * sheet.chart.rect.height;
    }
    pixels += texels;
    if (!fits(pixels, maxPixels))
      return false;
    owners_.assign(texels, 0);
    return true;
  }

  /// The triangles of a layer of whose texels another has some. Nothing where there are too many.
  std::optional<std::vector<TexturedTriangle>> coveredOf(const TriangleVisits& triangles, std::uint32_t layer) {
    const auto forTexels = [&](const TexturedTriangle& triangle, const auto& visit) {
      const Sheet& sheet = sheets_.at(charts_.keyOf(triangle, layer));
      const NewCharts::Chart& chart = sheet.chart;
      const std::uint64_t rank = rankOf(triangle, chart.projection.direction, identityOf(triangle));
      ChartTriangle(triangle, chart.projection, chart.rect).visitInside([&](std::uint32_t x, std::uint32_t y) {
        visit(owners_[sheet.first + std::size_t{y} * chart.rect.width + x], rank);
      });
    };
    triangles([&](const TexturedTriangle& triangle) {
      forTexels(triangle, [](std::uint64_t& owner, std::uint64_t rank) { owner = std::max(owner, rank); });
    });
    std::vector<TexturedTriangle> covered;
    bool areTooMany = false;
    triangles([&](const TexturedTriangle& triangle) {
      bool isCovered = false;
      forTexels(triangle, [&](std::uint64_t owner, std::uint64_t rank) { isCovered |= owner != rank; });
      areTooMany |= isCovered && covered.size() == maxCoveredTriangles;
      if (isCovered && !areTooMany)
        covered.push_back(triangle);
    });
    return areTooMany ? std::nullopt : std::optional(std::move(covered));
  }

  bool pack(std::uint64_t maxPixels) {
    std::ranges::sort(charts_.charts, {}, &NewCharts::Chart::key);
    std::vector<RasterSize> sizes;
    for (const NewCharts::Chart& chart : charts_.charts)
      sizes.push_back({chart.rect.width, chart.rect.height});
    const std::optional<PackedRectangles> packed = packRectangles(sizes, maxRasterEdge);
    if (!packed || !fits(std::uint64_t{packed->size.width} * packed->size.height, maxPixels))
      return false;
    charts_.size = packed->size;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      NewCharts::Chart& chart = charts_.charts[i];
      std::tie(chart.rect.left, chart.rect.top) = packed->corners[i];
      chart.projection.x += chart.rect.left, chart.projection.y += chart.rect.top;
    }
    return true;
  }

  const TriangleVisits& triangles_;
  NewCharts charts_;
  std::uint64_t triangleCount_ = 0;
  double texelArea_ = 0, density_ = 0; ///< twice the texels of the source's charts; texels of a lattice step
  BoundsOfCharts bounds_;
  std::unordered_map<std::uint64_t, Sheet> sheets_;
  std::vector<std::uint64_t> owners_; ///< by texel of all sheets: the rank of the triangle that is drawn
};

std::optional<NewCharts> NewCharts::of(const TriangleVisits& triangles, RasterSize source, std::uint32_t groupTriangles,
                                       std::uint64_t maxPixels) {
  return ChartFinder(triangles).find(source, groupTriangles, maxPixels);
}

Direction NewCharts::directionOf(const TexturedTriangle& triangle) const {
  const Direction ofCell = rowOf(cells, cellOf(triangle, cellShift), &Cell::cell)->direction;
  const Normal normal = normalOf(triangle);
  const double area = areaOf(normal);
  return area == 0 || static_cast<double>(along(normal, ofCell)) >= minCosine * area ? ofCell : dominant(normal);
}

std::uint64_t NewCharts::keyOf(const TexturedTriangle& triangle, std::uint32_t layer) const {
  const std::uint64_t cell = cellOf(triangle, cellShift + chartCellShift);
  return (cell << directionBits | directionOf(triangle)) << layerBits | layer;
}

std::uint32_t NewCharts::chartOf(const TexturedTriangle& triangle) const {
  const auto layer = layers.empty() ? layers.end() : rowOf(layers, identityOf(triangle), &Layer::triangle);
  const std::uint64_t key = keyOf(triangle, layer == layers.end() ? 0 : layer->layer);
  return static_cast<std::uint32_t>(rowOf(charts, key, &Chart::key) - charts.begin());
}

} // namespace imgeo
