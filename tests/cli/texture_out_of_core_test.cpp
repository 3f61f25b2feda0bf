// Conversions out of core of meshes whose groups have images, as processes that are killed or share the work.

#include "base/soak_testing.h"
#include "containers/png/png.h"
#include "out_of_core.h"

#include <cmath>
#include <fmt/format.h>

namespace imgeo {
namespace {

using namespace testing;

constexpr std::uint32_t cells = 100, atlasEdge = 1024;

class TextureOutOfCoreProcess : public OutOfCoreProcess {
protected:
  void SetUp() override {
    input_ = directory_ / "relief.obj";
    testing::write(directory_ / "relief.mtl", "newmtl paint\nmap_Kd relief.png\n");
    Image image{atlasEdge, atlasEdge, 3, {}, {}};
    for (std::uint32_t y = 0; y < atlasEdge; ++y)
      for (std::uint32_t x = 0; x < atlasEdge; ++x)
        image.pixels.insert(image.pixels.end(),
                            {static_cast<std::uint8_t>(x / 4), static_cast<std::uint8_t>(y / 4), 77});
    const Bytes png = encodePng(image, 1);
    testing::write(directory_ / "relief.png", {png.begin(), png.end()});
  }

  /// Writes a relief of 20,000 triangles. `chartCells`: squares along an edge of a chart; charts are far from their
  /// neighbours in the image, of which they use the part up to `scale`.
  void writeRelief(std::uint32_t chartCells, double scale = 1) const {
    const std::uint32_t charts = cells / chartCells;
    std::string text = "mtllib relief.mtl\nusemtl paint\n", faces;
    for (std::uint32_t y = 0; y <= cells; ++y)
      for (std::uint32_t x = 0; x <= cells; ++x)
        text += fmt::format("v {} {} {}\n", x, y, 2 * std::sin(0.2 * x) * std::cos(0.3 * y));
    std::uint32_t texCoords = 0;
    for (std::uint32_t y = 0; y < cells; ++y)
      for (std::uint32_t x = 0; x < cells; ++x) {
        const std::uint32_t column = x / chartCells, row = y / chartCells,
                            left = (7 * column + row) % charts * chartCells + x % chartCells,
                            bottom = (11 * row + column) % charts * chartCells + y % chartCells;
        faces += "f";
        for (const auto& [dx, dy] : {std::pair(0u, 0u), {1u, 0u}, {1u, 1u}, {0u, 1u}}) {
          text += fmt::format("vt {} {}\n", scale * (left + dx) / cells, scale * (bottom + dy) / cells);
          faces += fmt::format(" {}/{}", (y + dy) * (cells + 1) + x + dx + 1, ++texCoords);
        }
        faces += "\n";
      }
    testing::write(input_, text + faces);
  }

  /// The geometry of the site of conversion in memory.
  std::map<std::string, std::string> takeGeometryInMemory() const {
    std::vector<std::string> words = command();
    const auto work = std::ranges::find(words, "--work");
    words.erase(work, work + 2);
    EXPECT_EQ(run(words).code, 0);
    return takeGeometry();
  }

  std::map<std::string, std::string> takeGeometry() const {
    std::map<std::string, std::string> files = takeSite();
    std::erase_if(files, [](const auto& file) { return !file.first.starts_with("/geometry/"); });
    return files;
  }

  void expectSameBytesOnRanks(const std::map<std::string, std::string>& expected) const {
    for (const int count : {1, 2, 4}) {
      std::vector<pid_t> children;
      for (int rank = count; rank-- > 0;)
        children.push_back(start(command({"--rank", std::to_string(rank), "--ranks", std::to_string(count)}),
                                 directory_ / fmt::format("out-{}", rank), directory_ / fmt::format("err-{}", rank)));
      for (const pid_t child : children)
        EXPECT_EQ(wait(child), 0) << textOf(directory_ / "err-0");
      EXPECT_TRUE(takeGeometry() == expected) << count;
      EXPECT_FALSE(std::filesystem::exists(work_));
    }
  }
};

std::size_t imagesIn(const std::map<std::string, std::string>& files) {
  return static_cast<std::size_t>(
      std::ranges::count_if(files, [](const auto& file) { return file.first.ends_with(".webp"); }));
}

TEST_F(TextureOutOfCoreProcess, WritesTheBytesOfConversionInMemoryOnAnyNumberOfRanks) {
  writeRelief(50, 0.7);
  const auto expected = takeGeometryInMemory();
  EXPECT_GT(imagesIn(expected), 40u);
  expectSameBytesOnRanks(expected);
}

SOAK_TEST_F(TextureOutOfCoreProcess, WritesTheBytesOfConversionInMemoryOnAnyNumberOfRanksWhereImagesAreOfNoUse) {
  writeRelief(1);
  const auto expected = takeGeometryInMemory();
  EXPECT_GT(expected.size(), 40u);
  EXPECT_EQ(imagesIn(expected), 0u);
  expectSameBytesOnRanks(expected);
}

SOAK_TEST_F(TextureOutOfCoreProcess, GoesOnWithTheSameBytesWhereverItWasKilled) {
  writeRelief(50, 0.7);
  ASSERT_EQ(run(command()).code, 0);
  expectGoesOnWhereKilled({"0/scatter-100-done", "0/charts-0-1", "0/charts-done", "0/masks-done", "0/groups-100-2"},
                          takeSite());
}

SOAK_TEST_F(TextureOutOfCoreProcess, GoesOnWithTheSameBytesWhereverItWasKilledWhereImagesAreOfNoUse) {
  writeRelief(1);
  ASSERT_EQ(run(command()).code, 0);
  expectGoesOnWhereKilled({"0/groups-100-2", "0/images-done", "0/scatter-0-done", "0/groups-0-2"}, takeSite());
}

} // namespace
} // namespace imgeo
