#include "transcode/encode/rebaked_atlas.h"

#include "transcode/encode/linear_light.h"
#include "transcode/encode/triangle_batches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace imgeo {

namespace {

using Shares = std::array<double, 3>;

/// The colours of a triangle in the source.
class SourceColors {
public:
  SourceColors(const ChipSource& source, const TexturedTriangle& triangle)
      : image_(source.image), chart_(source.charts[triangle.chart]) {
    for (std::size_t i = 0; i < 3; ++i)
      corners_[i] = texelOf(triangle.texCoords[i], image_.width, image_.height);
  }

  /// Where a point of the triangle is in the source, in texels.
  Vec2<double> at(const Shares& shares) const {
    Vec2<double> point{};
    for (std::size_t i = 0; i < 3; ++i)
      point.x += shares[i] * corners_[i].x, point.y += shares[i] * corners_[i].y;
    return point;
  }

  /// Adds the colour between the four texels around a point, of those that the chart covers.
  void add(PixelSum& sum, Vec2<double> point) const {
    const double left = std::floor(point.x - 0.5), top = std::floor(point.y - 0.5);
    const double right = point.x - 0.5 - left, below = point.y - 0.5 - top;
    for (const auto& [x, y, weight] : {std::tuple(left, top, (1 - right) * (1 - below)),
                                       {left + 1, top, right * (1 - below)},
                                       {left, top + 1, (1 - right) * below},
                                       {left + 1, top + 1, right * below}})
      if (weight > 0 && x >= 0 && y >= 0 && x < image_.width && y < image_.height &&
          chart_.has(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)))
        sum.add(pixel(x, y), weight);
  }

  /// The texel that has a point.
  const std::uint8_t* nearest(Vec2<double> point) const {
    return pixel(std::clamp(std::floor(point.x), 0.0, image_.width - 1.0),
                 std::clamp(std::floor(point.y), 0.0, image_.height - 1.0));
  }

private:
  const std::uint8_t* pixel(double x, double y) const {
    return &image_.pixels[4 * (static_cast<std::size_t>(y) * image_.width + static_cast<std::size_t>(x))];
  }

  const Raster& image_;
  const ChartMask& chart_;
  std::array<Vec2<double>, 3> corners_;
};

/// Draws triangles, a batch of them at a time: bands of rows in parallel, in each the triangles in their order.
class AtlasPainter {
public:
  AtlasPainter(const NewCharts& charts, const ChipSource& source)
      : charts_(charts), source_(source), bands_((charts.size.height + bandRows - 1) / bandRows) {
    image_.width = charts.size.width, image_.height = charts.size.height;
    image_.pixels.resize(std::size_t{4} * image_.width * image_.height);
    texels_.resize(std::size_t{image_.width} * image_.height);
  }

  /// Draws the texels whose centres are inside.
  void addInside(TriangleBatch batch) {
    draw(batch, [&](const TexturedTriangle& triangle, const ChartTriangle& inChart) { drawInside(triangle, inChart); });
  }

  /// Draws texels that triangles touch and whose centres are in none of their chart: when all have been added as
  /// inside.
  void addTouched(TriangleBatch batch) {
    draw(batch,
         [&](const TexturedTriangle& triangle, const ChartTriangle& inChart) { drawTouched(triangle, inChart); });
  }

  ChipSource take() {
    ChipSource atlas;
    for (const NewCharts::Chart& chart : charts_.charts)
      atlas.charts.emplace_back(chart.rect), atlas.projections.push_back(chart.projection);
    parallelFor(atlas.charts.size(), [&](std::size_t chart) {
      const TexelRect& rect = charts_.charts[chart].rect;
      for (std::uint32_t y = rect.top; y < rect.top + rect.height; ++y)
        for (std::uint32_t x = rect.left; x < rect.left + rect.width; ++x)
          if (texelAt(x, y).distance != Texel::none)
            atlas.charts[chart].add(x, y);
    });
    atlas.image = std::move(image_);
    return atlas;
  }

private:
  static constexpr std::uint32_t bandRows = 64;
  static constexpr double maxDistance = 0.7072; ///< from the centre of a texel to its corners

  /// The triangle that has a texel.
  struct Texel {
    static constexpr float none = 0, inside = -1;
    float distance = none; ///< from its centre to the triangle, and 1
    std::uint32_t identity = 0;
    friend auto operator<=>(const Texel&, const Texel&) = default;
  };

  Texel& texelAt(std::uint32_t x, std::uint32_t y) { return texels_[std::size_t{y} * image_.width + x]; }

