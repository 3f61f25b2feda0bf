// Reads sites in the layouts that aopt and other tools wrote for X3DOM 1.7. The tests write the bytes themselves,
// without imgeo's writers, and read them with imgeo's readers.

#include "base/data_url.h"
#include "base/error.h"
#include "base/file.h"
#include "base/testing.h"
#include "containers/png/png.h"
#include "scene/testing.h"
#include "transcode/site/read_meshes.h"
#include "transcode/site/testing.h"

#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <initializer_list>
#include <numbers>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

/// A torus, longer than wide and wider than high, with every attribute, far from the origin.
Mesh sourceMesh() {
  Mesh mesh = testing::torus(24, 11);
  for (Vec3f& p : mesh.positions)
    p = {p.x * 3 + 20, p.y * 2 - 7, p.z + 100};
  testing::Random random(5);
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge)
    mesh.colors.push_back(random.color());
  return mesh;
}

class AoptSite : public ::testing::Test {
protected:
  Mesh mesh = sourceMesh();
  Box3d box = boxOf(mesh);
  TemporaryDirectory directory;
  Bytes index;

  void SetUp() override {
    for (const std::uint32_t corner : mesh.corners)
      appendLittle(index, static_cast<std::uint16_t>(corner));
  }

  Vec3d position(std::size_t wedge) const { return Vec3d(mesh.positions[mesh.wedgePositions[wedge]]); }
  /// The position of a wedge relative to the box: -0.5 .. +0.5 on each axis.
  Vec3d relativePosition(std::size_t wedge) const {
    const Vec3d p = position(wedge) - box.center();
    return {p.x / box.size().x, p.y / box.size().y, p.z / box.size().z};
  }
  /// The positions of all wedges as Float32.
  Bytes floatCoords() const {
    Bytes coords;
    for (std::size_t w = 0; w < mesh.wedgeCount(); ++w)
      for (int axis = 0; axis < 3; ++axis)
        appendLittle(coords, static_cast<float>(position(w)[axis]));
    return coords;
  }
  std::int16_t int16(double value) const { return static_cast<std::int16_t>(std::lround(32767 * value)); }

  void write(const std::string& name, const Bytes& bytes) { writeFile(directory.path() / name, bytes); }

  std::string boxFields() const {
    const Vec3d center = box.center(), size = box.size();
    return fmt::format("position='{} {} {}' size='{} {} {}'", center.x, center.y, center.z, size.x, size.y, size.z);
  }

  /// The scene that the readers return for a page with a Shape of this geometry node.
  Scene readPage(const std::string& node) const {
    const std::string page = "<!DOCTYPE html><html><body><X3D><Scene><Shape DEF='torus'><Appearance>"
                             "<Material diffuseColor='1 0 0'></Material></Appearance>" +
                             node + "</Shape></Scene></X3D></body></html>";
    writeFile(directory.path() / "index.html", asBytes(page));
    return readMeshes(openDocument(directory.path()));
  }

  /// The only mesh of that scene.
  Mesh readBack(const std::string& node) const {
    const Scene scene = readPage(node);
    EXPECT_EQ(testing::shapeName(scene.graph, 0), "torus");
    const AnyMaterial& material = testing::appearanceOf(scene.graph, 0).material;
    EXPECT_EQ(material, node.find("lit='false'") != node.npos ? AnyMaterial(UnlitMaterial{.emissiveColor = {0, 0, 0}})
                                                              : AnyMaterial(Material{.diffuseColor = {1, 0, 0}}));
    return scene.meshes.at(0);
  }

