#include "base/parallel.h"
#include "import/ply/header.h"
#include "import/ply/testing.h"
#include "import/testing.h"

#include <cmath>
#include <limits>
#include <vector>

namespace imgeo::testing {
namespace {

const char* const allEncodings[] = {"ascii", "binary_little_endian", "binary_big_endian"};

template <typename T> std::vector<T> gathered(const std::vector<T>& values, const std::vector<std::uint32_t>& from) {
  std::vector<T> result;
  for (const std::uint32_t i : from)
    if (!values.empty())
      result.push_back(values[i]);
  return result;
}

/// The mesh that plyBytes writes: one position for every wedge.
Mesh withVertexPerWedge(Mesh mesh) {
  mesh.positions = gathered(mesh.positions, mesh.wedgePositions);
  mesh.wedgePositions.clear();
  addPlainWedges(mesh);
  return mesh;
}

/// The mesh's wedges in the order of their first use, without those that are not used.
Mesh inOrderOfUse(Mesh mesh) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t& corner : mesh.corners) {
    const auto found = std::ranges::find(order, corner);
    const auto index = static_cast<std::uint32_t>(found - order.begin());
    if (found == order.end())
      order.push_back(corner);
    corner = index;
  }
  mesh.positions = gathered(mesh.positions, gathered(mesh.wedgePositions, order));
  mesh.normals = gathered(mesh.normals, order);
  mesh.texCoords = gathered(mesh.texCoords, order);
  mesh.colors = gathered(mesh.colors, order);
  mesh.wedgePositions.clear();
  addPlainWedges(mesh);
  return mesh;
}

void expectEqual(const Mesh& read, const Mesh& written) {
  EXPECT_EQ(read.topology, written.topology);
  EXPECT_EQ(read.positions, written.positions);
  EXPECT_EQ(read.wedgePositions, written.wedgePositions);
  EXPECT_EQ(read.normals, written.normals);
  EXPECT_EQ(read.texCoords, written.texCoords);
  EXPECT_EQ(read.colors, written.colors);
  EXPECT_EQ(read.corners, written.corners);
}

TEST(Ply, IsReadAsItWasWrittenInEveryEncoding) {
  for (std::uint32_t seed = 0; seed < 60; ++seed)
    for (const char* encoding : allEncodings) {
      SCOPED_TRACE(fmt::format("seed {}, {}", seed, encoding));
      const Mesh mesh = withVertexPerWedge(randomMesh(seed));
      expectEqual(onlyMesh(plyBytes(mesh, {.encoding = encoding}), "m.ply"),
                  mesh.topology == Topology::lines ? inOrderOfUse(mesh) : mesh);
    }
}

TEST(Ply, ReadsEdgesBesideFacesAsAShapeOfLines) {
  const Mesh mesh = withVertexPerWedge(torus(4, 5));
  Bytes bytes = plyBytes(mesh, {.encoding = "binary_little_endian"});
  const std::string before = "end_header\n", after = "element edge 2\nproperty int vertex2\nproperty uchar "
                                                     "crease\nproperty int vertex1\nend_header\n";
  const auto at = bytes.begin() + static_cast<std::ptrdiff_t>(asText(bytes).find(before));
  bytes.insert(bytes.erase(at, at + static_cast<std::ptrdiff_t>(before.size())), after.begin(), after.end());
  for (const std::uint32_t to : {7u, 9u}) {
    appendLittle(bytes, to);
    bytes.push_back(255);
    appendLittle(bytes, std::uint32_t{3});
  }
  const Imported imported = importBytes(bytes, "m.ply");
  ASSERT_EQ(shapeNodes(imported.scene.graph).size(), 2u);
  EXPECT_EQ(shapeName(imported.scene.graph, 1), "edges");
  expectEqual(imported.scene.meshes[0], mesh);
  Mesh edges = mesh;
  edges.topology = Topology::lines;
  edges.corners = {3, 7, 3, 9};
  expectEqual(imported.scene.meshes[1], inOrderOfUse(edges));
  EXPECT_EQ(imported.warnings, std::vector<std::string>{"Not carried over from the PLY file: 'crease' of 'edge'."});
}

