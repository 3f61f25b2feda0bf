// NewCharts::of(): finds the charts of a mesh.

#include "transcode/encode/new_charts.h"

#include "base/error.h"
#include "transcode/encode/chart_cells.h"
#include "transcode/encode/chip_limits.h"
#include "transcode/encode/pack_rectangles.h"
#include "transcode/encode/triangle_batches.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>
#include <fmt/format.h>
#include <tuple>
#include <unordered_map>

namespace imgeo {

namespace {

/// A cell whose direction is chosen has an edge of at most so many texels, and of more than half of them.
constexpr double maxCellTexels = 128;
constexpr std::uint32_t minCellShift = 5;
constexpr std::uint32_t maxLayers = 1u << layerBits;
/// The density is lowered until images of groups have about as many texels as they may, but not to less than this share
/// of the texels.
constexpr double minKeptShare = 1.0 / 3;
/// Triangles of the highest level at most, of which each has a quarter of those below.
constexpr double highestLevelTriangles = 8192;
/// Triangles that are looked at once more after the first layer; they are kept in memory.
constexpr std::size_t maxCoveredTriangles = std::size_t{1} << 22;

/// Which triangle of several at a texel of a chart is drawn there: the one nearest to where the projection looks from.
std::uint64_t rankOf(const TexturedTriangle& triangle, Direction direction, std::uint64_t identity) {
  constexpr std::uint32_t identityBits = 38, depthBits = 64 - identityBits;
  const auto& [a, b, c] = triangle.points;
  const int axis = direction / 2;
  const std::uint64_t depth = std::uint64_t{a[axis]} + b[axis] + c[axis];
  return (direction % 2 == 0 ? depth : (1u << depthBits) - 1 - depth) << identityBits | identity >> depthBits;
}

/// Sums that do not depend on the order, and stay at the largest number.
void addBounded(std::uint64_t& sum, std::uint64_t added) {
  sum = sum + added < sum ? UINT64_MAX : sum + added;
}

void addBounded(std::uint64_t& sum, double value) {
  addBounded(sum, static_cast<std::uint64_t>(std::llround(std::min(value, 0x1p62))));
}

/// Raises a number that other threads may raise, too.
void raise(std::uint64_t& number, std::uint64_t to) {
  const std::atomic_ref shared(number);
  std::uint64_t before = shared.load(std::memory_order_relaxed);
  while (before < to && !shared.compare_exchange_weak(before, to, std::memory_order_relaxed)) {
  }
}

} // namespace

/// Finds the charts of a mesh, step by step.
class ChartFinder {
public:
  ChartFinder(const TriangleVisits& triangles, std::uint64_t maxBytes) : triangles_(triangles), maxBytes_(maxBytes) {}

  std::optional<NewCharts> find(RasterSize source, std::uint32_t groupTriangles) {
    if (!measure(source))
      return std::nullopt;
    chooseDirections();
    if (!measureProjections(source, groupTriangles) || !divideIntoLayers() || !pack())
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
        add({at.x, at.y, at.x, at.y});
      }
    }
    void add(const Bounds& other) {
      left = std::min(left, other.left), right = std::max(right, other.right);
      top = std::min(top, other.top), bottom = std::max(bottom, other.bottom);
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
    struct Areas {
      std::uint64_t count = 0, surface = 0, texels = 0;
    } sums;
    addTriangles(
        triangles_, sums,
        [&](Areas& part, const TexturedTriangle& triangle) {
          ++part.count;
          addBounded(part.surface, areaOf(normalOf(triangle)));
          std::array<Vec2<double>, 3> at;
          for (std::size_t i = 0; i < 3; ++i)
            at[i] = texelOf(triangle.texCoords[i], source.width, source.height);
          addBounded(part.texels, parts * std::abs((at[1].x - at[0].x) * (at[2].y - at[0].y) -
                                                   (at[1].y - at[0].y) * (at[2].x - at[0].x)));
        },
        [](Areas& sum, const Areas& part) {
          sum.count += part.count;
          addBounded(sum.surface, part.surface), addBounded(sum.texels, part.texels);
        });
    if (sums.surface == 0 || sums.texels == 0)
      return false;
    triangleCount_ = sums.count;
    texelArea_ = static_cast<double>(sums.texels) / parts;
    const double density = std::sqrt(texelArea_ / static_cast<double>(sums.surface));
    charts_.cellShift = minCellShift;
    while (charts_.cellShift < 24 && std::ldexp(density, static_cast<int>(charts_.cellShift) + 1) <= maxCellTexels)
      ++charts_.cellShift;
    return true;
  }