  /// Expects the same triangles in the same order. `positionShare` is relative to the box; 0 for normals or texture
  /// coordinates means that the site has none.
  void expectEqual(const Mesh& read, double positionShare, double normalDegrees, double texCoord) {
    ASSERT_EQ(read.corners.size(), mesh.corners.size());
    EXPECT_EQ(read.positions.size(), mesh.positions.size());
    EXPECT_EQ(read.normals.empty(), normalDegrees == 0);
    EXPECT_EQ(read.texCoords.empty(), texCoord == 0);
    const Vec3d size = box.size();
    for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner) {
      const std::uint32_t r = read.corners[corner], w = mesh.corners[corner];
      const Vec3d off = Vec3d(read.positions[read.wedgePositions[r]]) - position(w);
      for (int axis = 0; axis < 3; ++axis)
        ASSERT_LE(std::abs(off[axis]), positionShare * size[axis] + 1e-5) << "axis " << axis; // 1e-5: floats near 100
      if (normalDegrees > 0) {
        const Vec3d n = cross(Vec3d(read.normals[r]), Vec3d(mesh.normals[w]));
        ASSERT_LE(std::asin(std::min(length(n), 1.0)) * 180 / std::numbers::pi, normalDegrees);
        ASSERT_GT(dot(read.normals[r], mesh.normals[w]), 0);
      }
      if (texCoord > 0) {
        ASSERT_NEAR(read.texCoords[r].x, mesh.texCoords[w].x, texCoord);
        ASSERT_NEAR(read.texCoords[r].y, mesh.texCoords[w].y, texCoord);
      }
      if (!read.colors.empty()) {
        ASSERT_EQ(read.colors[r], mesh.colors[w]);
      }
    }
  }

  /// Verifies the site against the mesh as a PLY file, which has only the given attributes.
  VerifyReport verified(bool normals, bool texCoords, bool colors) const {
    Mesh input = mesh;
    if (!normals)
      input.normals.clear();
    if (!texCoords)
      input.texCoords.clear();
    if (!colors)
      input.colors.clear();
    const TemporaryDirectory inputs;
    testing::writeMesh(inputs / "in.ply", input);
    return verify(directory.path(), inputs / "in.ply");
  }
  void expectVerified(bool normals, bool texCoords, bool colors) const {
    const VerifyReport report = verified(normals, texCoords, colors);
    EXPECT_TRUE(report.isForeign);
    EXPECT_TRUE(report.equal) << ::testing::PrintToString(report.findings);
    EXPECT_EQ(report.site.triangles, mesh.elementCount());
    EXPECT_LE(report.positionError, report.positionBound);
  }

  /// Expects that info, export, verify and convert find these elements in the page.
  void expectElements(const ElementCounts& expected) const {
    const auto expectEach = [&](const ElementCounts& found) {
      EXPECT_EQ(found.triangles, expected.triangles);
      EXPECT_EQ(found.lines, expected.lines);
      EXPECT_EQ(found.points, expected.points);
    };
    expectEach(inspect(directory.path()).elements);
    const TemporaryDirectory made;
    expectEach(exportSite(directory.path(), made / "out.glb").elements);
    convert(directory.path() / "index.html", made / "site", ConvertOptions{});
    for (const std::filesystem::path& site : {made / "site", directory.path()}) {
      const VerifyReport report = verify(site, directory.path() / "index.html");
      EXPECT_TRUE(report.equal) << site << ::testing::PrintToString(report.findings);
      expectEach(report.site);
    }
  }

  /// Writes a site with Int16 coordinates relative to the center; `round` converts them to integers.
  void writeSigned(const std::function<std::int16_t(double)>& round) {
    Bytes coords, normals;
    for (std::size_t w = 0; w < mesh.wedgeCount(); ++w) {
      for (int axis = 0; axis < 3; ++axis) {
        appendLittle(coords, round(32767 * relativePosition(w)[axis]));
        normals.push_back(static_cast<std::uint8_t>(std::lround(127 * mesh.normals[w][axis])));
      }
      appendLittle(coords, std::int16_t{0});
      normals.push_back(0);
    }
    write("i.bin", index);
    write("c.bin+8", coords);
    write("n.bin+4", normals);
    readBack("<BinaryGeometry " + boxFields() + " " + draws() +
             " index='i.bin' coord='c.bin+8' normal='n.bin+4' coordType='Int16' "
             "normalType='Int8'></BinaryGeometry>");
  }

  std::string draws() const { return fmt::format("primType='\"TRIANGLES\"' vertexCount='{}'", mesh.corners.size()); }
};

