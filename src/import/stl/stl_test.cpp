#include "import/stl/testing.h"
#include "import/testing.h"

#include "scene/testing.h"

#include <fmt/format.h>
#include <limits>
#include <vector>

namespace imgeo::testing {
namespace {

std::vector<Vec3f> cornerPositions(const Mesh& mesh) {
  std::vector<Vec3f> result;
  for (std::size_t at = 0; at < mesh.corners.size(); ++at)
    result.push_back(mesh.cornerPosition(at));
  return result;
}

std::string asciiStl(const Mesh& mesh, const std::string& name = "thing") {
  std::string text = "solid " + name + "\n";
  for (std::size_t at = 0; at < mesh.corners.size(); at += 3) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f p = mesh.cornerPosition(at + k);
      text += fmt::format("   vertex {} {} {}\n", p.x, p.y, p.z);
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid " + name + "\n";
}

TEST(Stl, KeepsEveryTriangleInBothForms) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = randomMesh(seed);
    if (mesh.topology != Topology::triangles)
      continue;
    EXPECT_EQ(cornerPositions(onlyMesh(testing::binaryStl(mesh), "m.stl")), cornerPositions(mesh));
    EXPECT_EQ(cornerPositions(onlyMesh(asciiStl(mesh), "m.stl")), cornerPositions(mesh));
  }
}

TEST(Stl, LinesMayEndWithCarriageReturnsAlone) {
  const std::string text = "solid a\rfacet normal 0 0 1\router loop\rvertex 0 0 0\rvertex 1 0 0\rvertex 0 1 0\r"
                           "endloop\rendfacet\rendsolid a\r";
  EXPECT_EQ(cornerPositions(onlyMesh(text, "a.stl")), (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST(Stl, BinaryFilesMayBeginWithSolid) {
  const Mesh mesh = sphere(4, 5);
  EXPECT_EQ(onlyMesh(testing::binaryStl(mesh, "solid facet normal"), "m.stl").elementCount(), mesh.elementCount());
  Bytes longer = testing::binaryStl(mesh, "solid");
  longer.push_back(0);
  const Imported imported = importBytes(longer, "m.stl");
  EXPECT_EQ(imported.scene.meshes.at(0).elementCount(), mesh.elementCount());
  EXPECT_EQ(imported.warnings,
            std::vector<std::string>{"1 byte stands behind the last facet of the STL file, which imgeo ignored."});
}

TEST(Stl, EverySolidIsAShape) {
  const Imported imported = importBytes(asBytes(asciiStl(grid(1), "a") + asciiStl(grid(2), "b")), "m.stl");
  ASSERT_EQ(shapeNodes(imported.scene.graph).size(), 2u);
  EXPECT_EQ(testing::shapeName(imported.scene.graph, 1), "b");
  EXPECT_EQ(imported.scene.meshes[1].elementCount(), 8u);
}

TEST(Stl, EveryProperPrefixIsRefused) {
  const Bytes binary = testing::binaryStl(grid(2));
  for (std::size_t size = 0; size < binary.size(); ++size)
    EXPECT_THROW(importBytes(ByteSpan(binary).first(size), "m.stl"), Error) << size;
  const std::string text = asciiStl(grid(2));
  for (std::size_t size = 0; size < text.find("endsolid") + 8; ++size)
    EXPECT_THROW(importBytes(asBytes(text).first(size), "m.stl"), Error) << size;
}

TEST(Stl, WarnsAboutFacetColours) {
  Bytes bytes = testing::binaryStl(grid(1));
  bytes.back() = 0x80;
  EXPECT_EQ(importBytes(bytes, "m.stl").warnings.size(), 1u);
}

TEST(Stl, WarnsOfCoordinatesOfTextThatSinglePrecisionRounds) {
  const auto warningsOf = [](const std::string& x) {
    const std::string text = "solid\nfacet normal 0 0 1\nouter loop\nvertex " + x + "25 0 0\nvertex " + x +
                             "5 0 0\nvertex " + x + "5 1 0\nendloop\nendfacet\nendsolid\n";
    return importBytes(asBytes(text), "m.stl").warnings;
  };
  EXPECT_EQ(
      warningsOf("60000.001"),
      std::vector<std::string>{"Coordinates far from the origin were rounded to single precision, by up to 0.0015."});
  EXPECT_TRUE(warningsOf("60000.").empty()); // single precision holds these
}

TEST(Stl, RefusesWithOneSentenceAndALocation) {
  Bytes many = testing::binaryStl(grid(1));
  many[83] = 0xff;
  EXPECT_EQ(errorOf(many, "m.stl").kind(), ErrorKind::truncated);
  EXPECT_EQ(errorOf(many, "m.stl").location(), "m.stl, byte 80");

  Mesh mesh = grid(1);
  mesh.positions[3].z = std::numeric_limits<float>::infinity();
  EXPECT_EQ(errorOf(testing::binaryStl(mesh), "m.stl").location(),
            "m.stl, byte 120"); // third corner of the first facet
  EXPECT_EQ(errorOf(asciiStl(mesh), "m.stl").location(), "m.stl:6");

  EXPECT_EQ(
      errorOf("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\nendfacet\nendsolid\n", "m.stl").location(),
      "m.stl:5");
  EXPECT_EQ(errorOf("solid\nfacet normal 0 0 1\nvertex 0 0 0\nendsolid\n", "m.stl").location(), "m.stl:4");
  EXPECT_EQ(errorOf("solid\nfacets\nendsolid\n", "m.stl").location(), "m.stl:2");
  EXPECT_EQ(errorOf(testing::binaryStl(Mesh{}), "m.stl").kind(), ErrorKind::malformed);
}

} // namespace
} // namespace imgeo::testing
