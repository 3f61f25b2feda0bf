#include "import/chunks/chunked_source.h"

#include "base/error.h"
#include "base/file.h"
#include "base/testing.h"
#include "import/e57/testing.h"
#include "import/ply/testing.h"
#include "import/stl/testing.h"

#include <array>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>
#include <numeric>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

/// Positions and attributes of all corners.
struct Corners {
  std::vector<Vec3f> positions, normals;
  std::vector<Vec2f> texCoords;
  std::vector<Rgba> colors;
  friend bool operator==(const Corners&, const Corners&) = default;
};

void append(Corners& corners, const Mesh& mesh) {
  for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner) {
    corners.positions.push_back(mesh.cornerPosition(corner));
    if (!mesh.normals.empty())
      corners.normals.push_back(mesh.normals[mesh.corners[corner]]);
    if (!mesh.texCoords.empty())
      corners.texCoords.push_back(mesh.texCoords[mesh.corners[corner]]);
    if (!mesh.colors.empty())
      corners.colors.push_back(mesh.colors[mesh.corners[corner]]);
  }
}

void expectSameAsWhole(const std::filesystem::path& file) {
  const auto opened = ChunkedSource::open(file, file.parent_path(), 100);
  const ChunkedMesh source = opened->mesh(0);
  EXPECT_GT(source.chunkCount(), 5u);
  Corners pieces, whole;
  std::uint64_t triangles = 0;
  for (std::size_t chunk = 0; chunk < source.chunkCount(); ++chunk) {
    const Imported piece = source.read(chunk, {});
    EXPECT_EQ(piece.scene.meshes.at(0).elementCount(), source.elementsOf(chunk));
    triangles += source.elementsOf(chunk);
    append(pieces, piece.scene.meshes[0]);
  }
  EXPECT_EQ(triangles, source.elementCount());
  append(whole, importFile(file).scene.meshes.at(0));
  EXPECT_TRUE(pieces == whole) << file;
}

/// A torus whose triangles are in any order.
Mesh shuffledTorus() {
  Mesh mesh = testing::torus(30, 20);
  testing::Random random(1);
  mesh.texCoords.clear();
  mesh.normals.clear();
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
    mesh.colors.push_back(random.color());
    mesh.normals.push_back(random.direction());
  }
  for (std::size_t triangle = 0; triangle < mesh.elementCount(); ++triangle) {
    const std::size_t other = random.below(mesh.elementCount());
    std::swap_ranges(&mesh.corners[3 * triangle], &mesh.corners[3 * triangle] + 3, &mesh.corners[3 * other]);
  }
  return mesh;
}

TEST(ChunkedSource, RefusesTextsWhoseLinesEndWithCarriageReturnsAlone) {
  const testing::TemporaryDirectory directory;
  const std::string header = "ply\rformat ascii 1.0\relement vertex 1\rproperty float x\rproperty float y\r"
                             "property float z\rend_header\r";
  writeFile(directory / "a.ply", asBytes(header + "0 0 0\r"));
  writeFile(directory / "a.obj", asBytes("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r"));
  writeFile(directory / "a.pts", asBytes("1\r0 0 0\r"));
  writeFile(directory / "a.txt", asBytes("0 0 0\r"));
  for (const char* name : {"a.ply", "a.obj", "a.pts", "a.txt"}) {
    try {
      static_cast<void>(ChunkedSource::open(directory / name, directory / ".", 100));
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(": its lines end with carriage returns alone"), std::string::npos)
          << error.what();
    }
  }
}

TEST(ChunkedSource, HasTheTrianglesOfThePlyFile) {
  const TemporaryDirectory directory;
  for (const testing::PlyStyle& style :
       {testing::PlyStyle{}, testing::PlyStyle{.encoding = "binary_big_endian", .real = "double", .index = "uint"},
        testing::PlyStyle{.count = "int", .index = "short", .listName = "vertex_index", .lineEnd = "\r\n"},
        testing::PlyStyle{.encoding = "ascii"}, testing::PlyStyle{.encoding = "ascii", .lineEnd = "\r\n"}}) {
    writeFile(directory / "a.ply", testing::plyBytes(shuffledTorus(), style));
    expectSameAsWhole(directory / "a.ply");
  }
}