TEST_F(AoptSite, IsReadWithSeparateFilesNamedByTheirStride) {
  Bytes coords, normals, texCoords, colors;
  for (std::size_t w = 0; w < mesh.wedgeCount(); ++w) {
    for (int axis = 0; axis < 3; ++axis) {
      appendLittle(coords, int16(relativePosition(w)[axis]));
      normals.push_back(static_cast<std::uint8_t>(std::lround(127 * mesh.normals[w][axis])));
    }
    appendLittle(coords, std::int16_t{0});
    normals.push_back(0);
    appendLittle(texCoords, static_cast<std::uint16_t>(std::lround(65535 * mesh.texCoords[w].x)));
    appendLittle(texCoords, static_cast<std::uint16_t>(std::lround(65535 * mesh.texCoords[w].y)));
    const Rgba8 color = asRgba8(mesh.colors[w]);
    colors.insert(colors.end(), {color.r, color.g, color.b, 0});
  }
  write("i.bin", index);
  write("c.bin+8", coords);
  write("n.bin+4", normals);
  write("t.bin+4", texCoords);
  write("k.bin+4", colors);
  const Mesh read =
      readBack("<BinaryGeometry " + boxFields() + " " + draws() +
               " index='i.bin' coord='c.bin+8' normal='n.bin+4' texCoord='t.bin+4' color='k.bin+4'"
               " coordType='Int16' normalType='Int8' texCoordType='Uint16' colorType='Uint8'></BinaryGeometry>");
  expectEqual(read, 0.5 / 32767, 0.4, 0.51 / 65535);
  EXPECT_FALSE(read.colors.empty());
  expectVerified(true, true, true);
}

TEST_F(AoptSite, IsReadWithInterleavedRecords) {
  Bytes records;
  for (std::size_t w = 0; w < mesh.wedgeCount(); ++w) {
    for (int axis = 0; axis < 3; ++axis)
      appendLittle(records, int16(relativePosition(w)[axis]));
    appendLittle(records, std::int16_t{0});
    for (int axis = 0; axis < 3; ++axis)
      appendLittle(records, int16(mesh.normals[w][axis]));
    appendLittle(records, std::int16_t{0});
    appendLittle(records, int16(mesh.texCoords[w].x));
    appendLittle(records, int16(mesh.texCoords[w].y));
    appendLittle(records, std::uint32_t{0});
  }
  write("i.bin", index);
  write("v.bin", records);
  expectEqual(readBack("<BinaryGeometry " + boxFields() + " vertexCount='0'" +
                       " index='i.bin' coord='v.bin#0+24' normal='v.bin#8+24' texCoord='v.bin#16+24'"
                       " coordType='Int16' normalType='Int16' texCoordType='Int16'></BinaryGeometry>"),
              0.5 / 32767, 0.01, 0.51 / 32767);
  expectVerified(true, true, false);
}

TEST_F(AoptSite, IsReadWithNormalsAsSphericalCoordinates) {
  Bytes records;
  for (std::size_t w = 0; w < mesh.wedgeCount(); ++w) {
    for (int axis = 0; axis < 3; ++axis)
      appendLittle(records, static_cast<std::uint16_t>(std::lround(65535 * (relativePosition(w)[axis] + 0.5))));
    const Vec3f n = mesh.normals[w];
    const double theta = std::acos(n.z) / std::numbers::pi * 255;
    const double phi = (std::atan2(n.y, n.x) / (2 * std::numbers::pi) + 0.5) * 255;
    appendLittle(records, static_cast<std::uint16_t>(256 * std::lround(theta) + std::lround(phi)));
  }
  write("i.bin", index);
  write("c.bin+8", records);
  expectEqual(readBack("<BinaryGeometry " + boxFields() + " " + draws() +
                       " index='i.bin' coord='c.bin+8' coordType='Uint16' "
                       "normalAsSphericalCoordinates='true'></BinaryGeometry>"),
              0.5 / 65535, 0.8, 0);
  expectVerified(true, false, false);
}

