#include "base/error.h"
#include "base/testing.h"
#include "imgeo/imgeo.h"
#include "scene/shape_instances.h"
#include "transcode/sample/relief_surface.h"
#include "transcode/sample/sample_file.h"
#include "transcode/sample/sample_hall.h"

#include <gtest/gtest.h>
#include <set>

namespace imgeo {
namespace {

TEST(SampleHall, HasOneMeshForAllItsSeats) {
  const Scene scene = hallScene(95);
  std::size_t seats = 0;
  for (const ShapeInstance& instance : shapeInstances(scene.graph))
    seats += scene.graph.nodes[instance.node].name == "seat";
  EXPECT_EQ(seats, 95u);
  EXPECT_LT(scene.meshes.size(), 10u);
  for (const Mesh& mesh : scene.meshes) {
    EXPECT_TRUE(isConsistent(mesh)) << mesh.name;
    for (const Vec3f& normal : mesh.normals)
      ASSERT_NEAR(length(Vec3d(normal)), 1, 1e-5) << mesh.name;
    // Front sides of faces are where their normals point.
    for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
      const Vec3d a(mesh.cornerPosition(i)), b(mesh.cornerPosition(i + 1)), c(mesh.cornerPosition(i + 2));
      const Vec3d normal = cross(b - a, c - a);
      if (length(normal) <= 1e-7)
        continue;
      const Vec3d facing = Vec3d(mesh.normals[mesh.corners[i]]) + Vec3d(mesh.normals[mesh.corners[i + 1]]);
      ASSERT_GT(dot(normal, facing), 0) << mesh.name;
    }
  }
}

TEST(SampleHall, BecomesASiteThatStoresEachMeshOnce) {
  const testing::TemporaryDirectory directory;
  const ExportReport sample = writeSampleHall(200, directory / "hall.glb");
  EXPECT_GT(sample.elements.triangles, 500'000u);
  const ConvertReport report = convert(directory / "hall.glb", directory / "site", {});
  EXPECT_LT(report.elements.triangles, 60'000u);
  EXPECT_EQ(report.warnings, std::vector<std::string>{});
  const VerifyReport verified = verify(directory / "site", directory / "hall.glb");
  EXPECT_TRUE(verified.equal) << verified.findings.at(0);
  EXPECT_THROW(writeSampleHall(1, directory / "hall.ply"), Error);
}

TEST(SampleRelief, IsClosedAndHasEveryVertexOnce) {
  for (const std::uint64_t triangles : {12u, 48u, 3072u}) {
    const ReliefSurface surface(triangles);
    EXPECT_EQ(surface.triangleCount(), triangles);
    std::set<std::pair<std::uint64_t, std::uint64_t>> edges;
    std::set<std::uint64_t> vertices;
    for (std::uint64_t i = 0; i < surface.triangleCount(); ++i) {
      const std::array<std::uint64_t, 3> corners = surface.triangle(i);
      const auto at = [&](std::size_t corner) { return Vec3d(surface.vertex(corners[corner])); };
      EXPECT_GT(dot(cross(at(1) - at(0), at(2) - at(0)), at(0)), 0) << "faces inwards";
      for (std::size_t corner = 0; corner < 3; ++corner) {
        EXPECT_TRUE(edges.emplace(corners[corner], corners[(corner + 1) % 3]).second);
        vertices.insert(corners[corner]);
      }
    }
    for (const auto& [from, to] : edges)
      EXPECT_TRUE(edges.contains({to, from}));
    EXPECT_EQ(vertices.size(), surface.vertexCount());
    EXPECT_EQ(*vertices.rbegin() + 1, surface.vertexCount());
  }
}

TEST(SampleRelief, HasDetailOfAllSizes) {
  const ReliefSurface fine(30000);
  double low = 2, high = 0;
  for (std::uint64_t i = 0; i < fine.vertexCount(); ++i) {
    low = std::min(low, length(Vec3d(fine.vertex(i))));
    high = std::max(high, length(Vec3d(fine.vertex(i))));
  }
  EXPECT_GT(low, 0.8);
  EXPECT_LT(high, 1.2);
  EXPECT_GT(high - low, 0.1);
}

TEST(SampleRelief, HasAPointOfTheSurfaceInEachSquare) {
  const ReliefSurface surface(24000);
  std::set<std::array<float, 3>> points;
  for (std::uint64_t i = 0; i < surface.squareCount(); ++i) {
    const Vec3f point = surface.pointInSquare(i);
    EXPECT_NEAR(length(Vec3d(point)), 1, 0.2);
    points.insert({point.x, point.y, point.z});
  }
  EXPECT_EQ(points.size(), surface.squareCount());
}

TEST(SampleCloud, HasTheSamePointsInAnotherOrder) {
  const testing::TemporaryDirectory directory;
  const ExportReport report = writeSampleCloud(600, false, directory / "cloud.ply");
  EXPECT_EQ(report.elements.points, 600u);
  EXPECT_EQ(report.bytes, std::filesystem::file_size(directory / "cloud.ply"));
  writeSampleCloud(600, true, directory / "shuffled.ply");
  const auto records = [&](const char* name) {
    const std::string text(asText(readFile(directory / name)));
    std::multiset<std::string> all;
    for (std::size_t at = text.find("end_header\n") + 11; at < text.size(); at += 18)
      all.insert(text.substr(at, 18));
    return all;
  };
  EXPECT_EQ(records("cloud.ply"), records("shuffled.ply"));
  EXPECT_EQ(records("cloud.ply").size(), 600u);
  EXPECT_THROW(writeSampleCloud(600, false, directory / "cloud.glb"), Error);
}

TEST(SampleRelief, IsScatteredByABijection) {
  for (const std::uint64_t count : {1u, 2u, 17u, 1000u, 4096u}) {
    const Scattering scattering(count, 3);
    std::set<std::uint64_t> values;
    for (std::uint64_t i = 0; i < count; ++i) {
      EXPECT_EQ(scattering.inverse(scattering.of(i)), i);
      values.insert(scattering.of(i));
    }
    EXPECT_EQ(values.size(), count);
    EXPECT_LT(*values.rbegin(), count);
  }
}

} // namespace
} // namespace imgeo
