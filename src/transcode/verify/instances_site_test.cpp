#include "base/file.h"
#include "base/testing.h"
#include "imgeo/imgeo.h"
#include "transcode/site/testing.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

constexpr int columnSides = 40, columnRings = 8, columnCount = 12;

/// An OBJ file of twisted columns, each turned and moved in its own vertices. Of odd ones the vertices are in another
/// order. `mirrored`: the last one is.
std::string twistedColumns(bool mirrored = false) {
  std::string text;
  int base = 1;
  for (int n = 0; n < columnCount; ++n) {
    const bool isMirrored = mirrored && n == columnCount - 1;
    const double angle = 0.7 * n, c = std::cos(angle), s = std::sin(angle);
    text += fmt::format("o column{}\n", n);
    const auto number = [&](int ring, int side) {
      const int vertex = ring * columnSides + side % columnSides;
      return base + (n % 2 == 0 ? vertex : columnSides * columnRings - 1 - vertex);
    };
    std::string vertices[columnSides * columnRings], faces;
    for (int ring = 0; ring < columnRings; ++ring)
      for (int side = 0; side < columnSides; ++side) {
        const double a = 6.283185307179586 * side / columnSides,
                     r = 0.3 + 0.05 * std::sin(a + 1.7 * ring) + 0.01 * side;
        const double x = r * std::cos(a), y = (isMirrored ? -1 : 1) * r * std::sin(a), z = 0.5 * ring;
        vertices[number(ring, side) - base] =
            fmt::format("v {:.8g} {:.8g} {:.8g}\n", c * x - s * y + 3 * n, s * x + c * y + 2, z);
        if (ring + 1 < columnRings)
          faces += fmt::format("f {} {} {}\nf {} {} {}\n", number(ring, side), number(ring, side + 1),
                               number(ring + 1, side), number(ring, side + 1), number(ring + 1, side + 1),
                               number(ring + 1, side));
      }
    for (const std::string& vertex : vertices)
      text += vertex;
    text += faces;
    base += columnSides * columnRings;
  }
  return text;
}

/// An OBJ file of boxes of many sizes, all turned and moved, of which `equalCount` are of one size.
std::string manyBoxes(int count, int equalCount) {
  std::string text;
  for (int n = 0; n < count; ++n) {
    const double angle = 0.3 * n, c = std::cos(angle), s = std::sin(angle);
    const double edge = n < equalCount ? 0.7 : 0.8 + 0.001 * n;
    text += fmt::format("o box{}\n", n);
    for (int corner = 0; corner < 8; ++corner) {
      const double x = (corner & 1) * edge, y = (corner >> 1 & 1) * 0.5, z = corner >> 2;
      text += fmt::format("v {:.8g} {:.8g} {:.8g}\n", c * x - s * y + 4 * (n % 50), s * x + c * y + 4 * (n / 50), z);
    }
    for (const char* face : {"-8 -6 -5 -7", "-4 -3 -1 -2", "-8 -7 -3 -4", "-6 -2 -1 -5", "-8 -4 -2 -6", "-7 -5 -1 -3"})
      text += fmt::format("f {}\n", face);
  }
  return text;
}

class InstancesOfASite : public ::testing::Test {
protected:
  ConvertReport convertText(const std::string& text, bool findInstances = true, Target target = Target::web) {
    writeFile(directory / "in.obj", asBytes(text));
    ConvertOptions options;
    options.target = target;
    options.pictures = false;
    options.findInstances = findInstances;
    return convert(directory / "in.obj", directory / "site", options);
  }
  std::uint64_t geometryBytes() const {
    std::uint64_t bytes = 0;
    for (const auto& file : std::filesystem::directory_iterator(directory / "site" / "geometry"))
      bytes += file.file_size();
    return bytes;
  }
  VerifyReport verified() const { return verify(directory / "site", directory / "in.obj"); }

  TemporaryDirectory directory;
};

TEST_F(InstancesOfASite, AreFoundByContentAndEqualTheirSource) {
  const ConvertReport report = convertText(twistedColumns());
  EXPECT_EQ(report.instances.shapes, std::size_t{columnCount - 1});
  EXPECT_EQ(report.instances.meshes, std::size_t{columnCount - 1});
  EXPECT_LE(report.instances.largestDistance, report.maxStep);
  const VerifyReport compared = verified();
  EXPECT_TRUE(compared.equal) << (compared.findings.empty() ? "" : compared.findings.front());
  EXPECT_EQ(compared.instances, std::size_t{columnCount - 1});
  EXPECT_LE(compared.instanceDistance, report.maxStep);
  const std::uint64_t bytes = geometryBytes();
  EXPECT_EQ(convertText(twistedColumns(), false).instances.shapes, 0u);
  EXPECT_LT(bytes, geometryBytes() / 4);
  EXPECT_TRUE(verified().equal);
}

TEST_F(InstancesOfASite, AreThoseOfPagesForX3domWhoseShapesRepeatTheNode) {
  EXPECT_EQ(convertText(twistedColumns(), true, Target::x3dom).instances.shapes, std::size_t{columnCount - 1});
  const VerifyReport compared = verified();
  EXPECT_TRUE(compared.equal) << (compared.findings.empty() ? "" : compared.findings.front());
  EXPECT_EQ(compared.instances, std::size_t{columnCount - 1});
}

TEST_F(InstancesOfASite, AreNotMirrorImages) {
  EXPECT_EQ(convertText(twistedColumns(true)).instances.shapes, std::size_t{columnCount - 2});
  EXPECT_TRUE(verified().equal);
}

TEST_F(InstancesOfASite, AreThoseOfSmallMeshesOfWhichManyAreEqual) {
  EXPECT_EQ(convertText(manyBoxes(2050, 15)).instances.shapes, 0u); // a Transform each takes more bytes than boxes do
  EXPECT_EQ(convertText(manyBoxes(2050, 16)).instances.shapes, 15u);
  EXPECT_TRUE(verified().equal);
  EXPECT_EQ(verified().instances, 15u);
  EXPECT_EQ(convertText(manyBoxes(200, 2)).instances.shapes, 1u); // which have a geometry node each
}

TEST_F(InstancesOfASite, AreTheSameBytesAgain) {
  convertText(twistedColumns());
  const Bytes page = readFile(directory / "site" / "index.html");
  convertText(twistedColumns());
  EXPECT_EQ(readFile(directory / "site" / "index.html"), page);
}

TEST_F(InstancesOfASite, AreComparedWithWhatTheInputHas) {
  convertText(twistedColumns());
  std::string changed = twistedColumns();
  const std::size_t line = changed.find("v ", changed.find("o column5"));
  changed.replace(line, 3, "v 9");
  writeFile(directory / "in.obj", asBytes(changed));
  const VerifyReport compared = verified();
  EXPECT_FALSE(compared.equal);
  EXPECT_EQ(compared.instances, std::size_t{columnCount - 2});
}

} // namespace
} // namespace imgeo