TEST_F(AoptSite, IsReadWithPlainFloats) {
  Bytes coords, normals, texCoords;
  for (std::size_t w = 0; w < mesh.wedgeCount(); ++w) {
    for (int axis = 0; axis < 3; ++axis) {
      appendLittle(coords, static_cast<float>(position(w)[axis]));
      appendLittle(normals, mesh.normals[w][axis]);
    }
    appendLittle(texCoords, mesh.texCoords[w].x + 7); // only Float32 holds values outside 0..1
    appendLittle(texCoords, mesh.texCoords[w].y);
  }
  write("i.bin", index);
  write("c.bin", coords);
  write("n.bin", normals);
  write("t.bin", texCoords);
  for (Vec2f& texCoord : mesh.texCoords)
    texCoord.x += 7;
  expectEqual(readBack("<BinaryGeometry " + boxFields() + " " + draws() +
                       " index='i.bin' coord='c.bin' normal='n.bin' texCoord='t.bin'></BinaryGeometry>"),
              0, 1e-4, 1e-7);
  expectVerified(true, true, false);
}

TEST_F(AoptSite, IsReadWithImagesAsImageTextures) {
  constexpr std::uint32_t width = 128, height = 4; // X3DOM scales the bytes of an index to these edges
  ASSERT_LE(mesh.wedgeCount(), width * height);
  const auto imageOf = [&](std::uint32_t columns, std::uint32_t rows, std::uint32_t channels) {
    return Image{columns, rows, channels, Bytes(std::size_t{columns} * rows * channels)};
  };
  Image high = imageOf(width, height, 3), low = high, normals = high, texCoords = imageOf(width, height, 4);
  for (std::size_t w = 0; w < mesh.wedgeCount(); ++w) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const long stored = std::lround(65535 * (relativePosition(w)[static_cast<int>(axis)] + 0.5));
      high.pixels[3 * w + axis] = static_cast<std::uint8_t>(stored >> 8);
      low.pixels[3 * w + axis] = static_cast<std::uint8_t>(stored);
      normals.pixels[3 * w + axis] =
          static_cast<std::uint8_t>(std::lround(127.5 * (mesh.normals[w][static_cast<int>(axis)] + 1)));
    }
    const long u = std::lround(65535 * mesh.texCoords[w].x), v = std::lround(65535 * mesh.texCoords[w].y);
    const long channels[] = {u >> 8, v >> 8, u & 255, v & 255};
    for (std::size_t c = 0; c < 4; ++c)
      texCoords.pixels[4 * w + c] = static_cast<std::uint8_t>(channels[c]);
  }
  Image indices = imageOf(64, 64, 3);
  const std::uint32_t columns = 60; // of the implicit mesh; the image is wider
  for (std::uint32_t n = 0; n < mesh.corners.size(); ++n) {
    const std::uint32_t record = mesh.corners[n], texel = n / columns * 64 + n % columns;
    indices.pixels[3 * texel] = static_cast<std::uint8_t>(record % width * 256 / width);
    indices.pixels[3 * texel + 1] = static_cast<std::uint8_t>(record / width * 256 / height);
  }
  write("i.png", encodePng(indices, 1));
  write("c0.png", encodePng(high, 1));
  write("c1.png", encodePng(low, 1));
  write("n.png", encodePng(normals, 1));
  write("t.png", encodePng(texCoords, 1));
  const auto texture = [](const std::string& role, const std::string& url) {
    return "<ImageTexture containerField='" + role + "' url='" + url +
           "' scale='false'><TextureProperties></TextureProperties></ImageTexture>";
  };
  expectEqual(readBack("<ImageGeometry " + boxFields() + " " + draws() + " implicitMeshSize='60 27'>" +
                       texture("index", "i.png") + texture("coord", "c0.png") + texture("coord", "c1.png") +
                       texture("normal", "n.png") + texture("texCoord", "t.png") + "</ImageGeometry>"),
              0.5 / 65535, 0.4, 0.51 / 65535);
  expectVerified(true, true, false);
}

