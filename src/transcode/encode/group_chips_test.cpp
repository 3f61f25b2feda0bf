#include "transcode/encode/group_chips.h"

#include "prepare/lattice.h"
#include "prepare/levels/levels.h"
#include "prepare/weld.h"
#include "scene/testing.h"
#include "transcode/encode/pack_rectangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <mutex>

namespace imgeo {
namespace {

using TexelPoint = Vec2<double>;
using Pixel = std::array<int, 4>;

constexpr std::uint32_t cellsAcross = 128, chartCells = 32, chartsPerRow = cellsAcross / chartCells, sheetEdge = 1024;

/// A relief of squares in sixteen charts, each turned into another corner of the atlas, without gaps between them.
Mesh relief() {
  Mesh mesh;
  testing::Random random(3);
  for (std::uint32_t y = 0; y <= cellsAcross; ++y)
    for (std::uint32_t x = 0; x <= cellsAcross; ++x)
      mesh.positions.push_back(
          {static_cast<float>(x), static_cast<float>(y),
           4 * std::sin(0.11f * static_cast<float>(x)) + 3 * std::cos(0.07f * static_cast<float>(y))});
  for (std::uint32_t chart = 0; chart < chartsPerRow * chartsPerRow; ++chart) {
    const std::uint32_t left = chart % chartsPerRow * chartCells, top = chart / chartsPerRow * chartCells;
    const std::uint32_t corner = chart * 7 % (chartsPerRow * chartsPerRow);
    const auto first = static_cast<std::uint32_t>(mesh.wedgePositions.size());
    for (std::uint32_t y = 0; y <= chartCells; ++y)
      for (std::uint32_t x = 0; x <= chartCells; ++x) {
        mesh.wedgePositions.push_back((top + y) * (cellsAcross + 1) + left + x);
        const double u = (corner % chartsPerRow + double(chart % 2 == 0 ? x : y) / chartCells) / chartsPerRow,
                     v = (corner / chartsPerRow + double(chart % 2 == 0 ? y : x) / chartCells) / chartsPerRow;
        mesh.texCoords.push_back({static_cast<float>(u), static_cast<float>(v)});
      }
    for (std::uint32_t y = 0; y < chartCells; ++y)
      for (std::uint32_t x = 0; x < chartCells; ++x) {
        const std::uint32_t a = first + y * (chartCells + 1) + x, b = a + 1, c = a + chartCells + 1, d = c + 1;
        mesh.corners.insert(mesh.corners.end(), {a, b, c, b, d, c});
      }
  }
  return mesh;
}

Pixel pixelAt(const Raster& raster, std::uint32_t x, std::uint32_t y) {
  const std::uint8_t* const at = &raster.pixels[4 * (std::size_t{y} * raster.width + x)];
  return {at[0], at[1], at[2], at[3]};
}

/// All texels that a bilinear sample at a texture coordinate reads.
std::array<Pixel, 4> sample(const Raster& raster, Vec2f texCoord) {
  const TexelPoint at = texelOf(texCoord, raster.width, raster.height);
  const auto clamped = [](double value, std::uint32_t count) {
    return static_cast<std::uint32_t>(std::clamp(value, 0.0, count - 1.0));
  };
  const std::uint32_t left = clamped(std::floor(at.x - 0.5), raster.width),
                      right = clamped(std::floor(at.x + 0.5), raster.width),
                      top = clamped(std::floor(at.y - 0.5), raster.height),
                      bottom = clamped(std::floor(at.y + 0.5), raster.height);
  return {pixelAt(raster, left, top), pixelAt(raster, right, top), pixelAt(raster, left, bottom),
          pixelAt(raster, right, bottom)};
}

/// The next mipmap, as graphics cards make it.
Raster halved(const Raster& raster) {
  Raster half{raster.width / 2, raster.height / 2, {}};
  for (std::uint32_t y = 0; y < half.height; ++y)
    for (std::uint32_t x = 0; x < half.width; ++x)
      for (std::size_t c = 0; c < 4; ++c)
        half.pixels.push_back(static_cast<std::uint8_t>(
            (pixelAt(raster, 2 * x, 2 * y)[c] + pixelAt(raster, 2 * x + 1, 2 * y)[c] +
             pixelAt(raster, 2 * x, 2 * y + 1)[c] + pixelAt(raster, 2 * x + 1, 2 * y + 1)[c]) /
            4));
  return half;
}

/// A group with its image.
struct BuiltGroup {
  std::uint32_t level = 0;
  Patch patch;
  std::vector<std::uint32_t> charts; ///< of each triangle
  GroupChips chips;
};

struct BuiltChips {
  ChipSource source;
  std::vector<BuiltGroup> groups;
  std::uint64_t texels = 0;
};

/// Builds levels of the relief, with images of an atlas in which `colorOf(chart, x, y)` colours each texel.
template <typename ColorOf> BuiltChips build(ColorOf colorOf) {
  Mesh mesh = relief();
  weld(mesh);
  BuiltChips built;
  Charts charts = chartsOf(mesh, sheetEdge, sheetEdge);
  EXPECT_EQ(charts.masks.size(), chartsPerRow * chartsPerRow);
  built.source = {{sheetEdge, sheetEdge, Bytes(std::size_t{4} * sheetEdge * sheetEdge, 255)}, charts.masks};
  for (std::uint32_t chart = 0; chart < charts.masks.size(); ++chart) {
    const TexelRect rect = charts.masks[chart].rect();
    EXPECT_EQ(rect.width, sheetEdge / chartsPerRow);
    for (std::uint32_t y = rect.top; y < rect.top + rect.height; ++y)
      for (std::uint32_t x = rect.left; x < rect.left + rect.width; ++x) {
        EXPECT_TRUE(charts.masks[chart].has(x, y));
        const std::array<std::uint8_t, 3> color = colorOf(chart, x, y);
        std::ranges::copy(color, &built.source.image.pixels[4 * (std::size_t{y} * sheetEdge + x)]);
      }
  }
  for (const std::uint32_t chart : charts.ofWedge)
    mesh.texCoords1.push_back({static_cast<float>(chart), 0});
  const std::vector<Vec3u> points = quantise(mesh.positions, latticeFor(boxOf(mesh), 14));
  std::mutex mutex;
  const GroupSink sink{[](std::uint32_t, std::size_t) {},
                       [&](std::uint32_t level, std::size_t, GroupMesh each) {
                         BuiltGroup group{level, std::move(each.patch), {}, {}};
                         for (std::size_t corner = 0; corner < group.patch.corners.size(); corner += 3)
                           group.charts.push_back(
                               static_cast<std::uint32_t>(group.patch.texCoords1[group.patch.corners[corner]].x));
                         group.chips = makeChips(group.patch, level, 1, built.source).value();
                         const std::lock_guard lock(mutex);
                         built.texels += std::uint64_t{group.chips.image.width} * group.chips.image.height;
                         built.groups.push_back(std::move(group));
                       }};
  buildLevels(std::move(mesh), points, {.groupTriangles = 4096}, sink);
  return built;
}

std::array<std::uint8_t, 3> flatColor(std::uint32_t chart, std::uint32_t, std::uint32_t) {
  return {static_cast<std::uint8_t>(chart % 4 * 85), static_cast<std::uint8_t>(chart / 4 * 85),
          static_cast<std::uint8_t>(chart % 3 * 127)};
}

/// Calls visit(triangle, coordinates in the image) for points of all triangles of a group.
template <typename Visit> void visitPoints(const BuiltGroup& group, Visit visit) {
  constexpr int steps = 3;
  for (std::size_t triangle = 0; triangle < group.charts.size(); ++triangle)
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j) {
        const auto at = [&](const std::vector<Vec2f>& coords) {
          const auto corner = [&](std::size_t n) { return coords[group.patch.corners[3 * triangle + n]]; };
          const float a = float(i) / steps, b = float(j) / steps, c = 1 - a - b;
          return Vec2f{a * corner(0).x + b * corner(1).x + c * corner(2).x,
                       a * corner(0).y + b * corner(1).y + c * corner(2).y};
        };
        visit(triangle, at(group.patch.texCoords), at(group.patch.texCoords1));
      }
}

TEST(GroupChips, NoColourBleedsOverASeamAtAnyLevelAndInTwoMipmaps) {
  const BuiltChips built = build(flatColor);
  std::map<std::uint32_t, std::size_t> triangles;
  for (const BuiltGroup& group : built.groups) {
    triangles[group.level] += group.charts.size();
    const Raster half = halved(group.chips.image), quarter = halved(half);
    std::size_t wrong = 0;
    visitPoints(group, [&](std::size_t triangle, Vec2f, Vec2f at) {
      const auto [r, g, b] = flatColor(group.charts[triangle], 0, 0);
      const Pixel color{r, g, b, 255};
      for (const Raster* const image : {&group.chips.image, &half, &quarter})
        for (const Pixel& pixel : sample(*image, at))
          wrong += pixel != color;
    });
    EXPECT_EQ(wrong, 0u) << "level " << group.level;
  }
  EXPECT_EQ(triangles[0], std::size_t{2} * cellsAcross * cellsAcross);
  EXPECT_GE(triangles.size(), 3u);
}

TEST(GroupChips, TogetherHaveUpToOneAndAHalfTimesTheTexelsOfTheSource) {
  const BuiltChips built = build(flatColor);
  const double share = static_cast<double>(built.texels) / sheetEdge / sheetEdge;
  EXPECT_LE(share, 1.5);
  EXPECT_GE(share, 1.25);
  RecordProperty("share", std::to_string(share));
}

TEST(GroupChips, HaveTheTexelsOfTheSourceOnLevel0AndAboveMeansOfThem) {
  const auto gradient = [](std::uint32_t, std::uint32_t x, std::uint32_t y) {
    return std::array{static_cast<std::uint8_t>(x / 4), static_cast<std::uint8_t>(y / 4),
                      static_cast<std::uint8_t>((x * 7 + y * 13) % 256)};
  };
  const BuiltChips built = build(gradient);
  for (const BuiltGroup& group : built.groups) {
    std::size_t wrong = 0;
    visitPoints(group, [&](std::size_t, Vec2f source, Vec2f chip) {
      // One texel of level k is off by at most its own edge, 2^k texels of four for each step of red and green.
      const TexelPoint at = texelOf(source, sheetEdge, sheetEdge);
      const TexelPoint in = texelOf(chip, group.chips.image.width, group.chips.image.height);
      const Pixel expected = pixelAt(built.source.image, std::min(static_cast<std::uint32_t>(at.x), sheetEdge - 1),
                                     std::min(static_cast<std::uint32_t>(at.y), sheetEdge - 1));
      const Pixel pixel =
          pixelAt(group.chips.image, static_cast<std::uint32_t>(in.x), static_cast<std::uint32_t>(in.y));
      const int slack = 2 + (1 << group.level) / 2;
      const auto isWithinTexel = [](double value) { return std::abs(value - std::floor(value) - 0.5) < 0.45; };
      if (group.level == 0 && isWithinTexel(at.x) && isWithinTexel(at.y))
        wrong += pixel != expected;
      for (std::size_t c = 0; c < 2; ++c)
        wrong += std::abs(pixel[c] - expected[c]) > slack;
    });
    EXPECT_EQ(wrong, 0u) << "level " << group.level;
    EXPECT_GT(group.chips.texelEdge, 0);
  }
}

TEST(PackRectangles, RectanglesDoNotOverlap) {
  testing::Random random(5);
  std::vector<RasterSize> sizes;
  std::uint64_t area = 0;
  for (int n = 0; n < 200; ++n) {
    sizes.push_back({1 + random.below(40), 1 + random.below(60)});
    area += std::uint64_t{sizes.back().width} * sizes.back().height;
  }
  const PackedRectangles packed = packRectangles(sizes, 4096).value();
  std::vector<int> owner(std::size_t{packed.size.width} * packed.size.height, -1);
  for (int n = 0; n < 200; ++n) {
    const auto [column, row] = packed.corners[static_cast<std::size_t>(n)];
    const RasterSize size = sizes[static_cast<std::size_t>(n)];
    ASSERT_LE(column + size.width, packed.size.width);
    ASSERT_LE(row + size.height, packed.size.height);
    for (std::uint32_t y = row; y < row + size.height; ++y)
      for (std::uint32_t x = column; x < column + size.width; ++x)
        EXPECT_EQ(std::exchange(owner[std::size_t{y} * packed.size.width + x], n), -1);
  }
  EXPECT_LT(double(packed.size.width) * packed.size.height, 1.3 * static_cast<double>(area));
  EXPECT_FALSE(packRectangles(sizes, 59));
}

} // namespace
} // namespace imgeo
