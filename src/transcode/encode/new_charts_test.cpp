#include "transcode/encode/new_charts.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/soak_testing.h"
#include "images/decode_image.h"
#include "images/encode_image.h"
#include "prepare/lattice.h"
#include "prepare/levels/levels.h"
#include "scene/testing.h"
#include "transcode/encode/level_images.h"
#include "transcode/encode/rebaked_atlas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <mutex>
#include <numeric>
#include <set>

namespace imgeo {
namespace {

/// Gives each triangle of a mesh a chart of its own: half of a square of the atlas, with corners in the middle of
/// texels. Squares are in an order in which no neighbours are neighbours.
struct Fragments {
  static constexpr std::uint32_t square = 8;
  std::uint32_t perEdge = 1;

  explicit Fragments(std::size_t triangles) {
    while (std::size_t{perEdge} * perEdge < triangles)
      ++perEdge;
  }
  std::uint32_t edge() const { return square * perEdge; }
  std::size_t squareOf(std::size_t triangle) const {
    const std::size_t all = std::size_t{perEdge} * perEdge;
    return triangle * 7919 % all; // a prime, which divides no number of squares of the tests
  }
  /// Texels from the top left corner of the atlas.
  Vec2<double> corner(std::size_t triangle, std::size_t i) const {
    const std::size_t at = squareOf(triangle);
    const double reach = square - 1;
    return {static_cast<double>(at % perEdge * square) + 0.5 + (i == 1 ? reach : 0),
            static_cast<double>(at / perEdge * square) + 0.5 + (i == 2 ? reach : 0)};
  }
  void apply(Mesh& mesh) const {
    std::vector<std::uint32_t> positions;
    for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner) {
      positions.push_back(mesh.wedgePositions[mesh.corners[corner]]);
      mesh.corners[corner] = static_cast<std::uint32_t>(corner);
    }
    static_cast<VertexAttributes&>(mesh) = {};
    mesh.wedgePositions = positions;
    for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
      const Vec2<double> at = corner(i / 3, i % 3);
      mesh.texCoords.push_back({static_cast<float>(at.x / edge()), static_cast<float>(1 - at.y / edge())});
    }
  }
};

/// The triangles of a mesh on a lattice, whose charts in the source are their numbers.
std::vector<TexturedTriangle> texturedTriangles(const Mesh& mesh, std::uint32_t bits = 14) {
  const std::vector<Vec3u> points = quantise(mesh.positions, latticeFor(boxOf(mesh), bits));
  std::vector<TexturedTriangle> triangles;
  for (std::uint32_t triangle = 0; triangle < mesh.elementCount(); ++triangle) {
    TexturedTriangle& each = triangles.emplace_back();
    each.chart = triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t wedge = mesh.corners[3 * std::size_t{triangle} + i];
      each.points[i] = points[mesh.wedgePositions[wedge]];
      each.texCoords[i] = mesh.texCoords[wedge];
    }
  }
  return triangles;
}

TriangleVisits visitsOf(const std::vector<TexturedTriangle>& triangles) {
  return [&](const auto& visit) { std::ranges::for_each(triangles, visit); };
}

/// A sheet of squares along a curve, `across` squares wide.
template <typename Curve> Mesh bentSheet(std::uint32_t along, std::uint32_t across, Curve curve) {
  Mesh mesh;
  for (std::uint32_t i = 0; i <= along; ++i)
    for (std::uint32_t j = 0; j <= across; ++j) {
      const auto [x, z] = curve(double(i) / along);
      mesh.positions.push_back(
          {static_cast<float>(x), static_cast<float>(j) / static_cast<float>(across), static_cast<float>(z)});
    }
  testing::addPlainWedges(mesh);
  for (std::uint32_t i = 0; i < along; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const std::uint32_t a = i * (across + 1) + j, b = a + across + 1;
      testing::addTriangle(mesh, a, b, a + 1);
      testing::addTriangle(mesh, b, b + 1, a + 1);
    }
  return mesh;
}