/// A PLY file with a comment for each image, of which `hasImages` says whether it is beside it.
void writeTextured(const TemporaryDirectory& directory, Bytes bytes, const std::map<std::string, bool>& hasImages) {
  std::string comments;
  for (const auto& [image, isThere] : hasImages) {
    comments += fmt::format("comment TextureFile {}\n", image);
    std::filesystem::remove(directory / image);
    if (isThere)
      writeFile(directory / image, asBytes("\x89PNG\r\n\x1a\n..."));
  }
  bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(asText(bytes).find("element vertex")), comments.begin(),
               comments.end());
  writeFile(directory / "a.ply", bytes);
}

TEST(ChunkedSource, HasTheTextureOfThePlyFileInItsSceneAndNoColoursInAnyPiece) {
  const TemporaryDirectory directory;
  Mesh torus = shuffledTorus();
  for (std::size_t wedge = 0; wedge < torus.wedgeCount(); ++wedge)
    torus.texCoords.push_back({static_cast<float>(wedge), 0.5f});
  for (const char* const encoding : {"ascii", "binary_little_endian"})
    for (const bool hasImage : {false, true}) {
      writeTextured(directory, testing::plyBytes(torus, {.encoding = encoding}), {{"a.png", hasImage}});
      expectSameAsWhole(directory / "a.ply");
      const Imported whole = importFile(directory / "a.ply");
      const auto source = ChunkedSource::open(directory / "a.ply", directory.path(), 100);
      const Imported scene = source->readScene({}, {});
      EXPECT_EQ(scene.scene.graph, whole.scene.graph);
      EXPECT_EQ(scene.scene.graph.images.size(), hasImage ? 1u : 0u);
      EXPECT_EQ(scene.warnings, whole.warnings);
      for (const std::size_t chunk : {0, 1}) {
        const Imported piece = source->mesh(0).read(chunk, {});
        EXPECT_EQ(piece.scene.meshes.at(0).colors.empty(), hasImage);
        EXPECT_TRUE(piece.scene.graph.images.empty());
      }
    }
}

/// Vertices with colours, and faces of three and four corners with a 'texnumber' each, in a style.
Bytes facesOfTextures(const testing::PlyStyle& style, const std::vector<int>& textures) {
  Mesh torus = testing::torus(20, 15);
  testing::PlyValues values(style);
  values.append(testing::plyHeader(
      style, fmt::format("element vertex {}\nproperty float x\nproperty float y\nproperty float z\nproperty uchar "
                         "red\nproperty uchar green\nproperty uchar blue\nelement face {}\nproperty int "
                         "texnumber\nproperty list uchar float texcoord\nproperty list uchar int vertex_indices\n",
                         torus.positions.size(), textures.size())));
  for (const Vec3f& position : torus.positions) {
    for (int axis = 0; axis < 3; ++axis)
      values.add("float", position[axis]);
    for (const int channel : {10, 200, 30})
      values.add("uchar", channel);
    values.endRecord();
  }
  testing::Random random(4);
  for (const int texture : textures) {
    const int corners = texture == 9 ? 2 : 3 + static_cast<int>(random.below(2));
    values.add("int", texture);
    values.add("uchar", 2 * corners);
    for (int i = 0; i < 2 * corners; ++i)
      values.add("float", random.below(64) / 64.0);
    values.add("uchar", corners);
    for (int i = 0; i < corners; ++i)
      values.add("int", random.below(torus.positions.size()));
    values.endRecord();
  }
  return values.bytes;
}

