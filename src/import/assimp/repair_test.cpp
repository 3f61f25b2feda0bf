#include "base/testing.h"
#include "import/assimp/assimp.h"
#include "scene/testing.h"

#include <algorithm>
#include <bit>
#include <gtest/gtest.h>

namespace imgeo::testing {
namespace {

/// An AC3D file whose world has a triangle and the objects before it.
std::string ac3d(int objectCount, const std::string& objects) {
  return "AC3Db\nMATERIAL \"m\" rgb 1 1 1 amb 0.2 0.2 0.2 emis 0 0 0 spec 0.5 0.5 0.5 shi 10 trans 0\n"
         "OBJECT world\nkids " +
         std::to_string(objectCount + 1) + "\n" + objects +
         "OBJECT poly\nname \"t\"\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\n"
         "numsurf 1\nSURF 0x20\nmat 0\nrefs 3\n0 0 0\n1 1 0\n2 0 1\nkids 0\n";
}

TEST(AssimpRepair, ReadsLightsOfOneName) {
  const std::string lamp = "OBJECT light\nname \"lamp\"\nloc ";
  const std::string lamps = lamp + "1 2 3\nkids 0\n" + lamp + "-1 2 3\nkids 0\n";
  const Imported imported = readByAssimp(asBytes(ac3d(2, lamps)), "a.ac", {});
  const SceneGraph& graph = imported.scene.graph;
  EXPECT_EQ(imported.scene.meshes.at(0).elementCount(), 1u);
  EXPECT_EQ(std::ranges::count_if(
                nodesInOrder(graph),
                [&](std::size_t node) { return std::holds_alternative<PointLight>(graph.nodes[node].content); }),
            2);
  EXPECT_EQ(imported.warnings, std::vector<std::string>{});
}

/// A chunk of a B3D file.
std::string chunk(const std::string& tag, const std::string& content) {
  const auto size = static_cast<std::uint32_t>(content.size());
  return tag + std::string(reinterpret_cast<const char*>(&size), 4) + content;
}

template <typename... Values> std::string packed(Values... values) {
  std::string bytes;
  const auto add = [&](auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  (add(values), ...);
  return bytes;
}

TEST(AssimpRepair, ReadsAnimationsWithAKeyBehindTheirLastFrame) {
  static_assert(std::endian::native == std::endian::little);
  const std::string vertices = chunk("VRTS", packed(0, 0, 0) + packed(0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f));
  const std::string mesh = chunk("MESH", packed(-1) + vertices + chunk("TRIS", packed(-1, 0, 1, 2)));
  const std::string keys =
      chunk("KEYS", packed(1) + packed(1) + packed(0.f, 0.f, 0.f) + packed(4) + packed(0.f, 3.f, 0.f));
  const std::string node =
      chunk("NODE", std::string("n\0", 2) + packed(0.f, 0.f, 0.f, 1.f, 1.f, 1.f) + packed(1.f, 0.f, 0.f, 0.f) + mesh +
                        chunk("ANIM", packed(0, 3, 24.f)) + keys);
  const std::string file = chunk("BB3D", packed(1) + node);
  const Imported imported = readByAssimp(asBytes(file), "a.b3d", {});
  EXPECT_EQ(imported.scene.meshes.at(0).elementCount(), 1u);
  const Interpolator* interpolator = firstOf<Interpolator>(imported.scene.graph);
  ASSERT_TRUE(interpolator);
  EXPECT_EQ(interpolator->values, (std::vector<float>{0, 0, 0, 0, 3, 0}));
}

} // namespace
} // namespace imgeo::testing
