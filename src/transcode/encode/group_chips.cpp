#include "transcode/encode/group_chips.h"

#include "transcode/encode/linear_light.h"
#include "transcode/encode/pack_rectangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <utility>

namespace imgeo {

namespace {

using TexelPoint = Vec2<double>;

/// A chip that covers this many times the texels of its triangles is divided, if that saves so much of them.
constexpr double maxRectShare = 1.1, maxDividedShare = 0.95;
constexpr std::size_t minDividedTriangles = 16;
/// It is divided at an end of one of so many parts of its triangles.
constexpr std::size_t dividedParts = 8;

/// Triangles of one chart, and the texels around them.
struct Piece {
  std::uint32_t chart = 0;
  std::vector<std::uint32_t> triangles;
  TexelRect rect; ///< in texels of the level
};

std::uint32_t alignedUp(std::uint32_t edge) {
  return (edge + chipGutter - 1) / chipGutter * chipGutter;
}

/// With its gutter.
RasterSize chipSize(const TexelRect& rect) {
  return {alignedUp(rect.width + 2 * chipGutter), alignedUp(rect.height + 2 * chipGutter)};
}

double chipArea(RasterSize size) {
  return double(size.width) * size.height;
}

/// Cuts the triangles of a group into pieces.
class Pieces {
public:
  Pieces(const Patch& patch, std::size_t set, const ChipSource& source, std::uint32_t level)
      : patch_(patch), set_(set), width_(std::ldexp(source.image.width, -int(level))),
        height_(std::ldexp(source.image.height, -int(level))) {
    points_.reserve(patch.wedgeCount());
    for (std::uint32_t wedge = 0; wedge < patch.wedgeCount(); ++wedge)
      points_.push_back(pointOf(wedge, source));
  }

  std::vector<Piece> take() {
    std::map<std::uint32_t, std::vector<std::uint32_t>> byChart;
    for (std::uint32_t triangle = 0; triangle < patch_.elementCount(); ++triangle)
      byChart[chartOf(triangle)].push_back(triangle);
    for (auto& [chart, triangles] : byChart)
      add({chart, std::move(triangles), {}});
    return std::move(pieces_);
  }

  /// In texels of the level.
  TexelPoint at(std::uint32_t wedge) const { return points_[wedge]; }

  double texelArea(std::uint32_t triangle) const {
    const auto [a, b, c] = pointsOf(triangle);
    return std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
  }

private:
  std::array<TexelPoint, 3> pointsOf(std::uint32_t triangle) const {
    const std::uint32_t* const corners = &patch_.corners[3 * std::size_t{triangle}];
    return {at(corners[0]), at(corners[1]), at(corners[2])};
  }

  TexelPoint pointOf(std::uint32_t wedge, const ChipSource& source) const {
    if (source.projections.empty())
      return texelOf(patch_.texCoords[wedge], width_, height_);
    const TexelPoint whole =
        source.projections[chartOfWedge(wedge)].texelOf(patch_.positions[patch_.wedgePositions[wedge]]);
    const double columns = source.image.width, rows = source.image.height;
    return {std::clamp(whole.x, 0.0, columns) / columns * width_, std::clamp(whole.y, 0.0, rows) / rows * height_};
  }
  std::uint32_t chartOfWedge(std::uint32_t wedge) const {
    return static_cast<std::uint32_t>(texCoordsOf(patch_, set_)[wedge].x);
  }
  std::uint32_t chartOf(std::uint32_t triangle) const {
    return chartOfWedge(patch_.corners[3 * std::size_t{triangle}]);
  }

  TexelRect rectOf(std::span<const std::uint32_t> triangles) const {
    double left = width_, top = height_, right = 0, bottom = 0;
    for (const std::uint32_t triangle : triangles)
      for (const TexelPoint& point : pointsOf(triangle)) {
        left = std::min(left, point.x), right = std::max(right, point.x);
        top = std::min(top, point.y), bottom = std::max(bottom, point.y);
      }
    const auto span = [](double low, double high, double count) {
      const double first = std::clamp(std::floor(low), 0.0, std::ceil(count) - 1);
      const double end = std::clamp(std::ceil(high), first + 1, std::ceil(count));
      return std::pair(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end - first));
    };
    const auto [x, width] = span(left, right, width_);
    const auto [y, height] = span(top, bottom, height_);
    return {x, y, width, height};
  }