TEST(ChunkedSource, HasAMeshForEachTextureOfThePlyFile) {
  const TemporaryDirectory directory;
  std::vector<int> textures;
  testing::Random random(3);
  for (int i = 0; i < 3000; ++i) // of the last ones the file has no image, and those of 9 are no triangles
    textures.push_back(i == 700 ? 9 : i < 1000 ? 2 : std::array{0, 1, 3, -1}[random.below(4)]);
  for (const testing::PlyStyle& style :
       {testing::PlyStyle{}, testing::PlyStyle{.encoding = "binary_big_endian"}, testing::PlyStyle{.encoding = "ascii"},
        testing::PlyStyle{.encoding = "ascii", .lineEnd = "\r\n"}}) {
    writeTextured(directory, facesOfTextures(style, textures), {{"a.png", true}, {"b.png", false}, {"c.png", true}});
    const Imported whole = importFile(directory / "a.ply");
    const auto source = ChunkedSource::open(directory / "a.ply", directory.path(), 100);
    ASSERT_EQ(source->meshCount(), 5u);
    const Imported scene = source->readScene({1}, {});
    EXPECT_EQ(scene.scene.graph, whole.scene.graph);
    EXPECT_EQ(scene.scene.graph.images.size(), 2u);
    EXPECT_EQ(scene.scene.meshes.at(1).positions, whole.scene.meshes.at(1).positions);
    EXPECT_EQ(scene.scene.meshes.at(1).corners, whole.scene.meshes.at(1).corners);
    EXPECT_EQ(scene.scene.meshes.at(0).elementCount() < 3, true);
    for (std::size_t mesh = 0; mesh < source->meshCount(); ++mesh) {
      EXPECT_GT(source->mesh(mesh).chunkCount(), 3u);
      Corners pieces, all;
      for (std::size_t chunk = 0; chunk < source->mesh(mesh).chunkCount(); ++chunk) {
        const Imported piece = source->mesh(mesh).read(chunk, {});
        EXPECT_EQ(piece.scene.meshes.at(0).elementCount(), source->mesh(mesh).elementsOf(chunk));
        append(pieces, piece.scene.meshes[0]);
      }
      append(all, whole.scene.meshes.at(mesh));
      EXPECT_TRUE(pieces == all) << mesh;
    }
    for (const std::string& warning : scene.warnings)
      EXPECT_TRUE(std::ranges::find(whole.warnings, warning) != whole.warnings.end()) << warning;
  }
}

TEST(ChunkedSource, ReadsNoPlyFileOfThousandsOfTextures) {
  const TemporaryDirectory directory;
  std::vector<int> textures(5000);
  std::iota(textures.begin(), textures.end(), 10);
  writeTextured(directory, facesOfTextures({}, textures), {{"a.png", true}});
  try {
    ChunkedSource::open(directory / "a.ply", directory.path());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::unsupported);
    EXPECT_NE(std::string(error.what()).find("textures"), std::string::npos) << error.what();
  }
}

TEST(ChunkedSource, HasTheTrianglesOfTheStlFile) {
  const TemporaryDirectory directory;
  writeFile(directory / "a.stl", testing::binaryStl(shuffledTorus()));
  expectSameAsWhole(directory / "a.stl");
}

TEST(ChunkedSource, HasTheTrianglesOfTheObjFile) {
  const TemporaryDirectory directory;
  const Mesh mesh = shuffledTorus();
  for (const char* corner : {"{0}", "{0}//{0}", "{0}/{0}", "{0}/{0}/{0}"}) {
    std::string text = "mtllib none.mtl\nusemtl stone\n", faces;
    for (std::uint32_t i = 0; i < mesh.wedgeCount(); ++i) {
      const Vec3f &at = mesh.positions[mesh.wedgePositions[i]], &normal = mesh.normals[i];
      text += fmt::format("vt {} {}\nvn {} {} {}\n", i, -1.0 * i, normal.x, normal.y, normal.z);
      text += fmt::format("v {} {} {}{}\n", at.x, at.y, at.z, i < 100 ? "" : " 0.5 0 1"); // earlier ones are white
    }
    for (std::size_t i = 0; i < mesh.corners.size(); ++i)
      faces += (i % 3 == 0 ? "\nf " : " ") + fmt::format(fmt::runtime(corner), mesh.corners[i] + 1);
    writeFile(directory / "a.obj", asBytes(text + faces));
    expectSameAsWhole(directory / "a.obj");
    writeFile(directory / "a.obj", asBytes(text)); // points
    expectSameAsWhole(directory / "a.obj");
    writeFile(directory / "a.obj", asBytes(text + "f 1 2 3" + faces)); // some corners have no normals
    expectSameAsWhole(directory / "a.obj");
    EXPECT_EQ(ChunkedSource::open(directory / "a.obj", directory.path(), 100)->readScene({}, {}).warnings,
              importFile(directory / "a.obj").warnings);
    writeFile(directory / "a.obj", asBytes(faces + "\n" + text)); // vertices further down
    expectSameAsWhole(directory / "a.obj");
  }
}

TEST(ChunkedSource, RefusesPolygonsBeforeTheirVertices) {
  const TemporaryDirectory directory;
  writeFile(directory / "a.obj", asBytes("f 1 2 3 4\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"));
  try {
    ChunkedSource::open(directory / "a.obj", directory.path(), 100);
    ADD_FAILURE() << "opened";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::unsupported);
    EXPECT_EQ(error.message(), "has polygons before their vertices, and is not read piece by piece");
  }
}