TEST(Ply, ReadsEveryPropertyNameThatProgramsUse) {
  Mesh mesh = withVertexPerWedge(torus(4, 5));
  Random random(1);
  for (std::size_t i = 0; i < mesh.wedgeCount(); ++i)
    mesh.colors.push_back(random.color());
  const PlyStyle styles[] = {{.listName = "vertex_index", .u = "u", .v = "v"},
                             {.u = "texture_u", .v = "texture_v", .colorPrefix = "diffuse_"},
                             {.encoding = "ascii", .lineEnd = "\r\n"},
                             {.encoding = "binary_little_endian", .lineEnd = "\r\n"},
                             {.encoding = "ascii", .lineEnd = "\r"},
                             {.encoding = "binary_little_endian", .lineEnd = "\r"},
                             {.encoding = "binary_big_endian", .lineEnd = "\r"}};
  for (const PlyStyle& style : styles)
    expectEqual(onlyMesh(plyBytes(mesh, style), "m.ply"), mesh);
}

TEST(Ply, FaultsBehindCarriageReturnsHaveTheirLine) {
  const std::string text = "ply\rformat ascii 1.0\relement vertex 1\rproperty float x\rproperty float y\r"
                           "property float z\rend_header\r0 0 zero\r";
  const Error error = errorOf(text, "m.ply");
  EXPECT_STREQ(error.what(), "m.ply:8: a number expected, not 'zero'");
}

TEST(Ply, ReadsEveryTypeUnderBothNames) {
  Mesh mesh; // coordinates that every type can hold
  mesh.positions = {{0, 0, 0}, {127, 0, 0}, {0, 100, 0}, {1, 2, 3}};
  addPlainWedges(mesh);
  addTriangle(mesh, 0, 1, 2);
  addTriangle(mesh, 2, 1, 3);
  const char* const integers[] = {"char", "uchar", "short", "ushort", "int",   "uint",
                                  "int8", "uint8", "int16", "uint16", "int32", "uint32"};
  const char* const reals[] = {"float", "float32", "double", "float64"};
  for (const char* encoding : allEncodings) {
    for (const char* type : integers)
      expectEqual(onlyMesh(plyBytes(mesh, {.encoding = encoding, .real = type, .count = type, .index = type}), "m.ply"),
                  mesh);
    for (const char* type : reals)
      expectEqual(onlyMesh(plyBytes(mesh, {.encoding = encoding, .real = type}), "m.ply"), mesh);
  }
}

TEST(Ply, RefusesEveryTruncation) {
  const Mesh mesh = withVertexPerWedge(torus(3, 4));
  for (const char* encoding : allEncodings) {
    const Bytes whole = plyBytes(mesh, {.encoding = encoding});
    // Text may lose its last line feed, and the last digits of its last number.
    std::size_t end = whole.size();
    if (encoding == std::string("ascii"))
      while (whole[end - 2] != ' ')
        --end;
    for (std::size_t size = 0; size < end; ++size)
      EXPECT_THROW(importBytes(ByteSpan(whole).first(size), "m.ply"), Error) << encoding << ", " << size << " bytes";
    expectEqual(onlyMesh(whole, "m.ply"), mesh);
  }
}

std::string asciiPly(const std::string& elements, const std::string& body) {
  return plyHeader({.encoding = "ascii"}, elements) + body;
}
const std::string xyzProperties = "property float x\nproperty float y\nproperty float z\n";
const std::string faceProperties = "property list uchar int vertex_indices\n";