  /// Calls draw(triangle, inChart) for the part of each triangle in each band.
  template <typename Draw> void draw(TriangleBatch batch, const Draw& draw) {
    chartOfTriangle_.resize(batch.size());
    rows_.resize(batch.size());
    parallelForBlocks(batch.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const NewCharts::Chart& chart = charts_.charts[chartOfTriangle_[i] = charts_.chartOf(batch[i])];
        rows_[i] = ChartTriangle(batch[i], chart.projection, chart.rect).rows();
      }
    });
    std::vector<std::uint32_t> used;
    for (std::uint32_t i = 0; i < batch.size(); ++i)
      for (std::uint32_t band = rows_[i].first / bandRows; band * bandRows < rows_[i].second; ++band) {
        if (bands_[band].empty())
          used.push_back(band);
        bands_[band].push_back(i);
      }
    parallelFor(used.size(), [&](std::size_t number) {
      const std::uint32_t first = used[number] * bandRows;
      for (const std::uint32_t i : bands_[used[number]]) {
        const NewCharts::Chart& chart = charts_.charts[chartOfTriangle_[i]];
        TexelRect part = chart.rect;
        part.top = std::max(part.top, first);
        part.height = std::min(chart.rect.top + chart.rect.height, first + bandRows) - part.top;
        draw(batch[i], ChartTriangle(batch[i], chart.projection, part));
      }
      bands_[used[number]].clear();
    });
  }

  void drawInside(const TexturedTriangle& triangle, const ChartTriangle& inChart) {
    const SourceColors colors(source_, triangle);
    const int samples = samplesOf(inChart, colors);
    inChart.visitInside([&](std::uint32_t x, std::uint32_t y) {
      PixelSum sum;
      for (int row = 0; row < samples; ++row)
        for (int column = 0; column < samples; ++column)
          colors.add(sum, colors.at(inChart.sharesAt(x + (column + 0.5) / samples, y + (row + 0.5) / samples)));
      store(sum, colors, inChart.sharesAt(x + 0.5, y + 0.5), x, y);
      texelAt(x, y).distance = Texel::inside;
    });
  }

  void drawTouched(const TexturedTriangle& triangle, const ChartTriangle& inChart) {
    const SourceColors colors(source_, triangle);
    const std::uint64_t identity = identityOf(triangle);
    inChart.visitAround([&](std::uint32_t x, std::uint32_t y) {
      Texel& best = texelAt(x, y);
      if (best.distance == Texel::inside)
        return;
      double distance = 0;
      const Shares shares = inChart.nearestShares(x + 0.5, y + 0.5, distance);
      if (distance > maxDistance)
        return;
      const Texel each{static_cast<float>(distance) + 1, static_cast<std::uint32_t>(identity)};
      if (best.distance != Texel::none && !(each < best))
        return;
      best = each;
      PixelSum sum;
      colors.add(sum, colors.at(shares));
      store(sum, colors, shares, x, y);
    });
  }

  /// How many samples along each edge of a texel read about all texels of the source there.
  static int samplesOf(const ChartTriangle& inChart, const SourceColors& colors) {
    constexpr double maxSamples = 4;
    const auto at = [&](double x, double y) { return colors.at(inChart.sharesAt(x, y)); };
    const Vec2<double> origin = at(0, 0), right = at(1, 0), below = at(0, 1);
    const double steps = std::max(std::hypot(right.x - origin.x, right.y - origin.y),
                                  std::hypot(below.x - origin.x, below.y - origin.y));
    return steps > 1.25 ? static_cast<int>(std::min(std::ceil(steps), maxSamples)) : 1; // NaN: 1
  }

  void store(const PixelSum& sum, const SourceColors& colors, const Shares& shares, std::uint32_t x, std::uint32_t y) {
    std::uint8_t* const pixel = &image_.pixels[4 * (std::size_t{y} * image_.width + x)];
    if (sum.weight > 0)
      sum.storeMean(pixel);
    else // a triangle smaller than a texel, which the charts around it have
      std::copy_n(colors.nearest(colors.at(shares)), 4, pixel);
  }

  const NewCharts& charts_;
  const ChipSource& source_;
  Raster image_;
  std::vector<Texel> texels_;
  std::vector<std::vector<std::uint32_t>> bands_; ///< of each, the triangles of the batch
  std::vector<std::uint32_t> chartOfTriangle_;    ///< of the batch
  std::vector<std::pair<std::uint32_t, std::uint32_t>> rows_;
};

} // namespace

ChipSource rebakedAtlas(const NewCharts& charts, const TriangleVisits& triangles, const ChipSource& source) {
  AtlasPainter painter(charts, source);
  visitBatches(triangles, [&](TriangleBatch batch) { painter.addInside(batch); });
  visitBatches(triangles, [&](TriangleBatch batch) { painter.addTouched(batch); });
  return painter.take();
}

} // namespace imgeo
