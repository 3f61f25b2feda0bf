#include "base/error.h"
#include "base/file.h"
#include "base/testing.h"
#include "import/assimp/testing.h"
#include "import/import.h"
#include "scene/testing.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace imgeo::testing {
namespace {

TEST(Assimp, LeavesMissingTexturesOut) {
  const TemporaryDirectory directory;
  writeFile(directory / "a.dae", asBytes(collada));
  const Imported imported = importFile(directory / "a.dae");
  EXPECT_TRUE(appearanceOf(imported.scene.graph, 0).textures.empty());
  ASSERT_EQ(imported.warnings.size(), 1u);
  EXPECT_NE(imported.warnings[0].find("wood.png"), std::string::npos);
  ImportOptions strict;
  strict.strict = true;
  EXPECT_THROW(importFile(directory / "a.dae", strict), Error);
}

TEST(Assimp, MultipliesEmissionByTheTextureInAc3dFiles) {
  const TemporaryDirectory directory;
  writeFile(directory / "wood.png", asBytes("\x89PNG\r\n\x1a\n..."));
  const auto rolesOf = [&](const std::string& emissive, const std::string& texture) {
    writeFile(directory / "a.ac", asBytes("AC3Db\nMATERIAL \"m\" rgb 1 1 1 amb 0 0 0 emis " + emissive +
                                          " spec 0 0 0 shi 10 trans 0\nOBJECT world\nkids 1\nOBJECT poly\n" + texture +
                                          "numvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0x0\nmat 0\nrefs 3\n"
                                          "0 0 0\n1 1 0\n2 0 1\nkids 0\n"));
    std::vector<TextureRole> roles;
    const Imported imported = importFile(directory / "a.ac");
    for (const TextureUse& use : appearanceOf(imported.scene.graph, 0).textures)
      roles.push_back(use.role);
    return roles;
  };
  using enum TextureRole;
  EXPECT_EQ(rolesOf("0.3 0.3 0.3", "texture \"wood.png\"\n"), (std::vector{color, emissive}));
  EXPECT_EQ(rolesOf("0 0 0", "texture \"wood.png\"\n"), (std::vector{color}));
  EXPECT_EQ(rolesOf("0.3 0.3 0.3", ""), (std::vector<TextureRole>{}));
}

TEST(Assimp, MergesEqualMaterials) {
  const auto glass = [](const std::string& color) {
    return "MATERIAL \"glass\" rgb " + color + " amb 0 0 0 emis 0 0 0 spec 0.5 0.5 0.5 shi 10 trans 0\n";
  };
  std::string panes = "AC3Db\n" + glass("0 0 1") + glass("0 0 1") + glass("1 0 0") +
                      "OBJECT world\nkids 1\nOBJECT poly\nname \"panes\"\nnumvert 3\n"
                      "0 0 0\n1 0 0\n0 1 0\nnumsurf 3\n";
  for (const std::string material : {"0", "1", "2"})
    panes += "SURF 0x0\nmat " + material + "\nrefs 3\n0 0 0\n1 0 0\n2 0 0\n";
  const SceneGraph graph = importBytes(asBytes(panes + "kids 0\n"), "panes.ac").scene.graph;
  EXPECT_EQ(shapeNodes(graph).size(), 3u);
  EXPECT_EQ(graph.appearances.size(), 2u);
}

TEST(Assimp, ReadsTheTransparencyOfColladaInTheWayOfItsWriter) {
  const auto read = [](const std::string& transparency, const std::string& opaque) {
    std::string text = collada;
    const std::string before = "</phong>";
    text.insert(text.find(before), "<transparent opaque=\"" + opaque +
                                       "\"><color>1 1 1 1</color></transparent><transparency><float>" + transparency +
                                       "</float></transparency>");
    return importBytes(asBytes(text), "a.dae");
  };
  const auto transparencyOf = [](const Imported& imported) {
    return std::get<Material>(appearanceOf(imported.scene.graph, 0).material).transparency;
  };
  const auto isWarned = [](const Imported& imported) {
    return std::ranges::any_of(imported.warnings,
                               [](const std::string& w) { return w.find("COLLADA's rule") != w.npos; });
  };
  EXPECT_EQ(transparencyOf(read("1", "A_ONE")), 0);
  EXPECT_EQ(transparencyOf(read("0.75", "A_ONE")), 0.25f);
  EXPECT_EQ(transparencyOf(read("0.75", "RGB_ZERO")), 0.75f);
  EXPECT_FALSE(isWarned(read("0.75", "A_ONE")));
  // By the rule the whole model would be invisible.
  EXPECT_EQ(transparencyOf(read("0", "A_ONE")), 0);
  EXPECT_TRUE(isWarned(read("0", "A_ONE")));
}

} // namespace
} // namespace imgeo::testing
