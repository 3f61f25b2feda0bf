#include "scene/appearance.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

TEST(PhongOf, KeepsPhongMaterialsAndConvertsOthers) {
  const Material material{.diffuseColor{1, 0, 0}, .transparency = 0.5f};
  EXPECT_EQ(phongOf(material), material);
  const Material plaster = phongOf(PhysicalMaterial{.baseColor{1, 1, 1}, .metallic = 0, .roughness = 1});
  EXPECT_NEAR(plaster.diffuseColor.x, 1, 1e-6);
  EXPECT_EQ(plaster.specularColor, (Vec3f{0, 0, 0}));
  const Material mirror = phongOf(PhysicalMaterial{.baseColor{1, 0, 0}, .metallic = 1, .roughness = 0});
  EXPECT_NEAR(mirror.specularColor.x, 1, 1e-6);
  EXPECT_NEAR(mirror.specularColor.y, 0, 1e-6);
  EXPECT_GT(mirror.diffuseColor.x, 0.5f);
  EXPECT_EQ(phongOf(UnlitMaterial{.emissiveColor{0, 1, 0}}).emissiveColor, (Vec3f{0, 1, 0}));
}

} // namespace
} // namespace imgeo
