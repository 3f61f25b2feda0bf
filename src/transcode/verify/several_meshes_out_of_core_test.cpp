// Converts files of several meshes and clouds out of core, the large ones one after the other.

#include "base/soak_testing.h"
#include "import/e57/testing.h"
#include "import/gltf/testing.h"
#include "scene/testing.h"
#include "transcode/out_of_core/choose.h"
#include "transcode/verify/out_of_core_testing.h"

#include <gtest/gtest.h>
#include <thread>

namespace imgeo {
namespace {

using testing::documentOf;
using testing::GltfText;
using testing::outOfCore;
using testing::refusal;
using testing::TemporaryDirectory;
using testing::withRegions;

/// A torus whose vertices no lattice of a source fits.
Mesh roughTorus(int rings, int sides, Vec3f center) {
  Mesh mesh = testing::torus(rings, sides);
  testing::Random random(7);
  for (Vec3f& position : mesh.positions)
    position += random.point() * 0.004f + center;
  return mesh;
}

GltfText::Json primitiveOf(GltfText& gltf, const Mesh& mesh, bool hasNormals) {
  std::vector<float> positions, normals;
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
    const Vec3f& at = mesh.positions[mesh.wedgePositions[wedge]];
    positions.insert(positions.end(), {at.x, at.y, at.z});
    if (hasNormals)
      normals.insert(normals.end(), {mesh.normals[wedge].x, mesh.normals[wedge].y, mesh.normals[wedge].z});
  }
  GltfText::Json primitive = {{"mode", mesh.topology == Topology::points ? 0 : 4}};
  if (mesh.topology == Topology::triangles)
    primitive["indices"] = gltf.addAccessor(mesh.corners, "SCALAR", 5125);
  primitive["attributes"]["POSITION"] = gltf.addAccessor(positions, "VEC3", 5126);
  if (hasNormals)
    primitive["attributes"]["NORMAL"] = gltf.addAccessor(normals, "VEC3", 5126);
  return primitive;
}

/// Two large primitives, of which one has no normals, small ones with the material of either, and a large cloud. Two
/// nodes show the mesh of the primitives.
Bytes severalMeshes() {
  GltfText gltf;
  gltf.json["materials"] = {{{"name", "stone"}, {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 0.1, 1}}}}},
                            {{"name", "wood"}}};
  std::vector<GltfText::Json> primitives{primitiveOf(gltf, roughTorus(150, 80, {0, 0, 0}), true),
                                         primitiveOf(gltf, roughTorus(10, 10, {4, 0, 0}), true),
                                         primitiveOf(gltf, roughTorus(100, 60, {8, 0, 0}), false),
                                         primitiveOf(gltf, roughTorus(20, 20, {8, 4, 0}), false)};
  for (std::size_t i = 0; i < primitives.size(); ++i)
    primitives[i]["material"] = i % 2;
  const std::size_t mesh = gltf.addMesh(primitives);
  const std::size_t cloud = gltf.addMesh({primitiveOf(gltf, testing::pointCloud(9000, 3), false)});
  gltf.addNode({{"name", "site"}, {"translation", {10, 20, 30}}, {"children", {1, 2, 3}}});
  gltf.addNode({{"name", "house"}, {"mesh", mesh}});
  gltf.addNode({{"name", "again"}, {"mesh", mesh}, {"translation", {0, 30, 0}}});
  gltf.addNode({{"name", "cloud"}, {"mesh", cloud}, {"scale", {3, 3, 3}}});
  gltf.json["scenes"] = {{{"nodes", {0}}}};
  return gltf.glb();
}

/// A document without its viewpoints, which out of core are made from coarse levels.
std::string withoutViewpoints(std::string document) {
  for (std::size_t begin = document.find("<Viewpoint"); begin != document.npos; begin = document.find("<Viewpoint"))
    document.erase(begin, document.find('>', begin) - begin);
  return document;
}

TEST(SeveralMeshesOutOfCore, HaveTheFilesAndTheDocumentOfConversionInMemory) {
  const TemporaryDirectory directory;
  writeFile(directory / "several.glb", severalMeshes());
  testing::expectSameAsInMemory(directory, directory / "several.glb");
  EXPECT_EQ(withoutViewpoints(documentOf(directory / "site")), withoutViewpoints(documentOf(directory / "memory")));
  const SiteInfo info = inspect(directory / "site");
  EXPECT_EQ(info.warnings, std::vector<std::string>());
}

