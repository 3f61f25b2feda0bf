#include "base/error.h"
#include "base/testing.h"
#include "imgeo/imgeo.h"
#include "scene/shape_instances.h"
#include "transcode/sample/sample_file.h"
#include "transcode/sample/sample_hall.h"

#include <gtest/gtest.h>

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

} // namespace
} // namespace imgeo
