#pragma once
// Files of several meshes and clouds, large and small ones, for tests of conversion and comparison out of core.

#include "base/file.h"
#include "containers/png/png.h"
#include "import/e57/testing.h"
#include "import/gltf/testing.h"
#include "import/ply/testing.h"
#include "scene/testing.h"

#include <filesystem>
#include <fmt/format.h>
#include <string>
#include <utility>
#include <vector>

namespace imgeo::testing {

/// A torus whose vertices no lattice of a source fits.
inline Mesh roughTorus(int ringCount, int sideCount, Vec3f center) {
  Mesh mesh = torus(ringCount, sideCount);
  Random random(7);
  for (Vec3f& position : mesh.positions)
    position += random.point() * 0.004f + center;
  return mesh;
}

inline GltfText::Json primitiveOf(GltfText& gltf, const Mesh& mesh, bool hasNormals) {
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
inline Bytes severalMeshes() {
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
  const std::size_t cloud = gltf.addMesh({primitiveOf(gltf, pointCloud(9000, 3), false)});
  gltf.addNode({{"name", "site"}, {"translation", {10, 20, 30}}, {"children", {1, 2, 3}}});
  gltf.addNode({{"name", "house"}, {"mesh", mesh}});
  gltf.addNode({{"name", "again"}, {"mesh", mesh}, {"translation", {0, 30, 0}}});
  gltf.addNode({{"name", "cloud"}, {"mesh", cloud}, {"scale", {3, 3, 3}}});
  gltf.json["scenes"] = {{{"nodes", {0}}}};
  return gltf.glb();
}

/// Scans with poses of their own, of which one is small, and one has no valid point.
inline Bytes severalScans() {
  TestFile file;
  for (const int count : {20000, 3000, 0, 15000}) {
    Random random(static_cast<std::uint32_t>(count));
    std::vector<std::vector<double>> points;
    for (int i = 0; i < count + 50; ++i) // the last ones are invalid
      points.push_back({4e5 + random.point().x, random.point().y, random.point().z, i < count ? 0.0 : 2.0,
                        double(random.below(4096)), double(random.below(256)), double(random.below(256)),
                        double(random.below(256)), 1e6 + i});
    file.scans.push_back(
        {.elements = fmt::format(R"(<name type="String">hall</name><pose type="Structure"><translation )"
                                 R"(type="Structure"><x type="Float">{}</x></translation></pose>)",
                                 count / 1000),
         .fields = {float64("cartesianX"), float64("cartesianY"), float64("cartesianZ"),
                    integer("cartesianInvalidState", 0, 2), integer("intensity", 0, 4095), integer("colorRed", 0, 255),
                    integer("colorGreen", 0, 255), integer("colorBlue", 0, 255), float64("timeStamp")},
         .points = std::move(points)});
  }
  file.packets = 40;
  return file.file();
}

/// Appends faces, and their vertices with normals and texture coordinates, in two parts with others between them.
inline void addFaces(std::string& text, const Mesh& mesh, std::size_t part, std::uint32_t& vertices) {
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

/// Writes an OBJ file of two objects with three materials, of which one is missing.
inline void writeSeveralObjects(const std::filesystem::path& path) {
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
  writeFile(path.parent_path() / "a.mtl", asBytes("newmtl stone\nKd 0.5 0.4 0.3\nnewmtl wood\nKd 0.3 0.2 0.1\n"));
  writeFile(path, asBytes(text));
}

/// A GLB file of a mesh of 24,000 triangles, and of so many, below 4,000, of its first 4,000 triangles and fewer.
inline Bytes largeMeshAndSmallOnes(int smallCount) {
  GltfText gltf;
  const GltfText::Json large = primitiveOf(gltf, roughTorus(150, 80, {0, 0, 0}), false);
  std::vector<GltfText::Json> primitives{large};
  for (int i = 0; i < smallCount; ++i) {
    primitives.push_back(large);
    gltf.json["accessors"].push_back(gltf.json["accessors"][large["indices"].get<std::size_t>()]);
    gltf.json["accessors"].back()["count"] = 3 * (4000 - i);
    primitives.back()["indices"] = gltf.json["accessors"].size() - 1;
  }
  gltf.show(gltf.addMesh(primitives));
  return gltf.glb();
}

/// A GLB file of so many small meshes: tiny spheres, tori of different sizes, and one torus again and again, elsewhere.
/// Each has a node of its own, and some a material.
inline Bytes manySmallMeshes(int count) {
  GltfText gltf;
  gltf.json["materials"] = {{{"name", "wall"}, {"pbrMetallicRoughness", {{"baseColorFactor", {0.6, 0.5, 0.4, 1}}}}},
                            {{"name", "door"}}};
  Random random(11);
  for (int i = 0; i < count; ++i) {
    const Vec3f center = random.point() * 30;
    Mesh mesh = i % 4 == 0 ? sphere(3, 4) : i % 4 == 1 ? torus(9, 7) : roughTorus(5 + i % 11, 4 + i % 7, {0, 0, 0});
    const float size = i % 4 == 0 ? 0.2f + 0.001f * static_cast<float>(i % 97) : 0.5f;
    for (Vec3f& position : mesh.positions)
      position = position * size + center;
    GltfText::Json primitive = primitiveOf(gltf, mesh, i % 3 == 0 && !mesh.normals.empty());
    if (i % 5 > 0)
      primitive["material"] = i % 2;
    gltf.show(gltf.addMesh({primitive}));
  }
  return gltf.glb();
}

/// Writes an OBJ file of so many tori, each an object.
inline void writeManyObjects(const std::filesystem::path& path, int count) {
  std::string text;
  std::uint32_t vertices = 0;
  Random random(12);
  for (int i = 0; i < count; ++i) {
    const Mesh mesh = roughTorus(20 + i % 5, 15, random.point() * 20);
    text += fmt::format("o part{}\n", i);
    addFaces(text, mesh, 0, vertices);
    addFaces(text, mesh, 1, vertices);
  }
  writeFile(path, asBytes(text));
}

/// A height field whose texture coordinates are one chart, beside which an eighth of each edge of the image is free.
inline Mesh texturedGrid(std::uint32_t n) {
  Mesh mesh = grid(n);
  const float step = 0.875f / static_cast<float>(n);
  for (const std::uint32_t position : mesh.wedgePositions)
    mesh.texCoords.push_back(
        {static_cast<float>(position % (n + 1)) * step, static_cast<float>(position / (n + 1)) * step});
  return mesh;
}

/// Writes a PLY file of a torus and colours whose faces have the texture coordinates of their corners and three
/// textures in turn: large parts of two images, a small part of another, and a few faces without one; or
/// `hasOneTexture` alone, of all faces. The images are beside it.
inline void writeTexturedPly(const std::filesystem::path& path, const std::string& encoding,
                             bool hasOneTexture = false) {
  const Mesh mesh = hasOneTexture ? texturedGrid(140) : roughTorus(200, 100, {0, 0, 0});
  const PlyStyle style{.encoding = encoding};
  PlyValues values(style);
  values.append(plyHeader(
      style, fmt::format("comment TextureFile a.png\n{}element vertex {}\nproperty float x\nproperty float y\nproperty "
                         "float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face "
                         "{}\nproperty list uchar int vertex_indices\n{}property list uchar float texcoord\n",
                         hasOneTexture ? "" : "comment TextureFile b.png\ncomment TextureFile c.png\n",
                         mesh.positions.size(), mesh.elementCount(), hasOneTexture ? "" : "property int texnumber\n")));
  for (const Vec3f& position : mesh.positions) {
    for (int axis = 0; axis < 3; ++axis)
      values.add("float", position[axis]);
    for (const int channel : {10, 200, 30})
      values.add("uchar", channel);
    values.endRecord();
  }
  for (std::size_t triangle = 0; triangle < mesh.elementCount(); ++triangle) {
    const std::size_t corner = 3 * triangle;
    const int texture = triangle % 100 == 17 ? -1 : triangle % 50 == 7 ? 2 : triangle % 20000 < 9000 ? 0 : 1;
    values.add("uchar", 3);
    for (std::size_t i = corner; i < corner + 3; ++i)
      values.add("int", mesh.wedgePositions[mesh.corners[i]]);
    if (!hasOneTexture)
      values.add("int", texture);
    values.add("uchar", 6);
    for (std::size_t i = corner; i < corner + 3; ++i) {
      values.add("float", mesh.texCoords[mesh.corners[i]].x);
      values.add("float", mesh.texCoords[mesh.corners[i]].y);
    }
    values.endRecord();
  }
  writeFile(path, values.bytes);
  const std::uint32_t edge = hasOneTexture ? 2048 : 512;
  for (const char* image : {"a.png", "b.png", "c.png"})
    writeFile(
        path.parent_path() / image,
        encodePng({edge, edge, 3, Bytes(std::size_t{3} * edge * edge, static_cast<std::uint8_t>(image[0])), {}}, 1));
}

/// The text of a PTS file of scans, of which one has no points, and one is small and has points without colours.
inline std::string severalPtsScans() {
  Random random(5);
  std::string text;
  for (const int count : {0, 12000, 700, 9000}) {
    text += fmt::format("{}\r\n", count);
    for (int i = 0; i < count; ++i) {
      text += fmt::format("{:.4f} {:.4f} {:.4f}", 4e5 + random.point().x, random.point().y, random.point().z);
      text += count == 700 ? "\n" : fmt::format(" {} {} 0 255\n", random.below(4096), random.below(256));
    }
  }
  return text;
}

} // namespace imgeo::testing