TEST(Ply, WithoutFacesIsAPointCloud) {
  for (const char* faces : {"", "element face 0\nproperty list uchar int vertex_indices\n"}) {
    const Mesh mesh = onlyMesh(asciiPly("element vertex 2\n" + xyzProperties + faces, "0 0 0\n1 2 3\n"), "m.ply");
    EXPECT_EQ(mesh.topology, Topology::points);
    EXPECT_EQ(mesh.corners, (std::vector<std::uint32_t>{0, 1}));
  }
}

TEST(Ply, CutsPolygonsIntoTriangles) {
  const std::string text = asciiPly("element vertex 5\n" + xyzProperties + "element face 3\n" + faceProperties,
                                    "0 0 0\n4 0 0\n4 4 0\n2 1 0\n0 4 0\n3 0 1 3\n5 0 1 2 3 4\n4 0 1 2 4\n");
  const Mesh mesh = onlyMesh(text, "m.ply");
  ASSERT_EQ(mesh.elementCount(), 1u + 3 + 2);
  double area = 0; // all triangles face +z, so the concave pentagon is not cut as a fan
  for (std::size_t at = 0; at < mesh.corners.size(); at += 3) {
    const Vec3d a(mesh.cornerPosition(at)), b(mesh.cornerPosition(at + 1)), c(mesh.cornerPosition(at + 2));
    EXPECT_GT(cross(b - a, c - a).z, 0);
    area += cross(b - a, c - a).z / 2;
  }
  EXPECT_DOUBLE_EQ(area, 2 + 10 + 16);
}

TEST(Ply, ReadsFacesThatPrecedeTheirVertices) {
  const Mesh mesh = onlyMesh(asciiPly("element face 1\n" + faceProperties + "element vertex 4\n" + xyzProperties,
                                      "4 0 1 2 3\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"),
                             "m.ply");
  EXPECT_EQ(mesh.elementCount(), 2u);
}

TEST(Ply, ReadsTriangleStripsWithTheirOrientation) {
  const std::string strips = "element tristrips 1\nproperty list int int vertex_indices\n";
  const Mesh mesh = onlyMesh(asciiPly("element vertex 5\n" + xyzProperties + strips,
                                      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n13 0 1 2 3 4 -1 2 1 1 3 -1 4 3\n"),
                             "m.ply");
  EXPECT_EQ(mesh.corners, (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3, 2, 3, 4}));
}

TEST(Ply, GivesEachCornerItsTextureCoordinate) {
  const std::string elements = "element vertex 3\n" + xyzProperties +
                               "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 2\n" +
                               faceProperties + "property list uchar float texcoord\n";
  const Mesh mesh = onlyMesh(asciiPly(elements, "0 0 0 1 2 3\n1 0 0 4 5 6\n0 1 0 7 8 9\n"
                                                "3 0 1 2 6 0 0 0.5 0 0 0.5\n3 2 1 0 0\n"),
                             "m.ply");
  EXPECT_EQ(mesh.positions.size(), 3u);
  EXPECT_EQ(mesh.wedgePositions, (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 0}));
  EXPECT_EQ(mesh.texCoords, (std::vector<Vec2f>{{0, 0}, {0.5, 0}, {0, 0.5}, {}, {}, {}}));
  EXPECT_EQ(mesh.colors[3], (Rgba8{7, 8, 9, 255}));
}

TEST(Ply, ScalesColoursByTheirType) {
  const auto colorOf = [](const std::string& type, const std::string& values) {
    std::string elements = "element vertex 1\n" + xyzProperties;
    for (const char* name : {"red", "green", "blue", "alpha"})
      elements += "property " + type + " " + name + "\n";
    return onlyMesh(asciiPly(elements, "0 0 0 " + values + "\n"), "m.ply").colors.at(0);
  };
  EXPECT_EQ(colorOf("uchar", "0 1 254 255"), (Rgba8{0, 1, 254, 255}));
  EXPECT_EQ(colorOf("ushort", "0 257 65278 65535"), (Rgba8{0, 1, 254, 255}));
  EXPECT_EQ(colorOf("ushort", "1 2 3 65534"), (Rgba{1 / 65535.0f, 2 / 65535.0f, 3 / 65535.0f, 65534 / 65535.0f}));
  EXPECT_EQ(colorOf("float", "0 0.00392157 0.5 1"), (Rgba{0, 0.00392157f, 0.5f, 1}));
  EXPECT_EQ(colorOf("double", "-3 7 nan 1"), (Rgba8{0, 255, 0, 255}));
}