/// Three layers, one above the other, with bends between them.
Mesh foldedSheet() {
  return bentSheet(240, 60, [](double t) {
    const double turns = 3 * t, layer = std::floor(std::min(turns, 2.999)), rest = turns - layer;
    const double x = std::fmod(layer, 2) == 0 ? rest : 1 - rest;
    return std::pair(x, 0.02 * layer + (rest > 0.9 ? 0.2 * (rest - 0.9) : 0));
  });
}

Mesh hillySheet() {
  constexpr std::uint32_t edge = 120;
  Mesh mesh = bentSheet(edge, edge, [](double t) { return std::pair(t, 0.0); });
  for (Vec3f& at : mesh.positions)
    at.z = 0.1f * std::sin(9 * at.x) * std::cos(7 * at.y);
  return mesh;
}

/// Triangles anywhere, which pass through each other.
Mesh passingTriangles() {
  testing::Random random(5);
  Mesh mesh;
  for (std::uint32_t n = 0; n < 600; ++n) {
    const Vec3f at = random.point();
    for (std::uint32_t i = 0; i < 3; ++i)
      mesh.positions.push_back(at + random.point() * 0.05f);
    testing::addPlainWedges(mesh);
    testing::addTriangle(mesh, 3 * n, 3 * n + 1, 3 * n + 2);
  }
  return mesh;
}

struct ChartedMesh {
  std::string name;
  Mesh mesh;
};

std::vector<ChartedMesh> chartedMeshes() {
  std::vector<ChartedMesh> all{{"hills", hillySheet()},
                               {"sphere", testing::sphere(60, 90)},
                               {"folded", foldedSheet()},
                               {"soup", passingTriangles()}};
  for (ChartedMesh& each : all)
    Fragments(each.mesh.elementCount()).apply(each.mesh);
  return all;
}

std::optional<NewCharts> chartsOf(const std::vector<TexturedTriangle>& triangles) {
  const std::uint32_t edge = Fragments(triangles.size()).edge();
  return NewCharts::of(visitsOf(triangles), {edge, edge}, 4096);
}

TEST(NewCharts, HaveEachTriangleInOneChartWithinItsTexelsAndShareNoTexel) {
  for (const ChartedMesh& example : chartedMeshes()) {
    const std::vector<TexturedTriangle> triangles = texturedTriangles(example.mesh);
    const NewCharts charts = chartsOf(triangles).value();
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> owners; // of texels of the image
    std::size_t shared = 0, outside = 0, texels = 0;
    for (std::size_t number = 0; number < triangles.size(); ++number) {
      const std::uint32_t chart = charts.chartOf(triangles[number]);
      ASSERT_LT(chart, charts.charts.size()) << example.name;
      const auto& [key, rect, projection] = charts.charts[chart];
      for (const Vec3u& point : triangles[number].points) {
        const Vec2<double> at = projection.texelOf(point);
        outside += at.x < rect.left || at.y < rect.top || at.x > rect.left + rect.width + 1e-9 ||
                   at.y > rect.top + rect.height + 1e-9;
      }
      ChartTriangle(triangles[number], projection, rect).visitInside([&](std::uint32_t x, std::uint32_t y) {
        shared += !owners.emplace(std::pair(x, y), number).second;
        ++texels;
      });
    }
    EXPECT_EQ(shared, 0u) << example.name;
    EXPECT_EQ(outside, 0u) << example.name;
    EXPECT_GT(texels, 4 * triangles.size()) << example.name;
    EXPECT_LT(charts.charts.size(), triangles.size() / (example.name == "soup" ? 1 : 50)) << example.name;
  }
}

TEST(NewCharts, OfSheetsAboveEachOtherAreSeveralAndOfHillsNone) {
  EXPECT_TRUE(chartsOf(texturedTriangles(chartedMeshes()[0].mesh))->layers.empty());
  EXPECT_FALSE(chartsOf(texturedTriangles(chartedMeshes()[2].mesh))->layers.empty());
}

