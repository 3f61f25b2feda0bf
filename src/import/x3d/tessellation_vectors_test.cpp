// Compares tessellations with vectors/tessellation, their inputs and outputs. web/src/tessellate/tessellation.test.ts
// reads the same files, and rewrites them where IMGEO_REWRITE_GOLDEN is set.
#include "base/error.h"
#include "base/file.h"
#include "base/testing.h"
#include "import/mesh/triangulate.h"
#include "import/testing.h"
#include "import/x3d/elevation_grid.h"
#include "import/x3d/extrusion.h"
#include "import/x3d/faces.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <numbers>

namespace imgeo::x3d {
namespace {

using Json = nlohmann::json;

Json vectorsOf(const std::string& name) {
  return Json::parse(asText(readFile(std::filesystem::path(IMGEO_VECTORS) / "tessellation" / (name + ".json"))));
}

using Numbers = std::vector<double>;

void expectNear(const Numbers& actual, const Numbers& expected, double tolerance) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(actual[i], expected[i], tolerance) << "number " << i;
}

std::vector<Vec3f> vec3sOf(const Json& numbers) {
  const auto flat = numbers.get<std::vector<float>>();
  std::vector<Vec3f> vectors;
  for (std::size_t i = 0; i + 2 < flat.size(); i += 3)
    vectors.push_back({flat[i], flat[i + 1], flat[i + 2]});
  return vectors;
}

Numbers numbersOf(const std::vector<Vec3f>& vectors) {
  Numbers numbers;
  for (const Vec3f& vector : vectors)
    numbers.insert(numbers.end(), {vector.x, vector.y, vector.z});
  return numbers;
}

Numbers numbersOf(const std::vector<Vec2f>& vectors) {
  Numbers numbers;
  for (const Vec2f& vector : vectors)
    numbers.insert(numbers.end(), {vector.x, vector.y});
  return numbers;
}

/// The faces as lists of one of their corners' indices.
Json indicesOf(const Faces& faces, std::uint32_t Corner::*index) {
  Json all = Json::array();
  std::size_t begin = 0;
  for (const std::size_t end : faces.ends) {
    Json& face = all.emplace_back(Json::array());
    for (; begin < end; ++begin)
      face.push_back(faces.corners[begin].*index);
  }
  return all;
}

void expectSurface(const VertexData& data, const Faces& faces, const Json& vector) {
  expectNear(numbersOf(data.positions), vector["positions"], 1e-5);
  expectNear(numbersOf(data.texCoords), vector["texCoords"], 1e-6);
  EXPECT_EQ(indicesOf(faces, &Corner::position), vector["faces"]);
}

TEST(TessellationVectors, CutEars) {
  for (const Json& vector : vectorsOf("earClipping")) {
    SCOPED_TRACE(vector["name"]);
    std::vector<std::uint32_t> triangles;
    triangulate(vec3sOf(vector["ring"]), triangles);
    EXPECT_EQ(Json(triangles), vector["triangles"]);
  }
}

TEST(TessellationVectors, ComputeCreaseNormals) {
  for (const Json& vector : vectorsOf("creaseNormals")) {
    SCOPED_TRACE(vector["name"]);
    VertexData data;
    data.positions = vec3sOf(vector["positions"]);
    Faces faces;
    for (const Json& face : vector["faces"]) {
      for (const std::uint32_t position : face)
        faces.corners.push_back({position, none, none, none});
      faces.ends.push_back(faces.corners.size());
    }
    addCreaseNormals(data, faces, vector["creaseAngle"]);
    std::vector<Vec3f> normals;
    for (const Corner& corner : faces.corners)
      normals.push_back(data.normals.at(corner.normal));
    expectNear(numbersOf(normals), vector["normals"], 1e-6);
  }
}

TEST(CreaseNormals, AreThoseOfFacesWhereMoreMeetThanAreCompared) {
  VertexData data;
  data.positions.push_back({0, 0, 1});
  Faces cone;
  const std::uint32_t sides = maxComparedFaces + 1;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    data.positions.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0});
    for (const std::uint32_t position : {0u, 1 + i, 1 + (i + 1) % sides})
      cone.corners.push_back({position, none, none, none});
    cone.ends.push_back(cone.corners.size());
  }
  for (const bool isSmooth : {false, true}) {
    VertexData creased = data;
    Faces faces = cone;
    addCreaseNormals(creased, faces, isSmooth ? std::numbers::pi : 3);
    const Vec3f apex = creased.normals.at(faces.corners[0].normal);
    EXPECT_NEAR(apex[0], isSmooth ? 0 : std::sqrt(0.5), 1e-4);
    EXPECT_NEAR(apex[2], isSmooth ? 1 : std::sqrt(0.5), 1e-4);
  }
}