TEST_F(AoptSite, IsReadAndExportedFromDataUrls) {
  const Bytes coords = floatCoords();
  const auto url = [](const Bytes& bytes) { return dataUrlOf(bytes, "application/octet-stream"); };
  expectEqual(readBack("<BinaryGeometry " + boxFields() + " " + draws() + " index='" + url(index) + "' coord='" +
                       url(coords) + "'></BinaryGeometry>"),
              0, 0, 0);
  const SiteInfo info = inspect(directory.path());
  EXPECT_EQ(info.elements.triangles, mesh.elementCount());
  EXPECT_EQ(info.containerBytes, 0u);
  EXPECT_EQ(exportSite(directory.path(), directory.path() / "out.ply").elements.triangles, mesh.elementCount());
  expectVerified(false, false, false);
  EXPECT_THROW(readBack("<BinaryGeometry " + boxFields() + " coord='data:;base64,*'></BinaryGeometry>"), Error);
}

TEST_F(AoptSite, IsReadWithTrianglesLinesAndPointsInOneNode) {
  Bytes mixed = index;
  const Bytes coords = floatCoords();
  for (const std::uint16_t vertex : std::initializer_list<std::uint16_t>{0, 1, 2, 3, 4, 5, 6, 7})
    appendLittle(mixed, vertex);
  write("i.bin", mixed);
  write("c.bin", coords);
  const Scene scene = readPage(
      "<BinaryGeometry " + boxFields() +
      fmt::format(" primType='\"TRIANGLES\" \"LINESTRIP\" \"POINTS\"' vertexCount='{} 3 5'", mesh.corners.size()) +
      " index='i.bin' coord='c.bin'></BinaryGeometry>");
  ASSERT_EQ(scene.meshes.size(), 3u);
  expectEqual(scene.meshes[0], 0, 0, 0);
  EXPECT_EQ(scene.meshes[1].topology, Topology::lines);
  EXPECT_EQ(scene.meshes[2].topology, Topology::points);
  const auto expectPositions = [&](const Mesh& part, const std::vector<std::size_t>& wedges) {
    ASSERT_EQ(part.corners.size(), wedges.size());
    for (std::size_t corner = 0; corner < wedges.size(); ++corner)
      EXPECT_EQ(part.cornerPosition(corner), Vec3f(position(wedges[corner])));
  };
  expectPositions(scene.meshes[1], {0, 1, 1, 2});
  expectPositions(scene.meshes[2], {3, 4, 5, 6, 7});
  EXPECT_EQ(scene.meshes[2].positions.size(), 5u) << "vertices of the other elements";
  ASSERT_EQ(scene.graph.roots.size(), 1u);
  EXPECT_EQ(scene.graph.nodes[scene.graph.roots[0]].name, "torus"); // a Group of the three shapes

  expectElements({mesh.elementCount(), 2, 5});
}

TEST_F(AoptSite, IsReadWithLinesAndPointsInOneImage) {
  Image high{3, 3, 3, Bytes(27)}, low = high;
  for (std::size_t w = 0; w < 9; ++w)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const long stored = std::lround(65535 * (relativePosition(w)[static_cast<int>(axis)] + 0.5));
      high.pixels[3 * w + axis] = static_cast<std::uint8_t>(stored >> 8);
      low.pixels[3 * w + axis] = static_cast<std::uint8_t>(stored);
    }
  write("c0.png", encodePng(high, 1));
  write("c1.png", encodePng(low, 1));
  const Scene scene = readPage("<ImageGeometry " + boxFields() +
                               " implicitMeshSize='3 3' primType='\"POINTS\" \"LINES\" \"POINTS\"' vertexCount='2 4 3'"
                               " coord='\"c0.png\" \"c1.png\"'></ImageGeometry>");
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.meshes[0].topology, Topology::points);
  EXPECT_EQ(scene.meshes[1].topology, Topology::lines);
  const auto expectPositions = [&](const Mesh& part, const std::vector<std::size_t>& wedges) {
    ASSERT_EQ(part.corners.size(), wedges.size());
    for (std::size_t corner = 0; corner < wedges.size(); ++corner)
      EXPECT_LT(length(Vec3d(part.cornerPosition(corner)) - position(wedges[corner])), 2e-4); // a box of 65,535 steps
  };
  expectPositions(scene.meshes[0], {0, 1, 6, 7, 8});
  expectPositions(scene.meshes[1], {2, 3, 4, 5});
  expectElements({0, 2, 5});
}