TEST(NewCharts, DoNotDependOnTheOrderOfTriangles) {
  for (const ChartedMesh& example : chartedMeshes()) {
    std::vector<TexturedTriangle> triangles = texturedTriangles(example.mesh);
    const NewCharts charts = chartsOf(triangles).value();
    std::vector<std::uint32_t> expected;
    for (const TexturedTriangle& triangle : triangles)
      expected.push_back(charts.chartOf(triangle));
    testing::Random random(7);
    std::vector<std::size_t> order(triangles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[random.below(i)]);
    std::vector<TexturedTriangle> shuffled;
    for (const std::size_t i : order)
      shuffled.push_back(triangles[i]);
    const NewCharts again = chartsOf(shuffled).value();
    EXPECT_EQ(again.size.width, charts.size.width);
    EXPECT_EQ(again.size.height, charts.size.height);
    std::size_t different = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i)
      different += again.chartOf(triangles[i]) != expected[i];
    EXPECT_EQ(different, 0u) << example.name;
  }
}

TEST(NewCharts, AreNoneOfASurfaceWithoutTexels) {
  Mesh mesh = hillySheet();
  mesh.texCoords.assign(mesh.wedgeCount(), {0.5f, 0.5f});
  EXPECT_FALSE(NewCharts::of(visitsOf(texturedTriangles(mesh)), {512, 512}, 4096));
}

TEST(NewCharts, AreRefusedWhereMemoryDoesNotHoldTheirPixels) {
  const std::vector<TexturedTriangle> triangles = texturedTriangles(chartedMeshes()[0].mesh);
  const auto within = [&](std::uint64_t maxBytes) {
    return NewCharts::of(visitsOf(triangles), {2048, 2048}, 4096, maxBytes);
  };
  const RasterSize size = within(UINT64_MAX)->size;
  const std::uint64_t needed = NewCharts::bytesOfResampledPixel * size.width * size.height;
  EXPECT_TRUE(within(needed));
  EXPECT_THROW(within(needed - 1), Error);
  EXPECT_THROW(within(1000), Error);
}

TEST(NewCharts, AreRefusedWhereMemoryDoesNotHoldTheTrianglesThatOthersCover) {
  Mesh sheet = bentSheet(60, 60, [](double t) { return std::pair(t, 0.0); });
  sheet.texCoords.resize(sheet.wedgeCount());
  constexpr std::uint32_t sheets = 4;
  std::vector<TexturedTriangle> triangles;
  for (std::uint32_t number = 0; number < sheets; ++number)
    for (TexturedTriangle triangle : texturedTriangles(sheet)) {
      for (Vec3u& point : triangle.points)
        point.z += 20 * number;
      triangles.push_back(triangle);
    }
  for (TexturedTriangle& triangle : triangles)
    triangle.texCoords = {{{0, 0}, {0.0044f, 0}, {0, 0.0044f}}}; // two and a half texels
  const auto within = [&](std::uint64_t maxBytes) {
    return NewCharts::of(visitsOf(triangles), {512, 512}, 1u << 16, maxBytes);
  };
  const NewCharts charts = within(UINT64_MAX).value();
  ASSERT_EQ(charts.layers.size(), triangles.size() / sheets * (sheets - 1));
  std::uint64_t texels = 0;
  for (const NewCharts::Chart& chart : charts.charts)
    texels += std::uint64_t{chart.rect.width} * chart.rect.height;
  const std::uint64_t ofOneLayer = texels / sheets * 8;
  const std::uint64_t needed = ofOneLayer + charts.layers.size() * NewCharts::bytesOfCoveredTriangle;
  ASSERT_GT(needed, NewCharts::bytesOfResampledPixel * charts.size.width * charts.size.height +
                        charts.layers.size() * sizeof(NewCharts::Layer));
  EXPECT_TRUE(within(needed));
  EXPECT_THROW(within(needed - 1), Error);
}

/// The colours, the bits of the masks and the layers of new charts.
struct Resampled {
  Bytes pixels;
  std::vector<std::vector<bool>> masks;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> layers;
  bool operator==(const Resampled&) const = default;
};

