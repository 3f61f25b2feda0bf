// Compares grids with vectors/grids.json, which web/src/decode/classic/classicGrid.test.ts writes and reads.
#include "base/file.h"
#include "base/testing.h"
#include "containers/container_reader.h"
#include "containers/grid.h"
#include "containers/png/png.h"
#include "containers/read_mesh.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace imgeo {
namespace {

using Json = nlohmann::ordered_json;

Vec3d vec3Of(const Json& numbers) {
  return {numbers.at(0).get<double>(), numbers.at(1).get<double>(), numbers.at(2).get<double>()};
}

void expectNear(const std::vector<Vec3d>& actual, const Json& expected, double tolerance) {
  ASSERT_EQ(3 * actual.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(actual[i / 3][static_cast<int>(i % 3)], expected[i].get<double>(), tolerance) << "number " << i;
}

/// The geometry of a vector; its images are "0", "1" ...
GeometryDescription geometryOf(const Json& vector) {
  GeometryDescription geometry;
  for (const GridKind kind : {GridKind::heightMap, GridKind::geometryImage, GridKind::sculpt})
    if (vector.at("kind") == nameOf(kind))
      geometry.grid = kind;
  geometry.ccw = vector.at("ccw").get<bool>();
  PatchDescription patch;
  patch.implicitMeshSize = {vector.at("columns").get<std::uint32_t>(), vector.at("rows").get<std::uint32_t>()};
  patch.vertexCount = patch.implicitMeshSize.x * patch.implicitMeshSize.y;
  const std::size_t planes = vector.at("planes").size();
  for (std::size_t plane = 0; plane < planes; ++plane)
    patch.coord.push_back({std::to_string(plane), TexelLocation{}});
  Vec2<std::uint32_t> whole = patch.implicitMeshSize;
  if (vector.contains("part")) {
    const Json& part = vector.at("part");
    patch.gridOrigin = {part.at("column").get<std::uint32_t>(), part.at("row").get<std::uint32_t>()};
    whole = {part.at("columns").get<std::uint32_t>(), part.at("rows").get<std::uint32_t>()};
  }
  const DecodeFields box{vec3Of(vector.at("position")), vec3Of(vector.at("size"))};
  const auto bits = static_cast<std::uint32_t>(8 * planes);
  geometry.lattice = geometry.grid == GridKind::heightMap ? heightMapLattice(box, whole, std::max(bits, 16u))
                                                          : latticeOf(box, Encoding::classic, ElementType::uint8, bits);
  geometry.patches.push_back(std::move(patch));
  return geometry;
}

Bytes imageOf(const Json& vector, const std::string& url) {
  const auto pixels = vector.at("planes").at(std::stoul(url)).get<std::vector<std::uint8_t>>();
  return encodePng({vector.at("width").get<std::uint32_t>(), vector.at("rows").get<std::uint32_t>(),
                    vector.at("channels").get<std::uint32_t>(), pixels},
                   1);
}

TEST(Grid, IsThatOfTheVectors) {
  const Json vectors = Json::parse(asText(readFile(std::filesystem::path(IMGEO_VECTORS) / "grids.json")));
  ASSERT_GE(vectors.size(), 5u);
  for (const Json& vector : vectors) {
    SCOPED_TRACE(vector.at("name").get<std::string>());
    const GeometryDescription geometry = geometryOf(vector);
    const IndexedPatch patch =
        decodePatch(geometry.patches[0], geometry, [&](const std::string& url) { return imageOf(vector, url); });
    EXPECT_EQ(Json(patch.indices), vector.at("index"));
    std::vector<Vec3d> points, normals;
    for (const Vec3u& position : patch.positions)
      points.push_back(geometry.lattice.point(position));
    expectNear(points, vector.at("points"), 1e-5);
    for (const Vec3f& normal : slopeNormals(*geometry.grid, geometry.patches[0].implicitMeshSize, patch.positions,
                                            geometry.lattice, geometry.ccw))
      normals.emplace_back(normal);
    expectNear(normals, vector.at("normals"), 1e-5);
  }
}

TEST(Grid, StatesTheBoxFromWhichItsLatticeIsRead) {
  const DecodeFields box{{1, 2, 3}, {300, 40, 200}};
  const Lattice lattice = heightMapLattice(box, {31, 21}, 16);
  EXPECT_EQ(lattice.point({3, 0, 2}), (Vec3d{1 - 150 + 30, 2 - 20, 3 - 100 + 20}));
  const DecodeFields again = heightMapBox(lattice, {31, 21});
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(again.position[axis], box.position[axis], 1e-12);
    EXPECT_NEAR(again.size[axis], box.size[axis], 1e-12);
  }
}

} // namespace
} // namespace imgeo