TEST(ChunkedSource, HasThePointsOfTheE57File) {
  testing::Random random(3);
  std::vector<std::vector<double>> points;
  for (int i = 0; i < 3000; ++i) // those of two pieces are invalid
    points.push_back({400'000 + random.point().x, random.point().y, random.point().z, i > 400 && i < 1100 ? 1.0 : 0.0,
                      double(random.below(4096)), double(random.below(256)), double(random.below(256)),
                      double(random.below(256)), 1e6 + i});
  const std::vector<testing::TestField> fields{testing::float64("cartesianX"),
                                               testing::float32("cartesianY"),
                                               testing::integer("cartesianZ", -200'000, 200'000, 1e-5),
                                               testing::integer("cartesianInvalidState", 0, 2),
                                               testing::integer("intensity", 0, 4095),
                                               testing::integer("colorRed", 0, 255),
                                               testing::integer("colorGreen", 0, 255),
                                               testing::integer("colorBlue", 0, 255),
                                               testing::float64("timeStamp")};
  const ImportOptions options{.attributes = {.all = true, .names = {}}};
  const TemporaryDirectory directory;
  const std::filesystem::path path = directory / "a.e57";
  for (const std::size_t packets : {0u, 90u, 1100u}) { // 0: some fields are far ahead of others
    testing::TestFile file = testing::fileOf(fields, points);
    file.packets = packets;
    writeFile(path, file.file());
    const auto opened = ChunkedSource::open(path, directory.path(), 100);
    const ChunkedMesh source = opened->mesh(0);
    EXPECT_GE(source.chunkCount(), packets == 0 ? 1u : 18u); // those without points are left out
    Corners pieces, whole;
    std::vector<std::vector<float>> values(2), wholeValues;
    for (std::size_t chunk = 0; chunk < source.chunkCount(); ++chunk) {
      const Imported piece = source.read(chunk, options);
      const Mesh& mesh = piece.scene.meshes.at(0);
      EXPECT_EQ(mesh.elementCount(), source.elementsOf(chunk));
      append(pieces, mesh);
      for (std::size_t i = 0; i < 2; ++i)
        values[i].insert(values[i].end(), mesh.namedAttributes.at(i).values.begin(),
                         mesh.namedAttributes.at(i).values.end());
    }
    const Imported imported = importFile(path, options), first = source.read(0, options);
    append(whole, imported.scene.meshes.at(0));
    for (const NamedAttribute& attribute : imported.scene.meshes[0].namedAttributes)
      wholeValues.push_back(attribute.values);
    EXPECT_TRUE(pieces == whole);
    EXPECT_TRUE(values == wholeValues);
    EXPECT_EQ(first.warnings, imported.warnings);
    EXPECT_EQ(first.scene.graph.nodes.size(), imported.scene.graph.nodes.size());
    EXPECT_EQ(first.up, imported.up);
  }
}