TEST_F(AoptSite, IsReadWithTrianglesAndPointsInPatchesOfOneNode) {
  std::string patches;
  for (const std::size_t first : {std::size_t{0}, std::size_t{30}}) {
    Bytes coords;
    Box3d patchBox;
    for (std::size_t w = first; w < first + 6; ++w) {
      patchBox.add(position(w));
      for (int axis = 0; axis < 3; ++axis)
        appendLittle(coords, static_cast<float>(position(w)[axis]));
    }
    const std::string url = fmt::format("c{}.bin", first);
    write(url, coords);
    const Vec3d center = patchBox.center(), size = patchBox.size();
    patches +=
        fmt::format("<GeometryPatch bboxCenter='{} {} {}' bboxSize='{} {} {}' coord='{}' recordCount='6' "
                    "vertexCount='6' primType='\"{}\"'></GeometryPatch>",
                    center.x, center.y, center.z, size.x, size.y, size.z, url, first == 0 ? "TRIANGLES" : "POINTS");
  }
  const Scene scene = readPage("<BinaryGeometry " + boxFields() + ">" + patches + "</BinaryGeometry>");
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.meshes[0].elementCount(), 2u);
  EXPECT_EQ(scene.meshes[1].elementCount(), 6u);
  EXPECT_EQ(scene.meshes[1].cornerPosition(5), Vec3f(position(35)));
  expectElements({2, 0, 6});
}

TEST_F(AoptSite, EqualsItsInputAlthoughItsWriterComputedInSinglePrecision) {
  writeSigned([](double v) { return static_cast<std::int16_t>(std::lround(v + (v > 0 ? 0.03 : -0.03))); });
  expectVerified(true, false, false);
}

TEST_F(AoptSite, DiffersFromItsInputIfItsWriterTruncatedInsteadOfRounding) {
  writeSigned([](double v) { return static_cast<std::int16_t>(v); });
  const VerifyReport report = verified(true, false, false);
  EXPECT_FALSE(report.equal);
  EXPECT_GT(report.missing.triangles, 0u);
}

TEST_F(AoptSite, EqualsAnInputWithoutNormals) {
  writeSigned([](double v) { return static_cast<std::int16_t>(std::lround(v)); });
  expectVerified(true, false, false);
  expectVerified(false, false, false);
  EXPECT_FALSE(verified(true, true, false).equal) << "the input has texture coordinates that the site lacks";
}

TEST_F(AoptSite, MayHaveFloatsOutsideOfItsBoxAndFlatShading) {
  Bytes coords, normals;
  for (std::size_t w = 0; w < mesh.wedgeCount(); ++w)
    for (int axis = 0; axis < 3; ++axis) {
      appendLittle(coords, static_cast<float>(position(w)[axis]));
      appendLittle(normals, axis == 0 ? 1.F : 0.F);
    }
  write("i.bin", index);
  write("c.bin", coords);
  write("n.bin", normals);
  const std::string files = draws() + " index='i.bin' coord='c.bin' normal='n.bin'";
  for (const std::string stated : {"", "position='0 0 0' size='0 0 0'", "size='1e9 1e9 1e9'"}) {
    SCOPED_TRACE(stated);
    const Mesh read =
        readBack("<BinaryGeometry " + stated + " " + files + " normalPerVertex='false'></BinaryGeometry>");
    EXPECT_EQ(boxOf(read), box);
    for (std::size_t corner = 0; corner < read.corners.size(); ++corner) {
      const std::size_t first = corner - corner % 3;
      const Vec3d a(read.cornerPosition(first)), b(read.cornerPosition(first + 1)), c(read.cornerPosition(first + 2)),
          normal = cross(b - a, c - a);
      ASSERT_GT(dot(normal, Vec3d(read.normals[read.corners[corner]])), 0.999 * length(normal));
    }
    expectElements({mesh.elementCount(), 0, 0});
  }
}

