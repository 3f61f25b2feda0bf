#include "containers/compact/base.h"

#include "containers/container_reader.h"

#include "base/error.h"
#include "prepare/base_mesh_testing.h"
#include "prepare/weld.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

using namespace testing;

struct EncodedBase {
  PatchedMesh patched;
  BaseMesh base;
  GeometryDescription geometry;
  std::vector<compact::CompactPatch> bases;

  FetchFile fetch() const {
    return [this](const std::string&) { return baseFile(bases).bytes; };
  }
  std::vector<PatchTriangles> triangles() const {
    std::vector<PatchTriangles> triangles;
    for (const Patch& patch : patched.patches)
      triangles.push_back(trianglesOf(patch));
    return triangles;
  }
};

EncodedBase encoded(Mesh mesh, std::uint32_t maxWedges) {
  weld(mesh);
  EncodedBase result;
  result.patched = cutIntoPatches(mesh, latticeFor(boxOf(mesh), 16), maxWedges);
  result.base = baseOf(result.patched, 2).value();
  EncodeOptions options;
  options.encoding = Encoding::compact;
  result.geometry = describe(result.patched, options);
  result.geometry.patches.resize(result.patched.patches.size());
  result.geometry.base = Reference{"base.png", PatchLocation{}};
  result.bases = {quantiseBase(result.base, result.geometry, 12, 8)};
  return result;
}

TEST(CompactBase, DecodesWithoutGapsToPatches) {
  const EncodedBase mesh = encoded(sphere(100, 100), 3000);
  ASSERT_GT(mesh.patched.patches.size(), 3u);
  const BaseMesh decoded = ContainerReader(mesh.fetch()).decodeBase(mesh.geometry);
  EXPECT_EQ(decoded.triangleCount(), mesh.base.triangleCount());
  EXPECT_EQ(decoded.positions.size(), mesh.base.positions.size());
  EXPECT_TRUE(meetsAtBorders(decoded, mesh.triangles()));
  expectClosedMixtures(decoded, mesh.triangles());
}

TEST(CompactBase, MovesVerticesByNoMoreThanTwoPercent) {
  const EncodedBase mesh = encoded(sphere(100, 100), 65535);
  const BaseMesh decoded = ContainerReader(mesh.fetch()).decodeBase(mesh.geometry);
  const double radius = mesh.patched.lattice.maximum() / 2.0;
  for (const Vec3u& position : decoded.positions)
    EXPECT_NEAR(length(Vec3d(position) - Vec3d{radius, radius, radius}), radius, 0.02 * radius);
}

TEST(CompactBase, TakesLessThanOneAndAHalfBytesPerTriangle) {
  const EncodedBase mesh = encoded(sphere(200, 200), 65535);
  EXPECT_LT(static_cast<double>(baseFile(mesh.bases).bytes.size()),
            1.5 * static_cast<double>(mesh.base.triangleCount()));
}

TEST(CompactBase, IsReadFromAFileOfSeveralBases) {
  EncodedBase mesh = encoded(sphere(100, 100), 3000);
  mesh.bases.push_back(mesh.bases[0]);
  mesh.geometry.base->location = PatchLocation{1};
  EXPECT_EQ(ContainerReader(mesh.fetch()).decodeBase(mesh.geometry).triangleCount(), mesh.base.triangleCount());
}

TEST(CompactBase, IsRefusedIfItDoesNotMatchTheNode) {
  EncodedBase mesh = encoded(sphere(100, 100), 3000);
  mesh.geometry.patches.emplace_back();
  EXPECT_THROW(ContainerReader(mesh.fetch()).decodeBase(mesh.geometry), Error);
  mesh.geometry.patches.pop_back();
  mesh.geometry.lattice.bits = 15;
  EXPECT_THROW(ContainerReader(mesh.fetch()).decodeBase(mesh.geometry), Error);
}

} // namespace
} // namespace imgeo