  void add(Piece piece) {
    piece.rect = rectOf(piece.triangles);
    if (!divide(piece))
      pieces_.push_back(std::move(piece));
  }

  /// Divides a piece that leaves much of its rectangle empty, where that saves most.
  bool divide(const Piece& piece) {
    if (piece.triangles.size() < minDividedTriangles)
      return false;
    double covered = 0;
    for (const std::uint32_t triangle : piece.triangles)
      covered += texelArea(triangle);
    const double area = chipArea(chipSize(piece.rect));
    if (area <= maxRectShare * covered)
      return false;
    double smallest = maxDividedShare * area;
    std::vector<std::uint32_t> low, high;
    for (double TexelPoint::*const axis : {&TexelPoint::x, &TexelPoint::y}) {
      std::vector<std::pair<double, std::uint32_t>> keys; // centres
      for (const std::uint32_t triangle : piece.triangles) {
        const auto [a, b, c] = pointsOf(triangle);
        keys.emplace_back(a.*axis + b.*axis + c.*axis, triangle);
      }
      std::ranges::sort(keys);
      std::vector<std::uint32_t> sorted;
      std::ranges::transform(keys, std::back_inserter(sorted), [](const auto& key) { return key.second; });
      for (std::size_t part = 1; part < dividedParts; ++part) {
        const std::span all(sorted);
        const std::size_t middle = sorted.size() * part / dividedParts;
        const double divided =
            chipArea(chipSize(rectOf(all.first(middle)))) + chipArea(chipSize(rectOf(all.subspan(middle))));
        if (divided > smallest)
          continue;
        smallest = divided;
        low.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(middle));
        high.assign(all.begin() + static_cast<std::ptrdiff_t>(middle), all.end());
      }
    }
    if (low.empty())
      return false;
    add({piece.chart, std::move(low), {}});
    add({piece.chart, std::move(high), {}});
    return true;
  }

  const Patch& patch_;
  std::size_t set_;
  double width_, height_;          ///< of the source in texels of the level
  std::vector<TexelPoint> points_; ///< by wedge, in texels of the level
  std::vector<Piece> pieces_;
};

/// Draws the chips of a group.
class ChipImage {
public:
  ChipImage(RasterSize size, std::uint32_t level, const ChipSource& source) : level_(level), source_(source) {
    image_.width = size.width, image_.height = size.height;
    image_.pixels.resize(std::size_t{4} * size.width * size.height);
    for (std::size_t alpha = 3; alpha < image_.pixels.size(); alpha += 4)
      image_.pixels[alpha] = 255;
  }

  /// Draws a piece into the rectangle of its chip, whose first pixel is at (column, row).
  void draw(const Piece& piece, std::uint32_t column, std::uint32_t row) {
    const RasterSize size = chipSize(piece.rect);
    isDrawn_.assign(std::size_t{size.width} * size.height, false);
    const ChartMask& chart = source_.charts[piece.chart];
    if (!drawTexels(piece.rect, size.width, column, row, [&](auto x, auto y) { return chart.has(x, y); })) {
      if (source_.projections.empty())
        drawTexels(piece.rect, size.width, column, row, [](auto, auto) { return true; });
      else
        drawNearest(piece, size.width, column, row);
    }
    fillOutwards(size, column, row);
  }

  Raster take() { return std::move(image_); }

private:
  std::uint8_t* pixel(std::uint32_t x, std::uint32_t y) {
    return &image_.pixels[4 * (std::size_t{y} * image_.width + x)];
  }

  /// Returns whether there is a texel that `isCovered` has.
  template <typename IsCovered>
  bool drawTexels(const TexelRect& rect, std::uint32_t chipWidth, std::uint32_t column, std::uint32_t row,
                  IsCovered isCovered) {
    bool isAny = false;
    for (std::uint32_t y = 0; y < rect.height; ++y)
      for (std::uint32_t x = 0; x < rect.width; ++x) {
        if (!drawTexel(rect.left + x, rect.top + y, pixel(column + chipGutter + x, row + chipGutter + y), isCovered))
          continue;
        isDrawn_[std::size_t{y + chipGutter} * chipWidth + chipGutter + x] = true;
        isAny = true;
      }
    return isAny;
  }

