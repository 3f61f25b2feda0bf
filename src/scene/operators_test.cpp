// Compares operators with vectors/operators.json, which web/src/document/operators.test.ts writes and reads.
#include "scene/operators.h"

#include "base/error.h"
#include "base/file.h"
#include "scene/testing.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace imgeo {
namespace {

using Json = nlohmann::ordered_json;

Vec3d vec3Of(const Json& numbers) {
  return {numbers.at(0).get<double>(), numbers.at(1).get<double>(), numbers.at(2).get<double>()};
}

void expectNear(const Vec3d& actual, const Json& expected) {
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(actual[axis], vec3Of(expected)[axis], 1e-12) << "axis " << axis;
}

std::vector<Operator> operatorsOf(std::string_view text) {
  const auto [operators, problem] = readOperators(text, true);
  EXPECT_EQ(problem, "");
  return operators;
}

TEST(Operators, AreThoseOfTheVectors) {
  const Json vectors = Json::parse(asText(readFile(std::filesystem::path(IMGEO_VECTORS) / "operators.json")));
  ASSERT_GT(vectors.size(), 60u);
  for (const Json& vector : vectors) {
    const std::string text = vector.at("text").get<std::string>();
    SCOPED_TRACE(text);
    const auto [operators, problem] = readOperators(text, true);
    if (vector.contains("problem")) {
      EXPECT_TRUE(operators.empty());
      EXPECT_EQ(refusalOf(text, problem) + "; none is applied", vector.at("problem").get<std::string>());
      continue;
    }
    ASSERT_EQ(problem, "");
    ASSERT_EQ(operators.size(), vector.at("operators").size());
    for (std::size_t i = 0; i < operators.size(); ++i) {
      const Json& expected = vector.at("operators").at(i);
      EXPECT_EQ(nameOf(operators[i].kind), expected.at("kind").get<std::string>());
      expectNear(operators[i].a, expected.at("a"));
      expectNear(operators[i].b, expected.at("b"));
    }
    EXPECT_EQ(nameOf(orientationOf(operators)), vector.at("orientation").get<std::string>());
    for (const Json& point : vector.at("points"))
      expectNear(operatedPoint(operators, vec3Of(point.at("from"))), point.at("to"));
    for (const Json& box : vector.at("boxes")) {
      const Json &from = box.at("from"), &to = box.at("to");
      const Box3d mapped = operatedBox(operators, {vec3Of(from.at("min")), vec3Of(from.at("max"))});
      expectNear(mapped.min, to.at("min"));
      expectNear(mapped.max, to.at("max"));
    }
  }
}

TEST(Operators, AreRefusedInOneLineWhateverTheirBytesAre) {
  for (const char byte : {'x', '\x94', '\xf0'}) {
    const std::string text = "translate(1 " + std::string(1000, byte) + ")";
    const auto [operators, problem] = readOperators(text, true);
    EXPECT_TRUE(operators.empty());
    EXPECT_LT(problem.size(), 400u);
    EXPECT_LT(refusalOf(text, problem).size(), 800u);
  }
}

/// The volume that a closed mesh encloses; negative where the fronts of its triangles are inside.
double volumeOf(const Mesh& mesh) {
  double volume = 0;
  for (std::size_t corner = 0; corner < mesh.corners.size(); corner += 3)
    volume += dot(Vec3d(mesh.cornerPosition(corner)),
                  cross(Vec3d(mesh.cornerPosition(corner + 1)), Vec3d(mesh.cornerPosition(corner + 2)))) /
              6;
  return volume;
}

TEST(Operators, KeepTheFrontOfTrianglesAndNormalsOutside) {
  for (const char* text : {"", "negate()", "negate(y)", "negate(xy)", "swizzle(yxz)", "swizzle(yzx) negate(x)",
                           "scale(0.7 -0.9 0.8) translate(0.05 -0.1 0)", "gamma(1.3 0.8 2) negate()"}) {
    SCOPED_TRACE(text);
    Mesh mesh = testing::sphere(24, 32);
    const double volume = volumeOf(mesh);
    applyOperators(mesh, operatorsOf(text), OperatorFrame::of(boxOf(mesh)), "sphere");
    EXPECT_GT(volumeOf(mesh), 0.3 * volume);
    // Each normal lies on the side of its triangle's front, and close to the triangle's own.
    for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner) {
      const std::size_t first = corner - corner % 3;
      const Vec3d a(mesh.cornerPosition(first)), b(mesh.cornerPosition(first + 1)), c(mesh.cornerPosition(first + 2));
      const Vec3d face = cross(b - a, c - a), normal(mesh.normals[mesh.corners[corner]]);
      EXPECT_NEAR(length(normal), 1, 1e-5);
      EXPECT_GT(dot(face, normal), 0.3 * length(face)) << "corner " << corner;
    }
  }
}

TEST(Operators, FlattenSurfacesWithoutLosingTheirNormals) {
  Mesh mesh = testing::sphere(8, 8);
  applyOperators(mesh, operatorsOf("threshold(0.5)"), OperatorFrame::of(boxOf(mesh)), "sphere");
  const Box3d box = boxOf(mesh);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(box.max[axis], 0, 1e-6);
  for (const Vec3f& normal : mesh.normals)
    EXPECT_NEAR(length(Vec3d(normal)), 1, 1e-5);
}

TEST(Operators, KeepNormalsUnitVectorsWhereSlopesMultiplyToTinyNumbers) {
  for (const char* text : {"gamma(22) scale(-1) gamma(60) scale(-1 4 0)", "gamma(60) scale(-1) gamma(60)",
                           "gamma(9) gamma(9) gamma(9) gamma(9)"}) {
    SCOPED_TRACE(text);
    Mesh mesh = testing::sphere(24, 32);
    applyOperators(mesh, operatorsOf(text), OperatorFrame::of(boxOf(mesh)), "sphere");
    for (const Vec3f& normal : mesh.normals)
      EXPECT_NEAR(length(Vec3d(normal)), 1, 1e-5);
  }
}

TEST(Operators, LeaveAMeshWhoseBoxIsFlatFinite) {
  Mesh mesh;
  mesh.positions = {{0, 2, 0}, {1, 2, 0}, {0, 2, 4}};
  mesh.wedgePositions = mesh.corners = {0, 1, 2};
  applyOperators(mesh, operatorsOf("scale(0.5) translate(0 0.25 0)"), OperatorFrame::of(boxOf(mesh)), "flat");
  EXPECT_EQ(mesh.positions, (std::vector<Vec3f>{{0.25f, 4, 1}, {0.75f, 4, 1}, {0.25f, 4, 3}}));
}

TEST(Operators, RefuseToMoveVerticesFartherThanFloatsReach) {
  Mesh mesh = testing::sphere(8, 8);
  try {
    for (Vec3f& position : mesh.positions)
      position = position * 1e37f;
    applyOperators(mesh, operatorsOf("scale(1e6)"), OperatorFrame::of(boxOf(mesh)), "sphere");
    ADD_FAILURE() << "was mapped";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_EQ(error.location(), "sphere");
  }
}

} // namespace
} // namespace imgeo