SOAK_TEST(NewCharts, AndTheirImageDoNotDependOnThreads) {
  for (ChartedMesh& example : chartedMeshes()) {
    std::vector<TexturedTriangle> triangles = texturedTriangles(example.mesh);
    const std::vector<TexturedTriangle> doubled(triangles.begin(), triangles.begin() + 500);
    triangles.insert(triangles.end(), doubled.begin(), doubled.end());
    const Fragments fragments(example.mesh.elementCount());
    ChipSource source{{fragments.edge(), fragments.edge(), {}}, {}};
    testing::Random random(11);
    for (std::size_t i = 0; i < std::size_t{4} * fragments.edge() * fragments.edge(); ++i)
      source.image.pixels.push_back(static_cast<std::uint8_t>(random.below(256)));
    source.charts = chartsOf(example.mesh, fragments.edge(), fragments.edge()).masks;
    const auto resampledBy = [&](std::size_t threads) {
      limitThreads(threads);
      const NewCharts charts = chartsOf(triangles).value();
      const ChipSource atlas = rebakedAtlas(charts, visitsOf(triangles), source);
      limitThreads(0);
      Resampled result{atlas.image.pixels, {}, {}};
      for (const ChartMask& mask : atlas.charts)
        result.masks.push_back(mask.bits());
      for (const auto& [triangle, layer] : charts.layers)
        result.layers.emplace_back(triangle, layer);
      return result;
    };
    const Resampled one = resampledBy(1);
    EXPECT_EQ(one.layers.empty(), example.name == "hills" || example.name == "sphere") << example.name;
    EXPECT_TRUE(resampledBy(3) == one) << example.name;
  }
}

using HillColor = std::array<double, 3>;

/// A colour for each point of hills, without magenta.
HillColor hillColor(const Vec3d& at) {
  return {60 + 50 * std::sin(6 * at.x), 140 + 60 * std::cos(5 * at.y), 60 + 40 * std::sin(4 * (at.x + at.y))};
}

/// The image of fragments, whose background is magenta.
Raster fragmentsImage(const Mesh& mesh, const Fragments& fragments) {
  Raster image{fragments.edge(), fragments.edge(), Bytes(std::size_t{4} * fragments.edge() * fragments.edge(), 255)};
  for (std::size_t green = 1; green < image.pixels.size(); green += 4)
    image.pixels[green] = 0;
  for (std::size_t triangle = 0; triangle < mesh.elementCount(); ++triangle) {
    const Vec2<double> origin = fragments.corner(triangle, 0);
    constexpr std::uint32_t reach = Fragments::square - 1;
    for (std::uint32_t y = 0; y <= reach; ++y)
      for (std::uint32_t x = 0; x <= reach && x + y <= reach + 1; ++x) { // and those that the longest edge touches
        const auto corner = [&](std::size_t i) { return Vec3d(mesh.cornerPosition(3 * triangle + i)); };
        const double b = double(x) / reach, c = double(y) / reach;
        const HillColor color = hillColor(corner(0) * (1 - b - c) + corner(1) * b + corner(2) * c);
        std::uint8_t* const pixel = &image.pixels[4 * ((static_cast<std::size_t>(origin.y) + y) * image.width +
                                                       static_cast<std::size_t>(origin.x) + x)];
        for (std::size_t channel = 0; channel < 3; ++channel)
          pixel[channel] = static_cast<std::uint8_t>(std::lround(color[channel]));
      }
  }
  return image;
}

HillColor bilinearColor(const Raster& image, Vec2<double> at) {
  const double left = std::floor(at.x - 0.5), top = std::floor(at.y - 0.5), x = at.x - 0.5 - left, y = at.y - 0.5 - top;
  HillColor color{};
  for (const auto& [column, row, weight] : {std::tuple(left, top, (1 - x) * (1 - y)),
                                            {left + 1, top, x * (1 - y)},
                                            {left, top + 1, (1 - x) * y},
                                            {left + 1, top + 1, x * y}}) {
    const auto u = static_cast<std::size_t>(std::clamp(column, 0.0, image.width - 1.0)),
               v = static_cast<std::size_t>(std::clamp(row, 0.0, image.height - 1.0));
    for (std::size_t c = 0; c < 3; ++c)
      color[c] += weight * image.pixels[4 * (v * image.width + u) + c];
  }
  return color;
}