/// Scans with poses of their own, of which one is small, and one has no valid point.
Bytes severalScans() {
  testing::TestFile file;
  for (const int count : {20000, 3000, 0, 15000}) {
    testing::Random random(static_cast<std::uint32_t>(count));
    std::vector<std::vector<double>> points;
    for (int i = 0; i < count + 50; ++i) // the last ones are invalid
      points.push_back({4e5 + random.point().x, random.point().y, random.point().z, i < count ? 0.0 : 2.0,
                        double(random.below(4096)), double(random.below(256)), double(random.below(256)),
                        double(random.below(256)), 1e6 + i});
    file.scans.push_back(
        {.elements = fmt::format(R"(<name type="String">hall</name><pose type="Structure"><translation )"
                                 R"(type="Structure"><x type="Float">{}</x></translation></pose>)",
                                 count / 1000),
         .fields = {testing::float64("cartesianX"), testing::float64("cartesianY"), testing::float64("cartesianZ"),
                    testing::integer("cartesianInvalidState", 0, 2), testing::integer("intensity", 0, 4095),
                    testing::integer("colorRed", 0, 255), testing::integer("colorGreen", 0, 255),
                    testing::integer("colorBlue", 0, 255), testing::float64("timeStamp")},
         .points = std::move(points)});
  }
  file.packets = 40;
  return file.file();
}

TEST(SeveralMeshesOutOfCore, HaveTheFilesAndTheDocumentOfConversionInMemoryForScansOfE57) {
  const TemporaryDirectory directory;
  writeFile(directory / "scans.e57", severalScans());
  testing::expectSameAsInMemory(directory, directory / "scans.e57", [](ConvertOptions options) {
    options.keepAttributes.all = true;
    return options;
  });
  EXPECT_EQ(withoutViewpoints(documentOf(directory / "site")), withoutViewpoints(documentOf(directory / "memory")));
}

/// Appends faces, and their vertices with normals and texture coordinates, in two parts with others between them.
void addFaces(std::string& text, const Mesh& mesh, std::size_t part, std::uint32_t& vertices) {
  if (part == 0)
    for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
      const Vec3f &at = mesh.positions[mesh.wedgePositions[wedge]], &normal = mesh.normals[wedge];
      text += fmt::format("v {} {} {}\nvt {} {}\nvn {} {} {}\n", at.x, at.y, at.z, at.x, at.y, normal.x, normal.y,
                          normal.z);
    }
  const std::size_t triangles = mesh.elementCount(), half = triangles / 2;
  for (std::size_t i = part == 0 ? 0 : half; i < (part == 0 ? half : triangles); ++i) {
    text += "f";
    for (std::size_t corner = 3 * i; corner < 3 * i + 3; ++corner)
      text += fmt::format(" {0}/{0}/{0}", vertices + mesh.corners[corner] + 1);
    text += "\n";
  }
  if (part == 1)
    vertices += static_cast<std::uint32_t>(mesh.wedgeCount());
}

TEST(SeveralMeshesOutOfCore, HaveTheFilesAndTheDocumentOfConversionInMemoryForObjectsAndMaterialsOfObj) {
  const Mesh large = roughTorus(150, 80, {0, 0, 0}), other = roughTorus(100, 60, {8, 0, 0}),
             small = roughTorus(10, 12, {4, 0, 0});
  std::string text = "mtllib a.mtl\no house\nusemtl wood\nusemtl stone\n";
  std::uint32_t vertices = 0, inner = 0;
  addFaces(text, large, 0, vertices);
  inner = static_cast<std::uint32_t>(large.wedgeCount());
  text += "usemtl wood\n"; // whose faces are between those of stone, and whose subset is before
  addFaces(text, small, 0, inner);
  addFaces(text, small, 1, inner);
  text += "usemtl stone\n";
  addFaces(text, large, 1, vertices);
  text += "o house\nusemtl missing\n";
  vertices = inner;
  addFaces(text, other, 0, vertices);
  addFaces(text, other, 1, vertices);
  text += "f 1 2 3\n"; // without normals
  const TemporaryDirectory directory;
  writeFile(directory / "a.mtl", asBytes("newmtl stone\nKd 0.5 0.4 0.3\nnewmtl wood\nKd 0.3 0.2 0.1\n"));
  writeFile(directory / "house.obj", asBytes(text));
  testing::expectSameAsInMemory(directory, directory / "house.obj");
  EXPECT_EQ(withoutViewpoints(documentOf(directory / "site")), withoutViewpoints(documentOf(directory / "memory")));
  ConvertOptions options = outOfCore(directory);
  options.force = true;
  ConvertOptions inMemory = withRegions();
  inMemory.force = true;
  EXPECT_EQ(convert(directory / "house.obj", directory / "site", options).warnings,
            convert(directory / "house.obj", directory / "memory", inMemory).warnings);
}