TEST(ChunkedSource, HasTheScansOfTheE57File) {
  testing::TestFile file;
  for (const std::uint32_t count : {700u, 0u, 90u, 500u}) {
    testing::Random random(count);
    std::vector<std::vector<double>> points;
    for (std::uint32_t i = 0; i < count + 200; ++i) // the first ones are invalid
      points.push_back({random.point().x, random.point().y, 6e5 + count, i < 200 ? 1.0 : 0.0, 5e5 + i});
    file.scans.push_back(
        {.elements = count == 90 ? "" : R"(<name type="String">hall</name>)",
         .fields = {testing::float64("cartesianX"), testing::float32("cartesianY"), testing::float64("cartesianZ"),
                    testing::integer("cartesianInvalidState", 0, 2), testing::float64("timeStamp")},
         .points = std::move(points)});
  }
  file.scans[3].fields.back() = testing::float64("seconds"); // another field
  file.packets = 60;
  const ImportOptions options{.attributes = {.all = false, .names = {"timeStamp"}}};
  const TemporaryDirectory directory;
  const std::filesystem::path path = directory / "a.e57";
  writeFile(path, file.file());
  const auto source = ChunkedSource::open(path, directory.path(), 100);
  const Imported whole = importFile(path, options), scene = source->readScene({1}, options);
  ASSERT_EQ(source->meshCount(), 3u);
  ASSERT_EQ(whole.scene.meshes.size(), 3u);
  EXPECT_EQ(scene.warnings, whole.warnings);
  EXPECT_EQ(scene.attributes, whole.attributes);
  ASSERT_EQ(scene.scene.graph.nodes.size(), whole.scene.graph.nodes.size());
  for (std::size_t i = 0; i < whole.scene.graph.nodes.size(); ++i) {
    EXPECT_EQ(scene.scene.graph.nodes[i].name, whole.scene.graph.nodes[i].name);
    EXPECT_EQ(scene.scene.graph.nodes[i].fields, whole.scene.graph.nodes[i].fields);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const ChunkedMesh pieces = source->mesh(i);
    const Mesh& expected = whole.scene.meshes[i];
    Corners ofPieces, ofWhole;
    std::vector<float> values;
    for (std::size_t chunk = 0; chunk < pieces.chunkCount(); ++chunk) {
      const Imported piece = pieces.read(chunk, options);
      append(ofPieces, piece.scene.meshes.at(0));
      EXPECT_EQ(piece.warnings, whole.warnings);
      for (const NamedAttribute& attribute : piece.scene.meshes[0].namedAttributes)
        values.insert(values.end(), attribute.values.begin(), attribute.values.end());
    }
    append(ofWhole, expected);
    EXPECT_TRUE(ofPieces == ofWhole) << i;
    EXPECT_EQ(values, i == 2 ? std::vector<float>() : expected.namedAttributes.at(0).values) << i;
    EXPECT_EQ(scene.scene.meshes[i].name, expected.name);
    if (i == 1) {
      EXPECT_EQ(scene.scene.meshes[i].positions, expected.positions);
    } else {
      EXPECT_LT(scene.scene.meshes[i].elementCount(), expected.elementCount());
    }
  }
}

TEST(ChunkedSource, HasThePointsOfTheFile) {
  const TemporaryDirectory directory;
  const Mesh mesh = testing::pointCloud(1050, 1);
  for (const testing::PlyStyle& style :
       {testing::PlyStyle{}, testing::PlyStyle{.encoding = "binary_big_endian", .real = "double"},
        testing::PlyStyle{.encoding = "ascii"}, testing::PlyStyle{.encoding = "ascii", .lineEnd = "\r\n"}}) {
    writeFile(directory / "a.ply", testing::plyBytes(mesh, style));
    expectSameAsWhole(directory / "a.ply");
  }
  std::string lines = "1050\n";
  for (const Vec3f& position : mesh.positions)
    lines += fmt::format("{} {} {} 1 2 3\n", position.x + 5000, position.y, position.z);
  writeFile(directory / "a.pts", asBytes(lines));
  expectSameAsWhole(directory / "a.pts");
  writeFile(directory / "a.xyz", asBytes("# x y z" + lines.substr(lines.find('\n'))));
  expectSameAsWhole(directory / "a.xyz");
}

