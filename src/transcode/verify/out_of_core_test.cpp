// Converts meshes out of core and compares them with the same in memory; ends conversions and resumes them.

#include "base/soak_testing.h"
#include "content/content_coding.h"
#include "import/gltf/testing.h"
#include "import/ply/testing.h"
#include "import/stl/testing.h"
#include "prepare/boxes_testing.h"
#include "scene/testing.h"
#include "transcode/out_of_core/choose.h"
#include "transcode/sample/sample_file.h"
#include "transcode/verify/out_of_core_testing.h"

#include <csignal>
#include <gtest/gtest.h>
#include <sys/resource.h>

namespace imgeo {
namespace {

using testing::documentOf;
using testing::Ended;
using testing::expectSameAsInMemory;
using testing::outOfCore;
using testing::refusal;
using testing::TemporaryDirectory;
using testing::withRegions;

/// A torus of 24,000 triangles with texture coordinates that no lattice of a source fits.
Mesh mappedTorus() {
  Mesh mesh = testing::torus(150, 80);
  testing::Random random(7);
  for (Vec3f& position : mesh.positions)
    position += random.point() * 0.004f;
  return mesh;
}

Mesh roughTorus() {
  Mesh mesh = mappedTorus();
  mesh.texCoords.clear();
  return mesh;
}

void convertRelief(std::uint64_t triangles, bool shuffled) {
  const TemporaryDirectory directory;
  writeSampleRelief(triangles, shuffled, directory / "relief.ply");
  expectSameAsInMemory(directory, directory / "relief.ply");
}

TEST(OutOfCore, HasTheFilesOfConversionInMemory) { // in two pieces, and in four
  convertRelief(30000, false);
  convertRelief(60000, true);
}

SOAK_TEST(OutOfCore, HasTheFilesOfConversionInMemoryForManyPieces) {
  convertRelief(300000, true);
}

SOAK_TEST(OutOfCore, HasTheFilesOfConversionInMemoryForAttributesAndEncodings) {
  Mesh mesh = roughTorus();
  testing::Random random(1);
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge)
    mesh.colors.push_back(asRgba8(random.color()));
  for (const char* encoding : {"binary_little_endian", "binary_big_endian", "ascii"}) {
    const TemporaryDirectory directory;
    writeFile(directory / "torus.ply",
              testing::plyBytes(mesh, {.encoding = encoding, .real = "double", .count = "uint", .index = "uint"}));
    expectSameAsInMemory(directory, directory / "torus.ply");
  }
}

TEST(OutOfCore, HasTheFilesOfConversionInMemoryForGzippedSources) {
  const TemporaryDirectory directory;
  const Bytes file = testing::plyBytes(roughTorus(), {});
  writeFile(directory / "torus.ply.gz", encodeContent(ContentCoding::gzip, file));
  expectSameAsInMemory(directory, directory / "torus.ply.gz");
}

TEST(OutOfCore, HasTheFilesOfConversionInMemoryForNormalsOfTheSource) {
  Mesh mesh = roughTorus();
  testing::Random random(2);
  mesh.normals.clear();
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge)
    mesh.normals.push_back(random.direction());
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "torus.ply", mesh);
  expectSameAsInMemory(directory, directory / "torus.ply");
}

TEST(OutOfCore, HasTheFilesOfConversionInMemoryForTextureCoordinates) {
  Mesh mesh = mappedTorus();
  for (const bool hasNormals : {true, false}) {
    if (!hasNormals)
      mesh.normals.clear();
    const TemporaryDirectory directory;
    testing::writeMesh(directory / "torus.ply", mesh);
    expectSameAsInMemory(directory, directory / "torus.ply");
  }
}

TEST(OutOfCore, HasTheFilesOfConversionInMemoryForNormalsWithCreases) {
  Mesh mesh = mappedTorus();
  mesh.normals.clear();
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "torus.ply", mesh);
  expectSameAsInMemory(directory, directory / "torus.ply", [](ConvertOptions options) {
    options.creaseDegrees = 15;
    return options;
  });
  expectSameAsInMemory(directory, directory / "torus.ply", [](ConvertOptions options) {
    options.creaseDegrees = 0; // no normals are stored
    return options;
  });
}

TEST(OutOfCore, HasTheFilesOfConversionInMemoryForCreasesThatAreGuessed) {
  Mesh boxes = testing::boxes(2000);
  testing::Random random(3);
  for (std::size_t box = 0; box < boxes.positions.size(); box += 8) { // no lattice fits them
    const Vec3f offset = random.point() * 0.3f;
    for (std::size_t vertex = box; vertex < box + 8; ++vertex)
      boxes.positions[vertex] += offset;
  }
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "boxes.ply", boxes);
  expectSameAsInMemory(directory, directory / "boxes.ply");
  writeFile(directory / "boxes.stl", testing::binaryStl(boxes));
  expectSameAsInMemory(directory, directory / "boxes.stl");
  const ConvertReport report = convert(directory / "boxes.stl", directory / "again", outOfCore(directory));
  EXPECT_EQ(report.edges.guessedSharp, 1u);
  EXPECT_GE(report.vertices, 2000u * 24);
}