TEST(Ply, IgnoresAlphaThatIsOpaqueEverywhere) {
  const std::string elements = "element vertex 2\n" + xyzProperties +
                               "property uchar red\nproperty uchar green\n"
                               "property uchar blue\nproperty uchar alpha\n";
  EXPECT_EQ(onlyMesh(asciiPly(elements, "0 0 0 1 2 3 255\n0 0 1 1 2 3 255\n"), "m.ply").colorComponents, 3u);
  EXPECT_EQ(onlyMesh(asciiPly(elements, "0 0 0 1 2 3 255\n0 0 1 1 2 3 254\n"), "m.ply").colorComponents, 4u);
}

TEST(Ply, NormalisesNormalsAndCountsThoseWithoutDirection) {
  const std::string elements =
      "element vertex 4\n" + xyzProperties + "property float nx\nproperty float ny\nproperty float nz\n";
  const Imported imported =
      importBytes(asBytes(asciiPly(elements, "0 0 0 0 2 0\n0 0 1 0 0 0\n0 0 2 nan 0 0\n0 0 3 1e30 0 1e30\n")), "m.ply");
  const std::vector<Vec3f>& normals = imported.scene.meshes.at(0).normals;
  EXPECT_EQ(normals[0], (Vec3f{0, 1, 0}));
  EXPECT_EQ(normals[1], (Vec3f{0, 0, 1}));
  EXPECT_EQ(normals[2], (Vec3f{0, 0, 1}));
  EXPECT_FLOAT_EQ(normals[3].x, std::sqrt(0.5f));
  EXPECT_EQ(imported.warnings, std::vector<std::string>{"2 normals were replaced by (0, 0, 1): without direction."});
}