TEST(NewCharts, GiveImagesOfGroupsTheColoursOfTheSourceAtEveryLevelAndNoneOfItsBackground) {
  Mesh mesh = hillySheet();
  const Fragments fragments(mesh.elementCount());
  fragments.apply(mesh);
  const Raster whole = fragmentsImage(mesh, fragments);
  const ImageFile file{"fragments.webp", encodeLosslessWebp(whole)};
  const Atlas atlas{&file};
  std::string reason;
  const std::unique_ptr<LevelImages> images = LevelImages::of(mesh, {.groupTriangles = 4096}, atlas, reason);
  ASSERT_TRUE(images) << reason;
  const Lattice lattice = latticeFor(boxOf(mesh), 14);
  const std::vector<Vec3u> points = quantise(mesh.positions, lattice);
  images->addCharts(mesh);
  EXPECT_TRUE(images->areTooFragmented());
  ASSERT_TRUE(images->resample(mesh, points));
  EXPECT_FALSE(images->areTooFragmented());
  const std::size_t triangles = mesh.elementCount();

  std::mutex mutex;
  std::map<std::uint32_t, double> largest, sums;
  std::map<std::uint32_t, std::size_t> samples;
  std::uint64_t texels = 0;
  const GroupSink sink{
      [](std::uint32_t, std::size_t) {},
      [&](std::uint32_t level, std::size_t, GroupMesh group) {
        Patch& patch = group.patch;
        const ChipFile chip = images->makeFile(patch, level);
        const std::lock_guard lock(mutex);
        ASSERT_FALSE(chip.bytes.empty());
        const Raster image = decodeRaster(chip.bytes, "a chip");
        texels += std::uint64_t{image.width} * image.height;
        for (std::size_t triangle = 0; triangle < patch.elementCount(); ++triangle)
          for (const auto& [a, b, c] : {std::array{0.34, 0.33, 0.33}, {0.98, 0.01, 0.01}, {0.0, 0.5, 0.5}}) {
            Vec3d position;
            Vec2<double> texel;
            const std::array shares{a, b, c};
            for (std::size_t i = 0; i < 3; ++i) {
              const std::uint32_t wedge = patch.corners[3 * triangle + i];
              position += lattice.point(patch.positions[patch.wedgePositions[wedge]]) * shares[i];
              const Vec2<double> at = texelOf(patch.texCoords1[wedge], image.width, image.height);
              texel.x += shares[i] * at.x, texel.y += shares[i] * at.y;
            }
            const HillColor color = bilinearColor(image, texel), expected = hillColor(position);
            for (std::size_t channel = 0; channel < 3; ++channel) {
              const double off = std::abs(color[channel] - expected[channel]);
              largest[level] = std::max(largest[level], off);
              sums[level] += off;
              ++samples[level];
            }
          }
      }};
  buildLevels(std::move(mesh), points, {.groupTriangles = 4096, .rootTriangles = 1024}, sink);
  EXPECT_TRUE(images->failure().empty()) << images->failure();
  EXPECT_LE(static_cast<double>(texels), 1.5 * fragments.edge() * fragments.edge());
  EXPECT_EQ(samples[0], triangles * 9);
  EXPECT_GE(largest.size(), 3u);
  for (const auto& [level, difference] : largest) {
    EXPECT_LE(difference, 1.5 + level) << level;
    EXPECT_LE(sums[level] / static_cast<double>(samples[level]), 0.4) << level;
    RecordProperty("largest" + std::to_string(level), std::to_string(difference));
    RecordProperty("mean" + std::to_string(level), std::to_string(sums[level] / static_cast<double>(samples[level])));
  }
}

} // namespace
} // namespace imgeo