TEST(OutOfCore, HasTheFilesOfConversionInMemoryForFurtherAttributes) {
  const Mesh mesh = roughTorus();
  const testing::PlyStyle style;
  testing::PlyValues values(style);
  values.append(fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float "
                            "y\nproperty float z\nproperty float quality\nelement face {}\nproperty list uchar int "
                            "vertex_indices\nend_header\n",
                            mesh.positions.size(), mesh.elementCount()));
  for (const Vec3f& position : mesh.positions)
    for (const float value : {position.x, position.y, position.z, position.x * position.y})
      values.add("float", value);
  for (std::size_t corner = 0; corner < mesh.corners.size(); corner += 3) {
    values.add("uchar", 3);
    for (std::size_t i = 0; i < 3; ++i)
      values.add("int", mesh.wedgePositions[mesh.corners[corner + i]]);
  }
  const TemporaryDirectory directory;
  writeFile(directory / "torus.ply", values.bytes);
  expectSameAsInMemory(directory, directory / "torus.ply", [](ConvertOptions options) {
    options.keepAttributes.all = true;
    return options;
  });
}

TEST(OutOfCore, HasTheFilesOfConversionInMemoryForStl) {
  const TemporaryDirectory directory;
  writeFile(directory / "torus.stl", testing::binaryStl(roughTorus()));
  expectSameAsInMemory(directory, directory / "torus.stl");
}

/// Quadrilaterals of the torus, with normals from the end, colours and texture coordinates of some faces.
std::string objOfQuadrilaterals() {
  const Mesh mesh = mappedTorus();
  std::string text = "o torus\n";
  testing::Random random(11);
  for (const Vec3f& position : mesh.positions) {
    const Rgba color = asRgba8(random.color());
    text += fmt::format("v {} {} {} {} {} {}\n", position.x, position.y, position.z, color.r, color.g, color.b);
  }
  for (const Vec2f& texCoord : mesh.texCoords)
    text += fmt::format("vt {} {}\n", texCoord.x, texCoord.y);
  for (const Vec3f& normal : mesh.normals)
    text += fmt::format("vn {} {} {}\n", normal.x, normal.y, normal.z);
  for (std::size_t first = 0; first < mesh.corners.size(); first += 6) { // two triangles
    text += "f";
    for (const std::size_t corner : {first, first + 1, first + 2, first + 5}) {
      const std::uint32_t wedge = mesh.corners[corner];
      text +=
          fmt::format(" {}/{}/-{}", mesh.wedgePositions[wedge] + 1,
                      first < mesh.corners.size() / 2 ? fmt::format("{}", wedge + 1) : "", mesh.wedgeCount() - wedge);
    }
    text += "\n";
  }
  return text;
}

SOAK_TEST(OutOfCore, HasTheFilesOfConversionInMemoryForObj) {
  for (const bool isPacked : {false, true}) {
    const TemporaryDirectory directory;
    const std::string text = objOfQuadrilaterals();
    const std::filesystem::path file = directory / (isPacked ? "torus.obj.gz" : "torus.obj");
    writeFile(file, isPacked ? encodeContent(ContentCoding::gzip, asBytes(text)) : Bytes(text.begin(), text.end()));
    expectSameAsInMemory(directory, file);
  }
}

/// A GLB file of the torus, moved and turned, with a camera and a material without textures.
Bytes glbOfTorus(const Mesh& mesh) {
  testing::GltfText gltf;
  std::vector<float> positions, texCoords, normals;
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
    const Vec3f& at = mesh.positions[mesh.wedgePositions[wedge]];
    positions.insert(positions.end(), {at.x, at.y, at.z});
    if (!mesh.texCoords.empty())
      texCoords.insert(texCoords.end(), {mesh.texCoords[wedge].x, mesh.texCoords[wedge].y});
    if (!mesh.normals.empty())
      normals.insert(normals.end(), {mesh.normals[wedge].x, mesh.normals[wedge].y, mesh.normals[wedge].z});
  }
  testing::GltfText::Json primitive = {{"material", 0}};
  primitive["indices"] = gltf.addAccessor(mesh.corners, "SCALAR", 5125);
  primitive["attributes"]["POSITION"] = gltf.addAccessor(positions, "VEC3", 5126);
  if (!texCoords.empty())
    primitive["attributes"]["TEXCOORD_0"] = gltf.addAccessor(texCoords, "VEC2", 5126);
  if (!normals.empty())
    primitive["attributes"]["NORMAL"] = gltf.addAccessor(normals, "VEC3", 5126);
  gltf.json["materials"] = {{{"name", "stone"}, {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 0.1, 1}}}}}};
  gltf.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
  const std::size_t torus = gltf.addMesh({primitive});
  gltf.addNode({{"name", "moved"}, {"translation", {10, 20, 30}}, {"scale", {2, 3, 2}}, {"children", {1, 2}}});
  gltf.addNode({{"name", "torus"}, {"mesh", torus}, {"rotation", {0, 0.6, 0, 0.8}}});
  gltf.addNode({{"name", "view"}, {"camera", 0}, {"translation", {0, 0, 9}}});
  return gltf.glb();
}