TEST(Ply, SkipsUnknownElementsAndPropertiesWithAWarning) {
  const std::string elements =
      "obj_info any words\nelement material 2\nproperty list uchar short chunks\nproperty double gloss\n"
      "element vertex 3\nproperty list uchar int near\n" +
      xyzProperties + "property float quality\nelement face 1\n" + faceProperties +
      "property uchar flags\nelement nothing 0\nproperty int n\nelement edge 1\nproperty int "
      "from\nproperty int to\n";
  for (const char* encoding : allEncodings) {
    const PlyStyle style{.encoding = encoding};
    PlyValues values(style);
    values.append(plyHeader(style, elements));
    for (int material = 0; material < 2; ++material) {
      values.add("uchar", material);
      for (int chunk = 0; chunk < material; ++chunk)
        values.add("short", 500);
      values.add("double", 0.5);
      values.endRecord();
    }
    for (int vertex = 0; vertex < 3; ++vertex) {
      values.add("uchar", 2), values.add("int", 7), values.add("int", 8);
      values.add("float", vertex == 1), values.add("float", vertex == 2), values.add("float", 0);
      values.add("float", 0.25);
      values.endRecord();
    }
    values.add("uchar", 3), values.add("int", 0), values.add("int", 1), values.add("int", 2), values.add("uchar", 9);
    values.endRecord();
    values.add("int", 0), values.add("int", 1);
    values.endRecord();

    const Imported imported = importBytes(values.bytes, "m.ply");
    EXPECT_EQ(imported.scene.meshes.at(0).positions, (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(imported.scene.meshes.at(0).elementCount(), 1u);
    EXPECT_EQ(imported.warnings,
              std::vector<std::string>{"Not carried over from the PLY file: element 'material', 'near' of 'vertex', "
                                       "'quality' of 'vertex', 'flags' of 'face', element 'edge'."});
  }
}

const ImportOptions everyAttribute{{.all = true, .names = {}}};

TEST(Ply, KeepsTheRequestedAttributes) {
  const std::string elements = "element vertex 2\nproperty float quality\n" + xyzProperties +
                               "property ushort count\nproperty double rate_0\nproperty double rate_1\n"
                               "property float label_0\n";
  const std::string text = asciiPly(elements, "0.5 1 2 3 65535 1 2 8\n-7 4 5 6 9 3 4 9\n");
  const Imported all = importBytes(asBytes(text), "m.ply", everyAttribute);
  EXPECT_TRUE(all.warnings.empty());
  EXPECT_EQ(all.scene.meshes.at(0).positions, (std::vector<Vec3f>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(
      all.scene.meshes.at(0).namedAttributes,
      (std::vector<NamedAttribute>{
          {"quality", 1, {0.5f, -7}}, {"count", 1, {65535, 9}}, {"rate", 2, {1, 2, 3, 4}}, {"label_0", 1, {8, 9}}}));
  const Imported some = importBytes(asBytes(text), "m.ply", {{.all = false, .names = {"rate", "quality"}}});
  EXPECT_EQ(some.attributes, (std::vector<std::string>{"quality", "count", "rate", "label_0"}));
  ASSERT_EQ(some.scene.meshes.at(0).namedAttributes.size(), 2u);
  EXPECT_EQ(some.scene.meshes[0].namedAttributes[1].name, "rate");
  EXPECT_EQ(some.warnings, std::vector<std::string>{
                               "Not carried over from the PLY file: 'count' of 'vertex', 'label_0' of 'vertex'."});
}

TEST(Ply, KeepsAttributesWithTexturedFacesAndEdges) {
  const std::string text =
      asciiPly("element vertex 4\n" + xyzProperties + "property float heat\nelement face 2\n" + faceProperties +
                   "property list uchar float texcoord\nelement edge 1\n"
                   "property int vertex1\nproperty int vertex2\n",
               "0 0 0 10\n1 0 0 11\n0 1 0 12\n1 1 0 13\n3 0 1 2 6 0 0 1 0 0 1\n"
               "3 2 1 3 6 0 1 1 0 1 1\n3 0\n");
  const Imported imported = importBytes(asBytes(text), "m.ply", everyAttribute);
  EXPECT_EQ(imported.scene.meshes.at(0).namedAttributes.at(0).values, (std::vector<float>{10, 11, 12, 12, 11, 13}));
  EXPECT_EQ(imported.scene.meshes.at(1).namedAttributes.at(0).values, (std::vector<float>{13, 10}));
}

TEST(Ply, RefusesNonFiniteAttributesOnlyWhereTheyAreKept) {
  for (const char* value : {"nan", "inf", "1e39"}) {
    const std::string text = asciiPly("element vertex 2\n" + xyzProperties + "property double heat\n",
                                      std::string("0 0 0 1\n1 1 1 ") + value + "\n");
    EXPECT_EQ(onlyMesh(text, "m.ply").elementCount(), 2u);
    const Error error = errorOf(text, "m.ply", everyAttribute);
    EXPECT_EQ(error.kind(), ErrorKind::malformed);
    EXPECT_EQ(error.location(), "m.ply:11");
    EXPECT_NE(error.message().find("attribute"), std::string::npos);
  }
}

TEST(Ply, WarnsWhereSinglePrecisionIsTooCoarse) {
  const std::string xyz = "property double x\nproperty double y\nproperty double z\n";
  const auto warnings = [&](const std::string& body) {
    return importBytes(asBytes(asciiPly("element vertex 2\n" + xyz, body)), "m.ply").warnings;
  };
  EXPECT_TRUE(warnings("0.1 0.2 0.3\n1.1 2.2 3.3\n").empty());
  ASSERT_EQ(warnings("60000.1 0 0\n60000.2 0 0\n").size(), 1u);
  EXPECT_NE(warnings("60000.1 0 0\n60000.2 0 0\n")[0].find("single precision"), std::string::npos);
}

struct Refused {
  const char* what;
  std::string elements, body;
  ErrorKind kind;
  std::string location, words;
};

TEST(Ply, RefusesWithOneSentenceAndALocation) {
  const std::string vertex = "element vertex 1\n" + xyzProperties, face = "element face 1\n" + faceProperties;
  const Refused cases[] = {
      {"too many vertices", "element vertex 4000000000\n" + xyzProperties, "0 0 0\n", ErrorKind::truncated, "m.ply:9",
       "promises 4000000000 of 'vertex'"},
      {"too many faces", vertex + "element face 4000000000\n" + faceProperties, "0 0 0\n", ErrorKind::truncated,
       "m.ply:11", "promises 4000000000 of 'face'"},
      {"beyond 32 bits", "element vertex 5000000000\n" + xyzProperties, "", ErrorKind::limit, "m.ply:9", "32-bit"},
      {"beyond 64 bits", "element vertex 99999999999999999999\n" + xyzProperties, "", ErrorKind::malformed, "m.ply:4",
       "elements"},
      {"a negative count", "element vertex -1\n" + xyzProperties, "", ErrorKind::malformed, "m.ply:4", "negative"},
      {"NaN", vertex, "0 nan 0\n", ErrorKind::malformed, "m.ply:9", "coordinate"},
      {"infinity", vertex, "0 -inf 0\n", ErrorKind::malformed, "m.ply:9", "coordinate"},
      {"beyond single precision", vertex, "0 1e39 0\n", ErrorKind::malformed, "m.ply:9", "single precision"},
      {"a word", vertex, "0 zero 0\n", ErrorKind::malformed, "m.ply:9", "not 'zero'"},
      {"half a word", vertex, "0 1,5 0\n", ErrorKind::malformed, "m.ply:9", "not '1,5'"},
      {"a value too many", vertex, "0 0 0 0\n", ErrorKind::malformed, "m.ply:9", "vertex 1 of 1"},
      {"a value too few", "element vertex 2\n" + xyzProperties, "0.5 0.5\n0.5 0.5 0.5\n", ErrorKind::malformed,
       "m.ply:10", "vertex 1 of 2"},
      {"an index beyond", vertex + face, "0 0 0\n3 0 0 1\n", ErrorKind::malformed, "m.ply:12", "vertex 1 is named"},
      {"an index below", vertex + face, "0 0 0\n3 0 -1 0\n", ErrorKind::malformed, "m.ply:12", "vertex -1 is named"},
      {"a list too long", vertex + face, "0 0 0\n300 0 0\n", ErrorKind::truncated, "m.ply:12", "promises 300"},
      {"a fractional index", vertex + face, "0 0 0\n3 0 0.5 0\n", ErrorKind::malformed, "m.ply:12", "not '0.5'"},
      {"a negative list", vertex + face, "0 0 0\n-3 0 0 0\n", ErrorKind::malformed, "m.ply:12", "negative"},
      {"fractional indices", vertex + "element face 1\nproperty list uchar float vertex_indices\n", "0 0 0\n3 0 0 0\n",
       ErrorKind::malformed, "m.ply:11", "fractions"},
      {"fractional counts", "element vertex 1\nproperty list float int x\n", "", ErrorKind::malformed, "m.ply:5",
       "fractions"},
      {"faces without vertices", vertex + "element face 1\nproperty int a\n", "0 0 0\n1\n", ErrorKind::malformed,
       "m.ply:11", "vertex_indices"},
      {"no z", "element vertex 1\nproperty float x\nproperty float y\n", "0 0\n", ErrorKind::malformed, "m.ply:8",
       "x, y and z"},
      {"no vertices", face, "3 0 0 0\n", ErrorKind::malformed, "m.ply:7", "no element 'vertex'"},
      {"an unknown type", "element vertex 1\nproperty half x\n", "", ErrorKind::malformed, "m.ply:5", "'half'"},
      {"a name twice", "element vertex 1\n" + xyzProperties + "property int x\n", "", ErrorKind::malformed, "m.ply:8",
       "two properties 'x'"},
      {"an element twice", vertex + vertex, "", ErrorKind::malformed, "m.ply:8", "two elements 'vertex'"},
      {"an early property", xyzProperties, "", ErrorKind::malformed, "m.ply:4", "before any element"},
      {"an unknown keyword", "elements vertex 1\n", "", ErrorKind::malformed, "m.ply:4", "'elements'"},
      {"texture coordinates for two of three", vertex + face + "property list uchar float texcoord\n",
       "0 0 0\n3 0 0 0 4 0 0 1 1\n", ErrorKind::malformed, "m.ply:13", "3 corners"},
      {"an edge to a missing vertex", vertex + "element edge 1\nproperty int vertex1\nproperty int vertex2\n",
       "0 0 0\n0 1\n", ErrorKind::malformed, "m.ply:13", "vertex 1"},
      {"no vertices at all", "element vertex 0\n" + xyzProperties, "", ErrorKind::malformed, "m.ply",
       "no triangles, lines or points"},
      {"only a face of two corners", vertex + face, "0 0 0\n2 0 0\n", ErrorKind::malformed, "m.ply", "no triangles"},
  };
  for (const Refused& refused : cases) {
    SCOPED_TRACE(refused.what);
    const Error error = errorOf(asciiPly(refused.elements, refused.body), "m.ply");
    EXPECT_EQ(error.kind(), refused.kind);
    EXPECT_EQ(error.location(), refused.location);
    EXPECT_NE(error.message().find(refused.words), std::string::npos) << error.message();
  }
}

/// A file with so many records that its text is read in chunks.
class LongPly : public ::testing::Test {
protected:
  static Mesh surface() {
    Mesh mesh = withVertexPerWedge(torus(200, 200));
    Random random(7);
    for (std::size_t vertex = 0; vertex < mesh.wedgeCount(); ++vertex)
      mesh.colors.push_back(random.color());
    return mesh;
  }

  /// The offset of the first character of a line, counted from 1.
  static std::size_t beginOf(const std::string& text, std::size_t line) {
    std::size_t at = 0;
    for (std::size_t i = 1; i < line; ++i)
      at = text.find('\n', at) + 1;
    return at;
  }

  const Mesh mesh = surface();
  const Bytes bytes = plyBytes(mesh, {.encoding = "ascii"});
  const std::string text{asText(bytes)};
  const std::size_t firstFaceLine =
      1 + mesh.wedgeCount() +
      static_cast<std::size_t>(std::count(text.begin(), text.begin() + text.find("end_header"), '\n')) + 1;
  const std::size_t vertexLine = 30'000, faceLine = 100'000;
};

TEST_F(LongPly, IsReadLikeAShortOne) {
  for (const std::size_t threads : {1u, 2u, 3u}) {
    limitThreads(threads);
    expectEqual(onlyMesh(text, "m.ply"), mesh);
  }
  limitThreads(0);
  expectEqual(onlyMesh(text.substr(0, text.size() - 1), "m.ply"), mesh); // without its last line feed
}

TEST_F(LongPly, MayHaveRecordsOfSeveralLines) {
  for (const std::size_t line : {vertexLine, faceLine, faceLine + 1}) {
    std::string other = text;
    other.insert(beginOf(text, line), "\n \n");
    expectEqual(onlyMesh(other, "m.ply"), mesh);
    other = text;
    other.replace(other.find(' ', beginOf(text, line)), 1, "\r\n");
    expectEqual(onlyMesh(other, "m.ply"), mesh);
  }
}

TEST_F(LongPly, MayHavePolygonsOfMoreThanThreeCorners) {
  const std::size_t at = beginOf(text, faceLine);
  const std::size_t end = text.find('\n', at);
  const std::string triangle = text.substr(at, end - at);
  std::string other = text;
  other.replace(at, triangle.size(), "4" + triangle.substr(1) + " 0");
  const Mesh quad = onlyMesh(other, "m.ply");
  EXPECT_EQ(quad.corners.size(), mesh.corners.size() + 3);
  const std::ptrdiff_t before = static_cast<std::ptrdiff_t>(3 * (faceLine - firstFaceLine));
  EXPECT_TRUE(std::equal(mesh.corners.begin(), mesh.corners.begin() + before, quad.corners.begin()));
  EXPECT_TRUE(std::equal(mesh.corners.begin() + before + 3, mesh.corners.end(), quad.corners.begin() + before + 6));
}

TEST_F(LongPly, NamesTheLineOfAnError) {
  for (const std::size_t line : {vertexLine, faceLine}) {
    std::string other = text;
    other[beginOf(text, line)] = 'x';
    const Error error = errorOf(other, "m.ply");
    EXPECT_EQ(error.kind(), ErrorKind::malformed);
    EXPECT_EQ(error.location(), fmt::format("m.ply:{}", line));
  }
  const Error cut = errorOf(text.substr(0, beginOf(text, faceLine)), "m.ply");
  EXPECT_EQ(cut.kind(), ErrorKind::truncated);
}

TEST(Ply, NamesTheByteInBinaryFiles) {
  Mesh mesh = withVertexPerWedge(grid(1));
  const PlyStyle style{.encoding = "binary_big_endian"};
  const Bytes whole = plyBytes(mesh, style);
  const std::size_t body = whole.size() - 4 * 12 - 2 * 13;
  const Error cut = errorOf(ByteSpan(whole).first(whole.size() - 14), "m.ply");
  EXPECT_EQ(cut.kind(), ErrorKind::truncated);
  EXPECT_EQ(cut.location(), fmt::format("m.ply, byte {}", body + 48 + 1)); // within the first face

  mesh.positions[1].y = std::numeric_limits<float>::quiet_NaN();
  const Error nan = errorOf(plyBytes(mesh, style), "m.ply");
  EXPECT_EQ(nan.kind(), ErrorKind::malformed);
  EXPECT_EQ(nan.location(), fmt::format("m.ply, byte {}", body + 24)); // after the vertex
}

TEST(Ply, RefusesOtherVersionsAndEncodings) {
  EXPECT_EQ(errorOf("ply\nformat ascii 2.0\nend_header\n", "m.ply").kind(), ErrorKind::unsupported);
  EXPECT_EQ(errorOf("ply\nformat binary 1.0\nend_header\n", "m.ply").kind(), ErrorKind::unsupported);
  EXPECT_EQ(errorOf("ply\nelement vertex 0\nend_header\n", "m.ply").kind(), ErrorKind::malformed);
  EXPECT_EQ(errorOf("plyers\n", "m.ply").kind(), ErrorKind::malformed);
}

TEST(Ply, AHeaderWithTooManyPropertiesOrElementsIsRefusedAtTheLineThatHasOneTooMany) {
  const auto messageOf = [](const std::string& header) -> std::string {
    try {
      readPlyHeader(asBytes(header), "a.ply");
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::limit);
      return error.what();
    }
    return "was read";
  };
  std::string properties = "ply\nformat ascii 1.0\nelement vertex 1\n", elements = "ply\nformat ascii 1.0\n";
  for (std::size_t i = 0; i <= maxPlyProperties; ++i)
    properties += fmt::format("property float p{}\n", i);
  for (std::size_t i = 0; i <= maxPlyElements; ++i)
    elements += fmt::format("element e{} 0\n", i);
  EXPECT_EQ(messageOf(properties + "end_header\n"), "a.ply:10004: the header has more than 10000 properties");
  EXPECT_EQ(messageOf(elements + "end_header\n"), "a.ply:1003: the header has more than 1000 elements");
}

} // namespace
} // namespace imgeo::testing