TEST_F(AoptSite, WithFlatShadingIsComparedValueByValue) {
  const Bytes coords = floatCoords();
  write("i.bin", index);
  write("c.bin", coords);
  readPage("<BinaryGeometry " + draws() + " index='i.bin' coord='c.bin' normalPerVertex='false'></BinaryGeometry>");
  const TemporaryDirectory made;
  exportSite(directory.path(), made / "flat.ply");
  const auto verified = [&] { return verify(directory.path(), made / "flat.ply"); };
  EXPECT_TRUE(verified().equal) << ::testing::PrintToString(verified().findings);
  const auto expectDifferent = [&](const char* name, Bytes bytes, std::size_t at) {
    const Bytes whole = bytes;
    bytes[at] ^= 0x40;
    write(name, bytes);
    EXPECT_FALSE(verified().equal) << name;
    write(name, whole);
  };
  expectDifferent("c.bin", coords, 12 * 7 + 2);
  expectDifferent("i.bin", index, 60);
  readPage("<BinaryGeometry " + draws() + " index='i.bin' coord='c.bin'></BinaryGeometry>");
  EXPECT_FALSE(verified().equal) << "the site lacks normals";
}

TEST_F(AoptSite, WithoutAnIndexAndACountHasAllRecordsOfItsFile) {
  Bytes coords;
  for (const std::uint32_t corner : mesh.corners)
    for (int axis = 0; axis < 3; ++axis)
      appendLittle(coords, static_cast<float>(position(corner)[axis]));
  write("c.bin", coords);
  readPage("<BinaryGeometry coord='c.bin'></BinaryGeometry>");
  expectElements({mesh.elementCount(), 0, 0});
}

TEST_F(AoptSite, ThatIsNotLitIsExportedAndConvertedAgainAsUnlit) {
  Bytes coords, colors;
  for (std::size_t w = 0; w < mesh.wedgeCount(); ++w)
    for (int axis = 0; axis < 3; ++axis) {
      appendLittle(coords, static_cast<float>(position(w)[axis]));
      appendLittle(colors, static_cast<float>(axis) / 2);
    }
  write("i.bin", index);
  write("c.bin", coords);
  write("k.bin", colors);
  const std::string files = draws() + " index='i.bin' coord='c.bin' lit='false'";
  for (const bool hasColors : {false, true}) {
    readPage("<BinaryGeometry " + boxFields() + " " + files + (hasColors ? " color='k.bin'" : "") +
             "></BinaryGeometry>");
    const TemporaryDirectory made;
    exportSite(directory.path(), made / "out.glb");
    convert(made / "out.glb", made / "site", ConvertOptions{});
    const VerifyReport report = verify(made / "site", made / "out.glb");
    EXPECT_TRUE(report.equal) << ::testing::PrintToString(report.findings);
    const SiteDocument document = openDocument(made / "site");
    EXPECT_EQ(testing::appearanceOf(document.scene.graph, 0).material,
              AnyMaterial(UnlitMaterial{.emissiveColor = hasColors ? Vec3f{1, 1, 1} : Vec3f{0, 0, 0}}));
    EXPECT_EQ(readMeshes(document).meshes.at(0).colors.empty(), !hasColors);
  }
}

TEST_F(AoptSite, CanBeInspectedAndExported) {
  const Bytes coords = floatCoords();
  write("i.bin", index);
  write("c.bin", coords);
  readBack("<BinaryGeometry " + boxFields() + " " + draws() +
           " index='i.bin' coord='c.bin' lit='false'></BinaryGeometry>");
  const SiteInfo info = inspect(directory.path());
  EXPECT_EQ(info.elements.triangles, mesh.elementCount());
  EXPECT_EQ(info.vertices, mesh.wedgeCount());
  EXPECT_EQ(info.containerBytes, index.size() + coords.size());
  const ExportReport report = exportSite(directory.path(), directory.path() / "out.ply");
  EXPECT_EQ(report.elements.triangles, mesh.elementCount());
  EXPECT_EQ(report.vertices, mesh.positions.size()); // without attributes, seams are welded
  EXPECT_EQ(report.bytes, std::filesystem::file_size(directory.path() / "out.ply"));
}

} // namespace
} // namespace imgeo
