// Converts colours of more than 8 bits, and compares the sites with their sources.

#include "scene/testing.h"
#include "transcode/site/read_meshes.h"
#include "transcode/site/testing.h"

#include <cmath>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

/// A torus with colours between those of bytes.
Mesh tintedTorus() {
  Mesh mesh = testing::torus(12, 9);
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
    const double share = static_cast<double>(wedge) / static_cast<double>(mesh.wedgeCount());
    mesh.colors.emplace_back(static_cast<float>(share), static_cast<float>(1 - share * share), 0.7f, 1.0f);
  }
  return mesh;
}

Mesh inBytes(Mesh mesh) {
  for (Rgba& color : mesh.colors)
    color = asRgba8(color);
  return mesh;
}

/// The most by which a channel of a site's colours is off. Vertices are told apart by their positions and colours.
double colorDistance(const std::filesystem::path& site, const Mesh& mesh) {
  const Mesh read = readMeshes(openDocument(site)).meshes.at(0);
  const double slack = 1e-3 * boxOf(mesh).longestEdge();
  double worst = 0;
  for (std::size_t wedge = 0; wedge < read.wedgeCount(); ++wedge) {
    double nearest = 1;
    for (std::size_t other = 0; other < mesh.wedgeCount(); ++other) {
      const Vec3f off = read.positions[read.wedgePositions[wedge]] - mesh.positions[mesh.wedgePositions[other]];
      double distance = 0;
      for (float Rgba::*channel : {&Rgba::r, &Rgba::g, &Rgba::b, &Rgba::a})
        distance = std::max(distance, std::abs(double{read.colors[wedge].*channel} - mesh.colors[other].*channel));
      if (length(off) < slack)
        nearest = std::min(nearest, distance);
    }
    worst = std::max(worst, nearest);
  }
  return worst;
}

ConvertOptions optionsFor(Encoding encoding, std::uint32_t bits) {
  ConvertOptions options;
  options.encoding = encoding;
  options.colorBits = bits;
  options.pictures = false;
  return options;
}

TEST(ColorPrecision, IsThatOfTheSourceUpToTheBitsAskedFor) {
  const TemporaryDirectory directory;
  const Mesh mesh = tintedTorus();
  testing::writeMesh(directory / "in.ply", mesh);
  for (const auto& [encoding, bits, steps] :
       {std::tuple(Encoding::classic, 8u, 255.0), std::tuple(Encoding::classic, 16u, 65535.0),
        std::tuple(Encoding::classic, 24u, 16777215.0), std::tuple(Encoding::bg, 16u, 65535.0),
        std::tuple(Encoding::bg, 32u, 16777215.0), std::tuple(Encoding::compact, 8u, 255.0)}) {
    SCOPED_TRACE(::testing::Message() << nameOf(encoding) << " " << bits);
    const ConvertReport report = convert(directory / "in.ply", directory / "site", optionsFor(encoding, bits));
    const VerifyReport verified = verify(directory / "site", directory / "in.ply");
    EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
    const double distance = colorDistance(directory / "site", mesh);
    EXPECT_LE(distance, report.colorError);
    EXPECT_GT(report.colorError, 0);
    EXPECT_LE(report.colorError, 0.5 / steps + 3e-7);
  }
}

TEST(ColorPrecision, OfEightBitsGivesTheBytesOfASourceOfBytes) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "floats.ply", tintedTorus());
  testing::writeMesh(directory / "bytes.ply", inBytes(tintedTorus()));
  EXPECT_NE(readFile(directory / "floats.ply").size(), readFile(directory / "bytes.ply").size());
  for (const Encoding encoding : {Encoding::compact, Encoding::classic, Encoding::bg}) {
    const ConvertReport rounded = convert(directory / "floats.ply", directory / "a", optionsFor(encoding, 0)),
                        exact = convert(directory / "bytes.ply", directory / "b", optionsFor(encoding, 0));
    EXPECT_EQ(exact.colorError, 0);
    EXPECT_NEAR(rounded.colorError, 0.5 / 255, 1e-4);
    EXPECT_EQ(testing::contentsOf(directory / "a/geometry"), testing::contentsOf(directory / "b/geometry"));
  }
}

TEST(ColorPrecision, IsComparedByVerifyToWhatTheSiteStates) {
  const TemporaryDirectory directory;
  Mesh mesh = tintedTorus();
  testing::writeMesh(directory / "in.ply", mesh);
  convert(directory / "in.ply", directory / "site", optionsFor(Encoding::classic, 16));
  mesh.colors[17].g += 2.0f / 65535; // less than a step of 8 bits
  testing::writeMesh(directory / "other.ply", mesh);
  const VerifyReport verified = verify(directory / "site", directory / "other.ply");
  ASSERT_EQ(verified.findings.size(), 1u);
  EXPECT_NE(verified.findings[0].find("have other colours: a channel is off by up to 0.00"), std::string::npos)
      << verified.findings[0];
}

} // namespace
} // namespace imgeo