TEST(OutOfCore, HasTheFilesAndTheDocumentOfConversionInMemoryForGlb) {
  for (const bool hasNormals : {true, false}) {
    Mesh mesh = mappedTorus();
    if (!hasNormals)
      mesh.normals.clear(), mesh.texCoords.clear();
    const TemporaryDirectory directory;
    writeFile(directory / "torus.glb", glbOfTorus(mesh));
    expectSameAsInMemory(directory, directory / "torus.glb");
    EXPECT_EQ(documentOf(directory / "site"), documentOf(directory / "memory"));
    EXPECT_TRUE(verify(directory / "site", directory / "torus.glb", {.workFolder = directory / "work"}).equal);
  }
}

TEST(OutOfCore, HasTheFilesOfConversionInMemoryForPolygons) {
  // A grid of quadrilaterals and pentagons.
  constexpr int edge = 120;
  const testing::PlyStyle style;
  testing::PlyValues values(style);
  values.append(fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float "
                            "y\nproperty float z\nelement face {}\nproperty list uchar int vertex_indices\nproperty "
                            "uchar flags\nend_header\n",
                            (edge + 1) * (edge + 1), edge * edge));
  testing::Random random(3);
  for (int y = 0; y <= edge; ++y)
    for (int x = 0; x <= edge; ++x) {
      values.add("float", x + 0.3 * random.point().x), values.add("float", y + 0.3 * random.point().x);
      values.add("float", random.point().x);
    }
  for (int y = 0; y < edge; ++y)
    for (int x = 0; x < edge; ++x) {
      const int first = y * (edge + 1) + x;
      values.add("uchar", x == 1 ? 2 : 4);
      for (const int index : {first, first + 1, first + edge + 2, first + edge + 1})
        if (x != 1 || index <= first + 1)
          values.add("int", index);
      values.add("uchar", 0);
    }
  const TemporaryDirectory directory;
  writeFile(directory / "grid.ply", values.bytes);
  expectSameAsInMemory(directory, directory / "grid.ply");
}

TEST(OutOfCore, GoesOnWhereItWasEndedInAnyPass) {
  const TemporaryDirectory directory;
  writeSampleRelief(24000, false, directory / "relief.ply");
  const std::set<std::string> steps =
      testing::expectGoesOnInAnyPass(directory, directory / "relief.ply", "groups-0-0", testing::EndedAt::beginnings);
  EXPECT_GE(steps.size(), 7u) << ::testing::PrintToString(steps);
}

SOAK_TEST(OutOfCore, GoesOnWhereItWasEndedWithinAnyPass) {
  const TemporaryDirectory directory;
  writeSampleRelief(24000, false, directory / "relief.ply");
  const std::set<std::string> steps = testing::expectGoesOnInAnyPass(directory, directory / "relief.ply", "groups-0-0");
  EXPECT_GE(steps.size(), 7u) << ::testing::PrintToString(steps);
}