  /// Draws the texel in the middle of a piece that is beside its chart, with the nearest that the chart covers.
  void drawNearest(const Piece& piece, std::uint32_t chipWidth, std::uint32_t column, std::uint32_t row) {
    const ChartMask& chart = source_.charts[piece.chart];
    const double edge = std::ldexp(1, int(level_));
    const TexelPoint middle{(piece.rect.left + piece.rect.width / 2.0) * edge,
                            (piece.rect.top + piece.rect.height / 2.0) * edge};
    double smallest = std::numeric_limits<double>::infinity();
    const std::uint8_t* nearest = nullptr;
    for (std::uint32_t y = chart.rect().top; y < chart.rect().top + chart.rect().height; ++y)
      for (std::uint32_t x = chart.rect().left; x < chart.rect().left + chart.rect().width; ++x)
        if (const double distance = std::hypot(x + 0.5 - middle.x, y + 0.5 - middle.y);
            distance < smallest && chart.has(x, y)) {
          smallest = distance;
          nearest = &source_.image.pixels[4 * (std::size_t{y} * source_.image.width + x)];
        }
    if (!nearest)
      return;
    const std::uint32_t x = chipGutter + piece.rect.width / 2, y = chipGutter + piece.rect.height / 2;
    std::copy_n(nearest, 4, pixel(column + x, row + y));
    isDrawn_[std::size_t{y} * chipWidth + x] = true;
  }

  /// Sets the mean of the covered texels of the source that a texel of the level stands for, if there are any.
  template <typename IsCovered>
  bool drawTexel(std::uint32_t x, std::uint32_t y, std::uint8_t* pixel, IsCovered isCovered) const {
    const Raster& from = source_.image;
    const std::uint32_t edge = 1u << level_;
    const std::uint32_t right = std::min((x + 1) * edge, from.width), bottom = std::min((y + 1) * edge, from.height);
    PixelSum sum;
    const std::uint8_t* last = nullptr;
    for (std::uint32_t v = y * edge; v < bottom; ++v)
      for (std::uint32_t u = x * edge; u < right; ++u)
        if (isCovered(u, v)) {
          last = &from.pixels[4 * (std::size_t{v} * from.width + u)];
          sum.add(last);
        }
    if (sum.weight == 1)
      std::copy_n(last, 4, pixel);
    else if (sum.weight > 1)
      sum.storeMean(pixel);
    return sum.weight > 0;
  }

  /// Gives the other texels of a chip the mean of their neighbours that have been drawn, from the nearest on.
  void fillOutwards(RasterSize size, std::uint32_t column, std::uint32_t row) {
    using Texel = std::pair<std::uint32_t, std::uint32_t>;
    const auto forNeighbours = [&](Texel at, const auto& visit) {
      for (const auto& [dx, dy] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}}) {
        const std::uint32_t x = at.first + static_cast<std::uint32_t>(dx),
                            y = at.second + static_cast<std::uint32_t>(dy);
        if (x < size.width && y < size.height) // also where a sum has wrapped
          visit(Texel{x, y});
      }
    };
    const auto index = [&](Texel at) { return std::size_t{at.second} * size.width + at.first; };
    std::vector<Texel> front;
    for (std::uint32_t y = 0; y < size.height; ++y)
      for (std::uint32_t x = 0; x < size.width; ++x)
        if (isDrawn_[index({x, y})])
          front.emplace_back(x, y);
    std::vector<bool> isWaiting(isDrawn_.size());
    while (!front.empty()) {
      std::vector<Texel> next;
      for (const Texel& at : front)
        forNeighbours(at, [&](Texel neighbour) {
          if (!isDrawn_[index(neighbour)] && !isWaiting[index(neighbour)]) {
            isWaiting[index(neighbour)] = true;
            next.push_back(neighbour);
          }
        });
      for (const Texel& at : next) {
        PixelSum sum;
        forNeighbours(at, [&](Texel neighbour) {
          if (isDrawn_[index(neighbour)])
            sum.add(pixel(column + neighbour.first, row + neighbour.second));
        });
        sum.storeMean(pixel(column + at.first, row + at.second));
      }
      for (const Texel& at : next)
        isDrawn_[index(at)] = true;
      front = std::move(next);
    }
  }

  std::uint32_t level_;
  const ChipSource& source_;
  Raster image_;
  std::vector<bool> isDrawn_; ///< texels of the chip that is drawn
};