TEST(TessellationVectors, SweepExtrusions) {
  for (const Json& vector : vectorsOf("extrusion")) {
    SCOPED_TRACE(vector["name"]);
    Extrusion extrusion{{}, {}, {}, {}, vector["beginCap"], vector["endCap"]};
    const auto tuples = [&](const char* field, std::size_t size, const auto& add) {
      const Numbers numbers = vector[field];
      for (std::size_t i = 0; i + size <= numbers.size(); i += size)
        add(numbers.data() + i);
    };
    tuples("crossSection", 2, [&](const double* at) { extrusion.crossSection.push_back({at[0], at[1]}); });
    tuples("spine", 3, [&](const double* at) { extrusion.spine.push_back({at[0], at[1], at[2]}); });
    tuples("scale", 2, [&](const double* at) { extrusion.scale.push_back({at[0], at[1]}); });
    tuples("orientation", 4, [&](const double* at) { extrusion.orientation.push_back({at[0], at[1], at[2], at[3]}); });
    VertexData data;
    Faces faces;
    extrude(extrusion, data, faces);
    expectSurface(data, faces, vector);
    EXPECT_EQ(indicesOf(faces, &Corner::texCoord), vector["texCoordFaces"]);
  }
}

TEST(TessellationVectors, MakeElevationGrids) {
  for (const Json& vector : vectorsOf("elevationGrid")) {
    SCOPED_TRACE(vector["name"]);
    const Numbers heights = vector["height"];
    VertexData data;
    Faces faces;
    addElevationGrid({vector["xDimension"], vector["zDimension"], vector["xSpacing"], vector["zSpacing"], heights},
                     data, faces);
    expectSurface(data, faces, vector);
  }
}

TEST(TessellationVectors, ReadGeometryNodes) {
  for (const Json& vector : vectorsOf("geometryNodes")) {
    SCOPED_TRACE(vector["name"]);
    const std::string node = vector["node"];
    ImportOptions options;
    options.inlineBytes = 0;
    const std::string appearance = "<Appearance><PixelTexture image='1 1 1 255'/></Appearance>";
    const Mesh mesh = imgeo::testing::onlyMesh(
        "<X3D version='4.0'><Scene><Shape>" + appearance + node + "</Shape></Scene></X3D>", "a.x3d", options);
    VertexData data;
    Numbers colors;
    for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
      const std::uint32_t wedge = mesh.corners[i];
      data.positions.push_back(mesh.cornerPosition(i));
      if (!mesh.normals.empty())
        data.normals.push_back(mesh.normals[wedge]);
      if (!mesh.texCoords.empty())
        data.texCoords.push_back(mesh.texCoords[wedge]);
      if (!mesh.colors.empty()) {
        const Rgba8 color = asRgba8(mesh.colors[wedge]);
        colors.insert(colors.end(), {double(color.r), double(color.g), double(color.b)});
      }
    }
    const Json& corners = vector["corners"];
    const std::map<std::string, Topology> topologies{
        {"triangles", Topology::triangles}, {"lines", Topology::lines}, {"points", Topology::points}};
    EXPECT_EQ(mesh.topology, topologies.at(corners["primitive"]));
    expectNear(numbersOf(data.positions), corners["positions"], 1e-6);
    expectNear(numbersOf(data.texCoords), corners["texCoords"], 1e-6);
    expectNear(colors, corners["colors"], 0);
    if (!data.normals.empty()) // normals that are smooth everywhere are computed later
      expectNear(numbersOf(data.normals), corners["normals"], 1e-6);
  }
}

TEST(TessellationVectors, ReadNodesThatStateSizes) {
  for (const Json& vector : vectorsOf("solids")) {
    SCOPED_TRACE(vector["name"]);
    const std::string node = vector["node"];
    ImportOptions options;
    options.solids = true;
    const Mesh mesh = imgeo::testing::onlyMesh("<X3D version='4.0'><Scene><Shape>" + node + "</Shape></Scene></X3D>",
                                               "a.x3d", options);
    const Json& elements = vector["elements"];
    EXPECT_EQ(mesh.elementCount(), elements["elementCount"]);
    EXPECT_EQ(mesh.topology, elements["primitive"] == "lines" ? Topology::lines : Topology::triangles);
    const std::size_t cornerCount = cornersPerElement(mesh.topology), every = vector["every"];
    VertexData some;
    for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
      if (i / cornerCount % every != 0)
        continue;
      some.positions.push_back(mesh.cornerPosition(i));
      if (!mesh.normals.empty())
        some.normals.push_back(mesh.normals[mesh.corners[i]]);
      if (!mesh.texCoords.empty())
        some.texCoords.push_back(mesh.texCoords[mesh.corners[i]]);
    }
    expectNear(numbersOf(some.positions), elements["positions"], 1e-6);
    expectNear(numbersOf(some.normals), elements["normals"], 1e-6);
    expectNear(numbersOf(some.texCoords), elements["texCoords"], 1e-6);
  }
}

TEST(TessellationVectors, RefuseWordsThatAreNotNumbers) {
  for (const std::string node : vectorsOf("refused")) {
    const std::string scene = "<X3D version='4.0'><Scene><Shape>" + node + "</Shape></Scene></X3D>";
    EXPECT_EQ(importBytes(asBytes(scene), "a.x3d", {}).warnings.size(), 1u) << node;
    ImportOptions strict;
    strict.strict = true;
    EXPECT_THROW(importBytes(asBytes(scene), "a.x3d", strict), Error) << node;
  }
}

} // namespace
} // namespace imgeo::x3d
