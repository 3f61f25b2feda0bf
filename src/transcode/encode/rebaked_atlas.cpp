#include "transcode/encode/rebaked_atlas.h"

#include "transcode/encode/linear_light.h"

#include <algorithm>
#include <array>
#include <cmath>

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

/// Draws triangles, one at a time.
class AtlasPainter {
public:
  AtlasPainter(const NewCharts& charts, const ChipSource& source) : charts_(charts), source_(source) {
    atlas_.image.width = charts.size.width, atlas_.image.height = charts.size.height;
    atlas_.image.pixels.resize(std::size_t{4} * charts.size.width * charts.size.height);
    for (const NewCharts::Chart& chart : charts.charts)
      atlas_.charts.emplace_back(chart.rect), atlas_.projections.push_back(chart.projection);
  }

  /// Draws the texels whose centres are inside.
  void addInside(const TexturedTriangle& triangle) {
    const std::uint32_t chart = charts_.chartOf(triangle);
    const ChartTriangle inChart(triangle, charts_.charts[chart].projection, charts_.charts[chart].rect);
    const SourceColors colors(source_, triangle);
    const int samples = samplesOf(inChart, colors);
    inChart.visitInside([&](std::uint32_t x, std::uint32_t y) {
      PixelSum sum;
      for (int row = 0; row < samples; ++row)
        for (int column = 0; column < samples; ++column)
          colors.add(sum, colors.at(inChart.sharesAt(x + (column + 0.5) / samples, y + (row + 0.5) / samples)));
      store(sum, colors, inChart.sharesAt(x + 0.5, y + 0.5), x, y);
      atlas_.charts[chart].add(x, y);
    });
  }

  void beginTouched() { touched_.resize(atlas_.image.pixels.size() / 4); }

  /// Draws texels that it touches and whose centres are in no triangle of the chart: when all have been added as
  /// inside.
  void addTouched(const TexturedTriangle& triangle) {
    const std::uint32_t chart = charts_.chartOf(triangle);
    const ChartTriangle inChart(triangle, charts_.charts[chart].projection, charts_.charts[chart].rect);
    const SourceColors colors(source_, triangle);
    const std::uint64_t identity = identityOf(triangle);
    inChart.visitAround([&](std::uint32_t x, std::uint32_t y) {
      Touched& best = touched_[std::size_t{y} * atlas_.image.width + x];
      if (best.distance == 0 && atlas_.charts[chart].has(x, y)) // by its centre
        return;
      double distance = 0;
      const Shares shares = inChart.nearestShares(x + 0.5, y + 0.5, distance);
      if (distance > maxDistance)
        return;
      const Touched each{static_cast<float>(distance) + 1, static_cast<std::uint32_t>(identity)};
      if (best.distance != 0 && !(each < best))
        return;
      best = each;
      PixelSum sum;
      colors.add(sum, colors.at(shares));
      store(sum, colors, shares, x, y);
      atlas_.charts[chart].add(x, y);
    });
  }

  ChipSource take() { return std::move(atlas_); }

private:
  static constexpr double maxDistance = 0.7072; ///< from the centre of a texel to its corners

  /// The triangle that is nearest to the centre of a texel.
  struct Touched {
    float distance = 0; ///< and 1; 0: no triangle yet
    std::uint32_t identity = 0;
    friend auto operator<=>(const Touched&, const Touched&) = default;
  };

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
    std::uint8_t* const pixel = &atlas_.image.pixels[4 * (std::size_t{y} * atlas_.image.width + x)];
    if (sum.weight > 0)
      sum.storeMean(pixel);
    else // a triangle smaller than a texel, which the charts around it have
      std::copy_n(colors.nearest(colors.at(shares)), 4, pixel);
  }

  const NewCharts& charts_;
  const ChipSource& source_;
  ChipSource atlas_;
  std::vector<Touched> touched_; ///< by texel
};

} // namespace

ChipSource rebakedAtlas(const NewCharts& charts, const TriangleVisits& triangles, const ChipSource& source) {
  AtlasPainter painter(charts, source);
  triangles([&](const TexturedTriangle& triangle) { painter.addInside(triangle); });
  painter.beginTouched();
  triangles([&](const TexturedTriangle& triangle) { painter.addTouched(triangle); });
  return painter.take();
}

} // namespace imgeo
