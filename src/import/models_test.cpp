// Tests with well-known scans, skipped where their files are absent.
#include "import/import.h"

#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

std::filesystem::path sharedModel(const char* name) {
  const char* shared = std::getenv("IMGEO_SHARED");
  return shared ? std::filesystem::path(shared) / "models" / name : std::filesystem::path(name);
}

TEST(Models, TheBunnyIsReadCompletely) {
  const auto path = sharedModel("stanford-bunny.obj");
  if (!std::filesystem::exists(path))
    GTEST_SKIP() << "no " << path;
  const Imported imported = importFile(path);
  EXPECT_EQ(imported.format, "OBJ");
  ASSERT_EQ(imported.scene.meshes.size(), 1u);
  EXPECT_EQ(imported.scene.meshes[0].positions.size(), 35947u);
  EXPECT_EQ(imported.scene.meshes[0].elementCount(), 69451u);
  EXPECT_TRUE(isConsistent(imported.scene.meshes[0]));
}

TEST(Models, TheHorseIsReadWithItsNormals) {
  const auto path = sharedModel("horse.ply");
  if (!std::filesystem::exists(path))
    GTEST_SKIP() << "no " << path;
  const Imported imported = importFile(path);
  EXPECT_EQ(imported.format, "PLY");
  EXPECT_EQ(imported.warnings, std::vector<std::string>{});
  ASSERT_EQ(imported.scene.meshes.size(), 1u);
  const Mesh& mesh = imported.scene.meshes[0];
  EXPECT_EQ(mesh.positions.size(), 48485u);
  EXPECT_EQ(mesh.elementCount(), 96966u);
  EXPECT_EQ(mesh.normals.size(), 48485u);
  EXPECT_TRUE(isConsistent(mesh));
  for (const Vec3f& normal : mesh.normals)
    ASSERT_NEAR(length(Vec3d(normal)), 1, 1e-5);
}

} // namespace
} // namespace imgeo