/// Gives each piece wedges of its own, with coordinates in the image of chips.
void rewriteWedges(Patch& patch, std::size_t set, const Pieces& group, const std::vector<Piece>& pieces,
                   const PackedRectangles& packed) {
  constexpr std::uint32_t none = UINT32_MAX;
  std::vector<std::uint32_t> sources, newWedge(patch.wedgeCount(), none);
  std::vector<Vec2f> coords;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto [column, row] = packed.corners[i];
    const std::size_t first = sources.size();
    for (const std::uint32_t triangle : pieces[i].triangles)
      for (std::size_t corner = 3 * std::size_t{triangle}; corner < 3 * std::size_t{triangle} + 3; ++corner) {
        const std::uint32_t wedge = patch.corners[corner];
        if (newWedge[wedge] == none) {
          newWedge[wedge] = static_cast<std::uint32_t>(sources.size());
          sources.push_back(wedge);
          const TexelPoint at = group.at(wedge);
          const double x = at.x - pieces[i].rect.left + chipGutter + column,
                       y = at.y - pieces[i].rect.top + chipGutter + row;
          coords.push_back({static_cast<float>(x / packed.size.width), static_cast<float>(1 - y / packed.size.height)});
        }
        patch.corners[corner] = newWedge[wedge];
      }
    for (std::size_t wedge = first; wedge < sources.size(); ++wedge)
      newWedge[sources[wedge]] = none;
  }
  patch.wedgePositions = gather(patch.wedgePositions, sources);
  static_cast<VertexAttributes&>(patch) = gather(patch, sources);
  texCoordsOf(patch, set) = std::move(coords);
}

std::optional<PackedRectangles> packPieces(const std::vector<Piece>& pieces) {
  std::vector<RasterSize> sizes;
  for (const Piece& piece : pieces)
    sizes.push_back(chipSize(piece.rect));
  return packRectangles(sizes, maxChipEdge);
}

double areaOnLattice(const Patch& patch, std::size_t triangle) {
  const auto at = [&](std::size_t i) {
    return Vec3d(patch.positions[patch.wedgePositions[patch.corners[3 * triangle + i]]]);
  };
  return length(cross(at(1) - at(0), at(2) - at(0))) / 2;
}

} // namespace

std::optional<RasterSize> chipImageSize(const Patch& patch, std::uint32_t level, std::size_t set,
                                        const ChipSource& source) {
  const std::vector<Piece> pieces = Pieces(patch, set, source, level).take();
  const std::optional<PackedRectangles> packed = packPieces(pieces);
  return packed ? std::optional(packed->size) : std::nullopt;
}

std::optional<GroupChips> makeChips(Patch& patch, std::uint32_t level, std::size_t set, const ChipSource& source) {
  Pieces group(patch, set, source, level);
  const std::vector<Piece> pieces = group.take();
  const std::optional<PackedRectangles> packed = packPieces(pieces);
  if (!packed)
    return std::nullopt;
  GroupChips chips;
  double area = 0, texels = 0;
  for (std::uint32_t triangle = 0; triangle < patch.elementCount(); ++triangle) {
    area += areaOnLattice(patch, triangle);
    texels += group.texelArea(triangle);
  }
  chips.texelEdge = texels > 0 ? std::sqrt(area / texels) : 0;
  ChipImage image(packed->size, level, source);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    image.draw(pieces[i], packed->corners[i].first, packed->corners[i].second);
  chips.image = image.take();
  rewriteWedges(patch, set, group, pieces, *packed);
  return chips;
}

} // namespace imgeo