  void chooseDirections() {
    using Sum = std::array<std::uint64_t, 3>; // modulo 2^64
    using SumsOfCells = std::unordered_map<std::uint64_t, Sum>;
    SumsOfCells sums;
    const auto add = [](Sum& sum, const Sum& added) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        sum[axis] += added[axis];
    };
    addTriangles(
        triangles_, sums,
        [&](SumsOfCells& part, const TexturedTriangle& triangle) {
          const Normal normal = normalOf(triangle);
          const auto component = [&](int axis) { return static_cast<std::uint64_t>(normal[axis]); };
          add(part[cellOf(triangle, charts_.cellShift)], {component(0), component(1), component(2)});
        },
        [&](SumsOfCells& all, const SumsOfCells& part) {
          for (const auto& [cell, sum] : part)
            add(all[cell], sum);
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
    struct Projections {
      std::uint64_t area = 0; ///< twice
      BoundsOfCharts bounds;
    } all;
    addTriangles(
        triangles_, all,
        [&](Projections& part, const TexturedTriangle& triangle) {
          const std::uint64_t key = charts_.keyOf(triangle, 0);
          const Direction direction = directionOfKey(key);
          addBounded(part.area, static_cast<double>(std::max<std::int64_t>(along(normalOf(triangle), direction), 0)));
          part.bounds[key].add(triangle, direction);
        },
        [](Projections& sum, const Projections& part) {
          addBounded(sum.area, part.area);
          for (const auto& [key, bounds] : part.bounds)
            sum.bounds[key].add(bounds);
        });
    if (all.area == 0)
      return false;
    bounds_ = std::move(all.bounds);
    const double maxTexels = maxChipShare * source.width * source.height;
    double texels = texelArea_ / 2;
    for (constexpr double step = 0.98; texelsOfChips(texels, groupTriangles) > maxTexels; texels *= step)
      if (texels < minKeptShare * texelArea_ / 2)
        return false;
    density_ = std::sqrt(2 * texels / static_cast<double>(all.area));
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
  bool divideIntoLayers() {
    std::deque<TexturedTriangle> covered; // by others of the layers so far
    std::uint64_t pixels = 0;
    for (std::uint32_t layer = 0; layer == 0 || !covered.empty(); ++layer) {
      if (layer == maxLayers)
        return false;
      if (layer > 0) {
        bounds_.clear();
        for (const TexturedTriangle& triangle : covered) {
          const std::uint64_t key = charts_.keyOf(triangle, layer);
          bounds_[key].add(triangle, directionOfKey(key));
        }
      }
      if (!laySheets(covered.size(), pixels))
        return false;
      if (layer > 0)
        keepCovered(covered, layer);
      else if (!findCovered(covered))
        return false;
      for (const auto& [key, sheet] : sheets_)
        charts_.charts.push_back(sheet.chart);
    }
    std::ranges::sort(charts_.layers, [](const NewCharts::Layer& a, const NewCharts::Layer& b) {
      return std::tie(a.triangle, b.layer) < std::tie(b.triangle, a.layer);
    });
    const auto doubled = std::ranges::unique(charts_.layers, {}, &NewCharts::Layer::triangle);
    charts_.layers.erase(doubled.begin(), doubled.end());
    return true;
  }

  /// The covered triangles of all. False where there are too many.
  bool findCovered(std::deque<TexturedTriangle>& covered) {
    const std::uint64_t limit = std::min<std::uint64_t>(
        maxCoveredTriangles, (maxBytes_ - owners_.size() * sizeof(owners_[0])) / NewCharts::bytesOfCoveredTriangle);
    std::uint64_t count = 0;
    visitCovered(triangles_, 0, [&](const TexturedTriangle& triangle, bool isCovered) {
      if (isCovered && ++count <= limit)
        covered.push_back(triangle);
    });
    if (count > maxCoveredTriangles)
      return false;
    requireMemory(owners_.size() * sizeof(owners_[0]) + count * NewCharts::bytesOfCoveredTriangle);
    charts_.layers.reserve(count);
    return true;
  }

  /// Notes the layer of those that are no longer covered.
  void keepCovered(std::deque<TexturedTriangle>& covered, std::uint32_t layer) {
    std::size_t kept = 0;
    const auto visits = [&](const auto& visit) { std::ranges::for_each(covered, visit); };
    visitCovered(visits, layer, [&](const TexturedTriangle& triangle, bool isCovered) {
      if (isCovered)
        covered[kept++] = triangle; // read before
      else
        charts_.layers.push_back({identityOf(triangle), layer});
    });
    covered.resize(kept);
  }

  void requireMemory(std::uint64_t bytes) const {
    if (bytes > maxBytes_)
      throw Error(ErrorKind::limit, "its new charts", fmt::format("take {} bytes, more than {}", bytes, maxBytes_));
  }

  bool laySheets(std::uint64_t coveredTriangles, std::uint64_t& pixels) {
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
    if (pixels > maxAtlasPixels)
      return false;
    requireMemory(texels * sizeof(owners_[0]) + coveredTriangles * NewCharts::bytesOfCoveredTriangle);
    owners_.assign(texels, 0);
    return true;
  }

  /// Calls visit(triangle, isCovered) for the triangles of a layer, in their order: whether another has a texel of it.
  template <typename Visit>
  void visitCovered(const TriangleVisits& triangles, std::uint32_t layer, const Visit& visit) {
    const auto forTexels = [&](const TexturedTriangle& triangle, const auto& visitTexel) {
      const Sheet& sheet = sheets_.at(charts_.keyOf(triangle, layer));
      const NewCharts::Chart& chart = sheet.chart;
      const std::uint64_t rank = rankOf(triangle, chart.projection.direction, identityOf(triangle));
      ChartTriangle(triangle, chart.projection, chart.rect).visitInside([&](std::uint32_t x, std::uint32_t y) {
        visitTexel(owners_[sheet.first + std::size_t{y} * chart.rect.width + x], rank);
      });
    };
    visitBatches(triangles, [&](TriangleBatch batch) {
      parallelForBlocks(batch.size(), [&](std::size_t begin, std::size_t end) {
        for (const TexturedTriangle& triangle : batch.subspan(begin, end - begin))
          forTexels(triangle, raise);
      });
    });
    std::vector<std::uint8_t> isCovered;
    visitBatches(triangles, [&](TriangleBatch batch) {
      isCovered.assign(batch.size(), 0);
      parallelForBlocks(batch.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          forTexels(batch[i], [&](std::uint64_t owner, std::uint64_t rank) {
            if (owner != rank)
              isCovered[i] = 1;
          });
      });
      for (std::size_t i = 0; i < batch.size(); ++i)
        visit(batch[i], isCovered[i] != 0);
    });
  }

  bool pack() {
    std::ranges::sort(charts_.charts, {}, &NewCharts::Chart::key);
    std::vector<RasterSize> sizes;
    for (const NewCharts::Chart& chart : charts_.charts)
      sizes.push_back({chart.rect.width, chart.rect.height});
    const std::optional<PackedRectangles> packed = packRectangles(sizes, maxRasterEdge);
    if (!packed || std::uint64_t{packed->size.width} * packed->size.height > maxAtlasPixels)
      return false;
    charts_.size = packed->size;
    requireMemory(std::uint64_t{packed->size.width} * packed->size.height * NewCharts::bytesOfResampledPixel +
                  charts_.layers.size() * sizeof(charts_.layers[0]));
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      NewCharts::Chart& chart = charts_.charts[i];
      std::tie(chart.rect.left, chart.rect.top) = packed->corners[i];
      chart.projection.x += chart.rect.left, chart.projection.y += chart.rect.top;
    }
    return true;
  }

  const TriangleVisits& triangles_;
  const std::uint64_t maxBytes_;
  NewCharts charts_;
  std::uint64_t triangleCount_ = 0;
  double texelArea_ = 0, density_ = 0; ///< twice the texels of the source's charts; texels of a lattice step
  BoundsOfCharts bounds_;
  std::unordered_map<std::uint64_t, Sheet> sheets_;
  std::vector<std::uint64_t> owners_; ///< by texel of all sheets: the rank of the triangle that is drawn
};

std::optional<NewCharts> NewCharts::of(const TriangleVisits& triangles, RasterSize source, std::uint32_t groupTriangles,
                                       std::uint64_t maxBytes) {
  return ChartFinder(triangles, maxBytes).find(source, groupTriangles);
}

} // namespace imgeo