/// The sentence with which reading a file in pieces ends; "" if it does not.
std::string refusalOf(const Bytes& bytes) {
  const TemporaryDirectory directory;
  writeFile(directory / "a.ply", bytes);
  try {
    const auto opened = ChunkedSource::open(directory / "a.ply", directory.path(), 100);
    const ChunkedMesh source = opened->mesh(0);
    for (std::size_t chunk = 0; chunk < source.chunkCount(); ++chunk)
      source.read(chunk, {});
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(ChunkedSource, NamesWhatIsWrongWithAFile) {
  const Bytes whole = testing::plyBytes(shuffledTorus(), {});
  EXPECT_EQ(refusalOf(whole), "");
  Bytes cut = whole;
  cut.resize(cut.size() - 1);
  EXPECT_NE(refusalOf(cut).find("ends within face 1200 of 1200"), std::string::npos) << refusalOf(cut);
  Bytes outside = whole;
  outside[outside.size() - 2] = 1; // the high bytes of the last index
  EXPECT_NE(refusalOf(outside).find("is named, but there are only 651"), std::string::npos) << refusalOf(outside);
  outside.back() = 0x80;
  EXPECT_NE(refusalOf(outside).find("names a vertex below 0"), std::string::npos) << refusalOf(outside);
  EXPECT_NE(refusalOf(testing::plyBytes(testing::pointCloud(0, 1), {})).find("no vertices"), std::string::npos);
  Bytes points = testing::plyBytes(testing::pointCloud(300, 1), {});
  EXPECT_EQ(refusalOf(points), "");
  points.pop_back();
  EXPECT_NE(refusalOf(points).find("promises 300 of 'vertex'"), std::string::npos) << refusalOf(points);
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const auto refusalOfText = [&](const std::string& rest) {
    const std::string file = text + rest;
    return refusalOf(Bytes(file.begin(), file.end()));
  };
  EXPECT_EQ(refusalOfText("3 2 1 0\n"), "");
  EXPECT_NE(refusalOfText("3 2 1\n").find("ends within face 2 of 2"), std::string::npos) << refusalOfText("3 2 1\n");
  EXPECT_NE(refusalOfText("3 2 1 3\n").find("a.ply:14: vertex 3 is named"), std::string::npos)
      << refusalOfText("3 2 1 3\n");
  EXPECT_NE(refusalOfText("3 2 1 -1\n").find("below 0"), std::string::npos);
  EXPECT_NE(refusalOfText("3 2 1 0 4\n").find("a.ply:14"), std::string::npos) << refusalOfText("3 2 1 0 4\n");
  EXPECT_NE(refusalOfText("99999999 2 1 0\n"), "");
  EXPECT_NE(refusalOf(Bytes(100)).find("piece by piece"), std::string::npos);
}

/// The torus with further elements: their lines of the header, where they are declared, and their records.
Bytes withElements(const std::string& lines, const Bytes& records, const std::string& before = "end_header") {
  const Bytes whole = testing::plyBytes(shuffledTorus(), {});
  std::string header(asText(whole));
  header.resize(header.find("end_header\n") + 11);
  Bytes body(whole.begin() + static_cast<std::ptrdiff_t>(header.size()), whole.end());
  header.insert(header.find(before), lines);
  Bytes file(header.begin(), header.end());
  if (before == "end_header")
    body.insert(body.end(), records.begin(), records.end());
  else
    file.insert(file.end(), records.begin(), records.end());
  file.insert(file.end(), body.begin(), body.end());
  return file;
}

TEST(ChunkedSource, RefusesElementsThatItWouldPassOverWhereverTheyAre) {
  const std::string edge = "element edge 1\nproperty int vertex1\nproperty int vertex2\n",
                    strips = "element tristrips 1\nproperty list int int vertex_indices\n",
                    named = "element names 1\nproperty list int uchar text\n", cloud = "element vertex 0\n",
                    more = "element face 0\n", scalar = "element material 2\nproperty uchar shininess\n";
  for (const char* where : {"element vertex", "end_header"}) {
    EXPECT_NE(refusalOf(withElements(edge, Bytes(8), where)).find("has elements 'edge'"), std::string::npos);
    EXPECT_NE(refusalOf(withElements(strips, Bytes(4), where)).find("has elements 'tristrips'"), std::string::npos);
    EXPECT_NE(refusalOf(withElements(named, Bytes(4), where)).find("has lists in its elements 'names'"),
              std::string::npos);
    EXPECT_NE(refusalOf(withElements(cloud, {}, where)).find("two elements 'vertex'"), std::string::npos);
    EXPECT_NE(refusalOf(withElements(more, {}, where)).find("two elements 'face'"), std::string::npos);
    EXPECT_EQ(refusalOf(withElements(scalar, Bytes(2), where)), "");
  }
  EXPECT_NE(refusalOf(withElements(scalar, Bytes(1))).find("promises 2 of 'material'"), std::string::npos);
  EXPECT_EQ(refusalOf(withElements("element edge 0\nproperty int vertex1\nproperty int vertex2\n", {})), "");
}

TEST(ChunkedSource, WarnsOfWhatItLeavesOutAsOfAFileThatIsReadWhole) {
  const TemporaryDirectory directory;
  const std::filesystem::path file = directory / "a.ply";
  writeFile(file, withElements("element material 2\nproperty uchar shininess\n", Bytes(7)));
  const std::vector<std::string> warnings = importFile(file).warnings;
  EXPECT_EQ(warnings.size(), 2u);
  EXPECT_EQ(ChunkedSource::open(file, file.parent_path(), 100)->mesh(0).read(0, {}).warnings, warnings);
}

} // namespace
} // namespace imgeo