TEST(SeveralMeshesOutOfCore, HaveTheFilesAndTheDocumentOfConversionInMemoryForScansOfPts) {
  testing::Random random(5);
  std::string text;
  for (const int count : {0, 12000, 700, 9000}) {
    text += fmt::format("{}\r\n", count);
    for (int i = 0; i < count; ++i) {
      text += fmt::format("{:.4f} {:.4f} {:.4f}", 4e5 + random.point().x, random.point().y, random.point().z);
      text += count == 700 ? "\n" : fmt::format(" {} {} 0 255\n", random.below(4096), random.below(256));
    }
  }
  const TemporaryDirectory directory;
  writeFile(directory / "scans.pts", asBytes(text));
  testing::expectSameAsInMemory(directory, directory / "scans.pts", [](ConvertOptions options) {
    options.keepAttributes.all = true;
    return options;
  });
  EXPECT_EQ(withoutViewpoints(documentOf(directory / "site")), withoutViewpoints(documentOf(directory / "memory")));
}

SOAK_TEST(SeveralMeshesOutOfCore, GoOnWhereTheyWereEndedInAnyPass) {
  const TemporaryDirectory directory;
  GltfText gltf;
  for (const int rings : {60, 70})
    gltf.show(gltf.addMesh({primitiveOf(gltf, roughTorus(rings, 40, {0, 0, 0}), true)}));
  writeFile(directory / "several.glb", gltf.glb());
  const std::set<std::string> steps =
      testing::expectGoesOnInAnyPass(directory, directory / "several.glb", "groups-0-0");
  for (const char* mesh : {"mesh 1 of 2: ", "mesh 2 of 2: "})
    EXPECT_TRUE(std::ranges::any_of(steps, [&](const std::string& step) { return step.starts_with(mesh); })) << mesh;
}

TEST(SeveralMeshesOutOfCore, AreSharedByRanks) {
  const TemporaryDirectory directory;
  const std::filesystem::path input = directory / "several.glb";
  writeFile(input, severalMeshes());
  convert(input, directory / "memory", withRegions());
  std::vector<std::thread> ranks;
  std::vector<std::string> sentences(3);
  for (std::uint32_t rank = 0; rank < sentences.size(); ++rank)
    ranks.emplace_back([&, rank] {
      ConvertOptions options = outOfCore(directory);
      options.ranks.rank = rank;
      options.ranks.count = static_cast<std::uint32_t>(sentences.size());
      sentences[rank] = refusal(input, directory / "site", options);
    });
  for (std::thread& rank : ranks)
    rank.join();
  EXPECT_EQ(sentences, std::vector<std::string>(3));
  EXPECT_EQ(testing::contentsOf(directory / "site" / "geometry"),
            testing::contentsOf(directory / "memory" / "geometry"));
}

TEST(SeveralMeshesOutOfCore, AreRefusedWhereMemoryDoesNotHoldTheSmallOnes) {
  const TemporaryDirectory directory;
  const std::filesystem::path input = directory / "several.glb";
  GltfText gltf;
  const GltfText::Json large = primitiveOf(gltf, roughTorus(150, 80, {0, 0, 0}), false);
  std::vector<GltfText::Json> primitives{large};
  for (int i = 0; i < 300; ++i) { // the same vertices in further meshes
    primitives.push_back(large);
    gltf.json["accessors"].push_back(gltf.json["accessors"][large["indices"].get<std::size_t>()]);
    gltf.json["accessors"].back()["count"] = 3 * (4000 - i);
    primitives.back()["indices"] = gltf.json["accessors"].size() - 1;
  }
  gltf.show(gltf.addMesh(primitives));
  writeFile(input, gltf.glb());
  ConvertOptions options = outOfCore(directory);
  options.memoryBytes = 180'000'000;
  EXPECT_NE(refusal(input, directory / "site", options).find("in memory together"), std::string::npos)
      << refusal(input, directory / "site", options);
  options.memoryBytes = 1'000'000'000;
  EXPECT_NE(chooseOutOfCore(input, directory / "site", options), nullptr);
}

TEST(SeveralMeshesOutOfCore, AreComparedInMemory) {
  const TemporaryDirectory directory;
  writeFile(directory / "several.glb", severalMeshes());
  convert(directory / "several.glb", directory / "site", withRegions());
  EXPECT_TRUE(verify(directory / "site", directory / "several.glb").equal);
  EXPECT_THROW(verify(directory / "site", directory / "several.glb", {.workFolder = directory / "work"}), Error);
}

} // namespace
} // namespace imgeo
