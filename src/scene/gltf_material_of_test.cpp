#include "scene/gltf_material_of.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

TEST(GltfMaterialOf, MakesPhongMaterialsRoughDielectricsAndKeepsOthers) {
  const GltfMaterial paint =
      gltfMaterialOf(Material{.diffuseColor{1, 0, 0.5f}, .shininess = 0.25f, .transparency = 0.5f}, false);
  const PhysicalMaterial& physical = std::get<PhysicalMaterial>(paint);
  EXPECT_EQ(physical.metallic, 0);
  EXPECT_EQ(physical.roughness, 0.75f);
  EXPECT_EQ(physical.transparency, 0.5f);
  EXPECT_EQ(physical.baseColor.x, 1);
  EXPECT_NEAR(physical.baseColor.z, 0.214, 1e-3); // linear
  const PhysicalMaterial gold{.baseColor{1, 0.8f, 0}};
  const UnlitMaterial lamp{.emissiveColor{1, 0.5f, 0}};
  EXPECT_EQ(gltfMaterialOf(gold, false), GltfMaterial(gold));
  EXPECT_EQ(gltfMaterialOf(lamp, false), GltfMaterial(lamp));
}

TEST(GltfMaterialOf, IsWhiteUnderVertexColors) {
  const Vec3f white{1, 1, 1};
  EXPECT_EQ(std::get<PhysicalMaterial>(gltfMaterialOf(Material{.diffuseColor{1, 0, 0}}, true)).baseColor, white);
  EXPECT_EQ(std::get<PhysicalMaterial>(gltfMaterialOf(PhysicalMaterial{.baseColor{1, 0, 0}}, true)).baseColor, white);
  EXPECT_EQ(std::get<UnlitMaterial>(gltfMaterialOf(UnlitMaterial{.emissiveColor{1, 0, 0}}, true)).emissiveColor, white);
}

} // namespace
} // namespace imgeo
