#include "base/file.h"
#include "base/testing.h"
#include "import/testing.h"

#include "scene/testing.h"

#include <fmt/format.h>

namespace imgeo::testing {
namespace {

const std::string squareText = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::string numbers(const char* keyword, Vec3f p) {
  return fmt::format("{} {} {} {}\n", keyword, p.x, p.y, p.z);
}

/// The OBJ text of a mesh, with one vt and vn per wedge; faces use negative indices on request.
std::string objText(const Mesh& mesh, bool fromTheEnd) {
  std::string text;
  for (const Vec3f& p : mesh.positions)
    text += numbers("v", p);
  for (const Vec2f& t : mesh.texCoords)
    text += fmt::format("vt {} {}\n", t.x, t.y);
  for (const Vec3f& n : mesh.normals)
    text += numbers("vn", n);
  const auto index = [&](std::size_t i, std::size_t count) {
    return fromTheEnd ? static_cast<std::int64_t>(i) - static_cast<std::int64_t>(count)
                      : static_cast<std::int64_t>(i) + 1;
  };
  for (std::size_t at = 0; at < mesh.corners.size(); ++at) {
    const std::uint32_t wedge = mesh.corners[at];
    text += at % 3 == 0 ? "f" : "";
    text += fmt::format(" {}", index(mesh.wedgePositions[wedge], mesh.positions.size()));
    if (!mesh.texCoords.empty())
      text += fmt::format("/{}", index(wedge, mesh.texCoords.size()));
    else if (!mesh.normals.empty())
      text += "/";
    if (!mesh.normals.empty())
      text += fmt::format("/{}", index(wedge, mesh.normals.size()));
    if (at % 3 == 2)
      text += "\n";
  }
  return text;
}

TEST(Obj, LinesMayEndWithCarriageReturnsAlone) {
  const std::string text = squareText + "f 1 2 3\nf 1 3 4\n";
  std::string returns = "# of an old program\n" + text;
  std::ranges::replace(returns, '\n', '\r');
  const Mesh read = onlyMesh(returns, "m.obj"), expected = onlyMesh(text, "m.obj");
  EXPECT_EQ(read.positions, expected.positions);
  EXPECT_EQ(read.corners, expected.corners);
}

TEST(Obj, KeepsTheAttributesOfEachCorner) {
  for (std::uint32_t seed = 0; seed < 80; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh written = randomMesh(seed);
    if (written.topology != Topology::triangles)
      continue;
    const Mesh read = onlyMesh(objText(written, seed % 2 == 1), "m.obj");
    EXPECT_EQ(read.positions, written.positions);
    EXPECT_EQ(read.normals.empty(), written.normals.empty());
    EXPECT_EQ(read.texCoords.empty(), written.texCoords.empty());
    ASSERT_EQ(read.corners.size(), written.corners.size());
    for (std::size_t at = 0; at < read.corners.size(); ++at) {
      const std::uint32_t r = read.corners[at], w = written.corners[at];
      ASSERT_EQ(read.wedgePositions[r], written.wedgePositions[w]);
      const auto normal = [](const Mesh& mesh, std::uint32_t wedge) {
        return mesh.normals.empty() ? Vec3f{} : mesh.normals[wedge];
      };
      const auto texCoord = [](const Mesh& mesh, std::uint32_t wedge) {
        return mesh.texCoords.empty() ? Vec2f{} : mesh.texCoords[wedge];
      };
      ASSERT_EQ(normal(read, r), normal(written, w));
      ASSERT_EQ(texCoord(read, r), texCoord(written, w));
    }
  }
}

TEST(Obj, MakesAWedgeOfEachCombinationOnce) {
  const Mesh mesh = onlyMesh(squareText + "vt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 1/1 3/1 4/1\nf 1/2 3/1 4/1\n", "m.obj");
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(mesh.wedgeCount(), 5u);
}

TEST(Obj, MakesAWedgeOfEachCombinationOnceForAPositionWithManyWedges) {
  std::string text = squareText;
  constexpr std::uint32_t count = 300;
  for (std::uint32_t i = 1; i <= count; ++i)
    text += fmt::format("vt {} 0\n", i);
  for (int round = 0; round < 2; ++round)
    for (std::uint32_t i = 1; i <= count; ++i)
      text += fmt::format("f 1/{} 2/1 3/1\n", i);
  const Mesh mesh = onlyMesh(text, "m.obj");
  ASSERT_EQ(mesh.wedgeCount(), count + 2);
  for (std::uint32_t face = 0; face < 2 * count; ++face) {
    const std::uint32_t wedge = mesh.corners[3 * face];
    EXPECT_EQ(mesh.wedgePositions[wedge], mesh.wedgePositions[mesh.corners[0]]);
    EXPECT_EQ(mesh.texCoords[wedge].x, static_cast<float>(face % count + 1));
  }
}

TEST(Obj, KeepsObjectsAsShapesWithUniqueNames) {
  const Imported imported = importBytes(
      asBytes("v 9 9 9\n" + squareText + "o a\nf 2 3 4\no empty\no a\nf 2 4 5\no b c \ng x\nf 2 3 5\ng y\nf 2 3 4\n"),
      "m.obj");
  ASSERT_EQ(shapeNodes(imported.scene.graph).size(), 3u);
  EXPECT_EQ(testing::shapeName(imported.scene.graph, 0), "a");
  EXPECT_EQ(testing::shapeName(imported.scene.graph, 1), "a-2");
  EXPECT_EQ(testing::shapeName(imported.scene.graph, 2), "b c");
  EXPECT_EQ(imported.scene.meshes[1].positions, (std::vector<Vec3f>{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(imported.scene.meshes[2].elementCount(), 2u);
  for (const Mesh& mesh : imported.scene.meshes)
    EXPECT_TRUE(isConsistent(mesh));
}

TEST(Obj, CutsPolygonsIntoTriangles) {
  const Mesh mesh = onlyMesh("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 \\\n 3 4 5\n", "m.obj");
  EXPECT_EQ(mesh.elementCount(), 3u);
}

TEST(Obj, ReadsVertexColours) {
  const Mesh mesh = onlyMesh("v 0 0 0\nv 1 0 0 1 0.5 0\nv 0 1 0 1\nf 1 2 3\n", "m.obj");
  EXPECT_EQ(mesh.colors, (std::vector<Rgba>{{1, 1, 1, 1}, {1, 0.5f, 0, 1}, {1, 1, 1, 1}}));
}

TEST(Obj, ReadsPolylinesAsAMeshOfLines) {
  const Mesh mesh = onlyMesh("v 0 0 0\nv 1 0 0\nv 2 0 0\nvt 0 0\nvt 1 0\nl 3/1 1/2 -2/2\nl 1/1 2/2\n", "m.obj");
  EXPECT_EQ(mesh.topology, Topology::lines);
  EXPECT_EQ(mesh.elementCount(), 3u);
  std::vector<float> x;
  for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner)
    x.push_back(mesh.cornerPosition(corner).x);
  EXPECT_EQ(x, (std::vector<float>{2, 0, 0, 1, 0, 1}));
  EXPECT_EQ(mesh.wedgeCount(), 4u); // (3, 1), (1, 2), (2, 2), (1, 1)
}

TEST(Obj, SplitsAnObjectWithFacesAndLinesIntoTwoShapes) {
  const Imported imported =
      importBytes(asBytes("o roof\n" + squareText + "f 1 2 3 4\nl 4 3\no post\nv 9 9 9\nl 1 5\n"), "m.obj");
  ASSERT_EQ(shapeNodes(imported.scene.graph).size(), 3u);
  EXPECT_EQ(testing::shapeName(imported.scene.graph, 0), "roof");
  EXPECT_EQ(testing::shapeName(imported.scene.graph, 1), "roof-2");
  EXPECT_EQ(testing::shapeName(imported.scene.graph, 2), "post");
  EXPECT_EQ(imported.scene.meshes[0].topology, Topology::triangles);
  EXPECT_EQ(imported.scene.meshes[1].topology, Topology::lines);
  EXPECT_EQ(imported.scene.meshes[1].positions, (std::vector<Vec3f>{{0, 1, 0}, {1, 1, 0}}));
  EXPECT_TRUE(imported.warnings.empty());
}

TEST(Obj, WithoutFacesIsAPointCloud) {
  const Mesh mesh = onlyMesh("v 0 0 0\nv 1 0 0\np 1\n", "m.obj");
  EXPECT_EQ(mesh.topology, Topology::points);
  EXPECT_EQ(mesh.elementCount(), 2u);
}

TEST(Obj, WarnsAboutContentThatIsNotCarriedOver) {
  const auto warningsOf = [](const std::string& text) { return importBytes(asBytes(text), "m.obj").warnings; };
  EXPECT_TRUE(warningsOf("# a comment\n" + squareText + "s 1\ng top\nf 1 2 3 4\n").empty());
  EXPECT_EQ(warningsOf(squareText + "mtllib a.mtl\nusemtl red\nl 1\np 1\np 2\nf 1 2\nf 1 2 3\nparm u 0\n"),
            (std::vector<std::string>{
                "Materials are left out: m.obj: refers to \"a.mtl\", which can only be found beside a file, not "
                "beside standard input.",
                "1 material is named but not defined: red.", "1 line was left out: fewer than two corners.",
                "Points of the OBJ file, which has faces or lines, are not carried over (2 statements).",
                "Statements of the OBJ file that imgeo does not read: parm.",
                "1 face was left out: fewer than three corners."}));
  EXPECT_EQ(warningsOf(squareText + "vn 0 0 0\nf 1//1 2//1 3//1\n").at(0),
            "1 normal was replaced by (0, 0, 1): without direction.");
  EXPECT_EQ(warningsOf(squareText + "vn 0 0 1\nf 1//1 2//1 3\n").at(0),
            "The normals of 1 object were left out: some corners have none.");
}

TEST(Obj, StrictRefusesMissingMaterialsAndTextures) {
  const TemporaryDirectory directory;
  writeFile(directory / "lost.mtl", asBytes("newmtl red\nmap_Kd lost.png\n"));
  ImportOptions strict;
  strict.strict = true;
  for (const std::string materials : {"mtllib none.mtl\n", "usemtl red\n", "mtllib lost.mtl\nusemtl red\n"}) {
    writeFile(directory / "a.obj", asBytes(squareText + materials + "f 1 2 3\n"));
    EXPECT_FALSE(importFile(directory / "a.obj").warnings.empty()) << materials;
    EXPECT_THROW(importFile(directory / "a.obj", strict), Error) << materials;
  }
}

TEST(Obj, FindsTexturesBesideTheirLibraryOrBesideTheFile) {
  const TemporaryDirectory directory;
  std::filesystem::create_directories(directory / "my lib" / "maps");
  const auto write = [&](const std::string& file, const std::string& text) {
    writeFile(directory / file, asBytes(text));
  };
  for (const std::string image : {"my lib/maps/a b.png", "both.png", "my lib/both.png", "file.png"})
    write(image, "\x89PNG\r\n\x1a\n...");
  write("my lib/m.mtl", "newmtl a\nmap_Kd maps\\a b.png\nnewmtl b\nmap_Kd both.png\nnewmtl c\nmap_Kd file.png\n"
                        "newmtl d\nmap_Kd C:\\wood.png\n");
  write("m.obj", "mtllib my lib\\m.mtl\n" + squareText +
                     "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 4\nusemtl c\nf 1 3 4\nusemtl d\nf 2 3 4\n");
  const Imported imported = importFile(directory / "m.obj");
  std::vector<std::string> images;
  for (const ImageFile& image : imported.scene.graph.images)
    images.push_back(image.url);
  EXPECT_EQ(images, (std::vector<std::string>{"my lib/maps/a b.png", "my lib/both.png", "file.png"}));
  ASSERT_EQ(imported.warnings.size(), 1u) << ::testing::PrintToString(imported.warnings);
  EXPECT_TRUE(imported.warnings[0].ends_with("C:/wood.png: cannot open: No such file or directory."));
}

TEST(Obj, SaysOnceThatALibraryWithBlanksInItsNameCannotBeRead) {
  const TemporaryDirectory directory;
  writeFile(directory / "here.mtl", asBytes("newmtl red\n"));
  const auto warningsOf = [&](const std::string& libraries) {
    writeFile(directory / "a.obj", asBytes("mtllib " + libraries + "\nusemtl red\n" + squareText + "f 1 2 3\n"));
    return importFile(directory / "a.obj").warnings;
  };
  const std::vector<std::string> none = warningsOf("my old house.mtl");
  ASSERT_EQ(none.size(), 2u);
  EXPECT_NE(none[0].find("my old house.mtl: cannot open"), std::string::npos);
  const std::vector<std::string> one = warningsOf("here.mtl lost.mtl");
  ASSERT_EQ(one.size(), 1u);
  EXPECT_NE(one[0].find("/lost.mtl: cannot open"), std::string::npos);
}

TEST(Obj, WarnsOfCoordinatesThatSinglePrecisionRounds) {
  const auto warningsOf = [](const std::string& x) {
    const std::string text = "v " + x + "25 0 0\nv " + x + "5 0 0\nv " + x + "5 1 0\nf 1 2 3\n";
    return importBytes(asBytes(text), "m.obj").warnings;
  };
  EXPECT_EQ(
      warningsOf("60000.001"),
      std::vector<std::string>{"Coordinates far from the origin were rounded to single precision, by up to 0.0015."});
  EXPECT_TRUE(warningsOf("60000.").empty()); // single precision holds these
}

TEST(Obj, ReadsMaterialsAndTexturesFromReferencedFiles) {
  const TemporaryDirectory directory;
  writeFile(directory / "wood.png", asBytes("\x89PNG\r\n\x1a\n..."));
  writeFile(directory / "my house.mtl", asBytes("newmtl red brick\nKd 1 0 0\nNs 64\nd 0.75\n"
                                                "newmtl oak\nKd 1 1 1\nmap_Kd -s 2 4 -o 1 0 -clamp on wood.png\n"
                                                "map_Bump bumps.png\n"
                                                "newmtl gold\nKd 1 1 0\nPm 1\nPr 0.25\nmap_Kd lost.png\n"));
  writeFile(directory / "a.obj", asBytes("mtllib my house.mtl\n" + squareText +
                                         "o wall\nusemtl red brick\nf 1 2 3\nusemtl oak\nf 1 3 4\nusemtl red brick\n"
                                         "f 2 3 4\no ring\nusemtl gold\nf 1 2 4\n"));
  const Imported imported = importFile(directory / "a.obj");
  const SceneGraph& graph = imported.scene.graph;
  ASSERT_EQ(shapeNodes(graph).size(), 3u);
  EXPECT_EQ(graph.nodes[graph.roots.at(0)].name, "wall");
  EXPECT_EQ(graph.nodes[graph.roots.at(0)].children.size(), 2u);
  EXPECT_EQ(shapeName(graph, 2), "ring");
  EXPECT_EQ(imported.scene.meshes[0].elementCount(), 2u);

  const Material brick = std::get<Material>(appearanceOf(graph, 0).material);
  EXPECT_EQ(appearanceOf(graph, 0).name, "red brick");
  EXPECT_EQ(brick.diffuseColor, (Vec3f{1, 0, 0}));
  EXPECT_EQ(brick.shininess, 0.5f);
  EXPECT_EQ(brick.transparency, 0.25f);
  const TextureUse wood = appearanceOf(graph, 1).textures.at(0);
  EXPECT_EQ(wood.transform.scale, (Vec2f{2, 4}));
  EXPECT_EQ(wood.transform.translation, (Vec2f{0.5f, 0}));
  EXPECT_EQ(graph.textures[wood.texture].boundaryS, Boundary::clamp);
  EXPECT_EQ(graph.images[graph.textures[wood.texture].image].url, "wood.png");
  EXPECT_EQ(std::get<PhysicalMaterial>(appearanceOf(graph, 2).material).metallic, 1);
  EXPECT_TRUE(appearanceOf(graph, 2).textures.empty());
  ASSERT_EQ(imported.warnings.size(), 2u);
  EXPECT_NE(imported.warnings[0].find("lost.png"), std::string::npos);
  EXPECT_NE(imported.warnings[1].find("map_Bump"), std::string::npos);
}

TEST(Obj, SlashesBehindTheLastIndexOfACornerMeanNothing) {
  const Mesh plain = onlyMesh(squareText + "f 1 2 3\n", "m.obj");
  for (const char* face : {"f 1/ 2/ 3/\n", "f 1// 2// 3//\n", "f 1/ 2// 3"}) {
    const Mesh mesh = onlyMesh(squareText + face, "m.obj");
    EXPECT_EQ(mesh.corners, plain.corners) << face;
    EXPECT_TRUE(mesh.texCoords.empty() && mesh.normals.empty()) << face;
  }
  const Mesh mapped = onlyMesh(squareText + "vt 0.5 1\nf 1/1/ 2/1/ 3/1/\n", "m.obj");
  EXPECT_EQ(mapped.texCoords.at(0), (Vec2f{0.5, 1}));
  EXPECT_TRUE(mapped.normals.empty());
}

TEST(Obj, CornersMayNameStatementsFurtherDown) {
  const std::string corners = "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nvn 0 1 0\n";
  const std::string faces = "o a\nusemtl red\nf 1/1/1 2/2/2 3/3/1\nf 3/3/1 4/1/2 1/2/1\no b\nf 4/3/2 3/2/2 2/1/1\n";
  const auto expectSame = [](const std::string& text, const std::string& expected) {
    const Scene read = importBytes(asBytes(text), "m.obj").scene, known = importBytes(asBytes(expected), "m.obj").scene;
    ASSERT_EQ(read.meshes.size(), 2u) << text;
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(read.meshes[i].positions, known.meshes[i].positions) << text;
      EXPECT_EQ(read.meshes[i].texCoords, known.meshes[i].texCoords) << text;
      EXPECT_EQ(read.meshes[i].normals, known.meshes[i].normals) << text;
      EXPECT_EQ(read.meshes[i].corners, known.meshes[i].corners) << text;
    }
  };
  expectSame(squareText + faces + corners, squareText + corners + faces);
  expectSame(corners + faces + squareText, squareText + corners + faces);
  expectSame(faces + corners + squareText, squareText + corners + faces);
  const std::string lines = "o a\nl 1 2 3\no b\nl 4/1 1\n";
  expectSame(lines + squareText + corners, squareText + corners + lines);
  // A concave polygon can be divided only when its vertices are known; until then others wait with their objects.
  const std::string concave = "v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\n";
  const std::string polygons = "o a\nf 2 3 4 1\no b\nf 3/1 4/2 1/1 2/3\n";
  expectSame(polygons + concave + corners, concave + corners + polygons);
}

TEST(Obj, RefusesWithOneSentenceAndALine) {
  struct {
    std::string text, location, words;
  } const cases[] = {
      {"v 0 0\nv 1 0 0\n", "m.obj:1", "the line ends"},
      {"v 0 0 nan\n", "m.obj:1", "coordinate"},
      {"v 0 0 1e40\n", "m.obj:1", "coordinate"},
      {squareText + "vt inf\nf 1 2 3\n", "m.obj:5", "texture coordinate"},
      {squareText + "f 1 2 5\n", "m.obj:5", "vertex 5 is named, but there are only 4"},
      {squareText + "f 1 2 6\nf 1 2 7\nf 1 2 5\nv 1 2 3\n", "m.obj:6", "vertex 7 is named, but there are only 5"},
      {squareText + "f 1 2 3 5\n", "m.obj:5", "vertex 5 is named, but there are only 4"},
      {squareText + "f 1 2 4294967297\n", "m.obj:5", "vertex 4294967297 is named, but there are only 4"},
      {squareText + "f 1 2 9223372036854775807\n", "m.obj:5", "vertex 9223372036854775807 is named"},
      {squareText + "f 1 2 -5\nv 1 2 3\n", "m.obj:5", "vertex -5 is named, but 4 stand before this line"},
      {squareText + "f 1 2 0\n", "m.obj:5", "vertex 0"},
      {squareText + "f 1/1 2 3\n", "m.obj:5", "texture coordinate 1 is named, but there are only 0"},
      {squareText + "f 1//1 2 3\n", "m.obj:5", "normal 1"},
      {squareText + "f 1/x 2 3\n", "m.obj:5", "an index expected"},
      {squareText + "f 1 2 3.5\n", "m.obj:5", "a corner has the form"},
      {squareText + "f 1 2 99999999999999999999\n", "m.obj:5", "an index expected"},
      {"g nothing\n", "m.obj", "no triangles, lines or points"},
  };
  for (const auto& refused : cases) {
    const Error error = errorOf(refused.text, "m.obj");
    EXPECT_EQ(error.kind(), ErrorKind::malformed) << refused.text;
    EXPECT_EQ(error.location(), refused.location) << refused.text;
    EXPECT_NE(error.message().find(refused.words), std::string::npos) << error.message();
  }
}

TEST(Obj, EveryPrefixIsReadOrRefused) {
  const std::string whole = objText(torus(3, 3), true);
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    try {
      for (const Mesh& mesh : importBytes(asBytes(whole).first(size), "m.obj").scene.meshes)
        EXPECT_TRUE(isConsistent(mesh));
    } catch (const Error& error) {
      EXPECT_FALSE(error.message().empty());
    }
  }
}

} // namespace
} // namespace imgeo::testing