/// Files above a size cannot be written, as on a full disk.
class FileSizeLimit {
public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limited{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limited);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(OutOfCore, EndsWithASentenceWhereTheDiskIsFullAndGoesOnWhenItIsNot) {
  const TemporaryDirectory directory;
  writeSampleRelief(24000, false, directory / "relief.ply");
  convert(directory / "relief.ply", directory / "memory", withRegions());
  ConvertOptions options = outOfCore(directory);
  bool isFinished = false;
  int failures = 0;
  for (rlim_t bytes = 3000; !isFinished; bytes *= 5) {
    const FileSizeLimit limit(bytes);
    try {
      convert(directory / "relief.ply", directory / "site", options);
      isFinished = true;
    } catch (const Error& error) {
      ++failures;
      EXPECT_EQ(error.kind(), ErrorKind::io);
      EXPECT_NE(std::string(error.what()).find("cannot write"), std::string::npos) << error.what();
      EXPECT_FALSE(std::filesystem::exists(directory / "site"));
      options.resume = true;
    }
  }
  EXPECT_GE(failures, 3);
  EXPECT_EQ(testing::contentsOf(directory / "site" / "geometry"),
            testing::contentsOf(directory / "memory" / "geometry"));
}

TEST(OutOfCore, RefusesWhatItCannotDo) {
  const TemporaryDirectory directory;
  const auto expectRefused = [&](const std::filesystem::path& input, const ConvertOptions& options,
                                 const std::string& words) {
    const std::string sentence = refusal(input, directory / "site", options);
    EXPECT_NE(sentence.find(words), std::string::npos) << "'" << sentence << "' without '" << words << "'";
    EXPECT_FALSE(std::filesystem::exists(directory / "site"));
  };
  writeSampleRelief(24000, false, directory / "relief.ply");
  const std::filesystem::path relief = directory / "relief.ply";
  ConvertOptions options = outOfCore(directory);
  options.resume = true;
  expectRefused(relief, options, "no work folder of an earlier run");
  options = outOfCore(directory);
  options.memoryBytes = 10'000'000;
  expectRefused(relief, options, "MB; a smaller --region-triangles takes less");
  options = outOfCore(directory);
  options.levels = LevelChoice::never;
  expectRefused(relief, options, "--levels always");
  options = outOfCore(directory);
  options.dropped.degenerate = true;
  expectRefused(relief, options, "--drop");
  options = outOfCore(directory);
  options.workFolder = directory / "site" / "work";
  expectRefused(relief, options, "lies inside the directory");
  std::filesystem::create_directory(directory / "photos");
  writeFile(directory / "photos" / "a.jpg", asBytes("photo"));
  options.workFolder = directory / "photos";
  expectRefused(relief, options, "no work folder of ours");
  EXPECT_TRUE(std::filesystem::exists(directory / "photos" / "a.jpg"));

  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  writeFile(directory / "mesh.obj", asBytes(triangle + "l 1 2\n"));
  expectRefused(directory / "mesh.obj", outOfCore(directory), "has lines");
  writeFile(directory / "mesh.vrml", asBytes("#VRML V2.0 utf8\n"));
  expectRefused(directory / "mesh.vrml", outOfCore(directory), "PLY, binary STL, OBJ, GLB, LAS, E57, PTS and XYZ");
}

TEST(OutOfCore, ResumesNoOtherConversion) {
  const TemporaryDirectory directory;
  writeSampleRelief(24000, false, directory / "relief.ply");
  ConvertOptions options = outOfCore(directory);
  int calls = 0;
  const Progress endSoon = [&](double, const std::string&) {
    if (++calls > 8)
      throw Ended();
  };
  EXPECT_THROW(convert(directory / "relief.ply", directory / "site", options, endSoon), Ended);
  options.resume = true;
  ConvertOptions other = options;
  other.groupTriangles = 1024;
  EXPECT_NE(refusal(directory / "relief.ply", directory / "site", other).find("other options"), std::string::npos);
  writeSampleRelief(25000, false, directory / "relief.ply");
  EXPECT_NE(refusal(directory / "relief.ply", directory / "site", options).find("another source"), std::string::npos);
  options.resume = false;
  EXPECT_EQ(refusal(directory / "relief.ply", directory / "site", options), "");
}

TEST(OutOfCore, IsChosenByTheMemoryThatIsStated) {
  const TemporaryDirectory directory;
  writeSampleRelief(200000, false, directory / "relief.ply");
  ConvertOptions options = withRegions();
  EXPECT_EQ(chooseOutOfCore(directory / "relief.ply", directory / "site", options), nullptr) << "the machine's memory";
  options.memoryBytes = std::uint64_t{1} << 40;
  EXPECT_EQ(chooseOutOfCore(directory / "relief.ply", directory / "site", options), nullptr);
  options.workFolder = directory / "work";
  EXPECT_NE(chooseOutOfCore(directory / "relief.ply", directory / "site", options), nullptr);
  options.regionTriangles = 1 << 20;
  EXPECT_EQ(chooseOutOfCore(directory / "relief.ply", directory / "site", options), nullptr) << "one region";
}

TEST(OutOfCore, RefusesDamagedSources) {
  const TemporaryDirectory directory;
  const Bytes whole = testing::plyBytes(roughTorus(), {});
  testing::Random random(5);
  const Bytes truth = whole;
  for (int i = 0; i < 30; ++i) {
    Bytes damaged = truth;
    if (i % 3 == 0)
      damaged.resize(damaged.size() - 1 - random.below(static_cast<std::uint32_t>(damaged.size() / 2)));
    else
      for (int k = 0; k < 20; ++k) // most of them in the faces
        damaged[damaged.size() - 1 - random.below(200000)] = 0xff;
    writeFile(directory / "damaged.ply", damaged);
    std::filesystem::remove_all(directory / "work");
    EXPECT_NE(refusal(directory / "damaged.ply", directory / "site", outOfCore(directory)), "") << i;
    EXPECT_FALSE(std::filesystem::exists(directory / "site"));
  }
}

} // namespace
} // namespace imgeo
