#include "base/file.h"
#include "base/testing.h"
#include "import/assimp/assimp.h"
#include "import/assimp/testing.h"
#include "import/import.h"
#include "scene/testing.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace imgeo::testing {
namespace {

TEST(Assimp, ReadsTheSetsOfTextureCoordinatesThatTexturesUse) {
  const std::string two =
      replaced(collada, {{"<emission><color>0 0 0.5 1</color></emission>",
                          "<emission><texture texture=\"t\" texcoord=\"UV1\"/></emission>"},
                         {"<vertices id=\"v\">",
                          "<source id=\"w\"><float_array id=\"wa\" count=\"8\">0 0 .5 0 .5 .5 0 .5</float_array>"
                          "<technique_common><accessor source=\"#wa\" count=\"4\" stride=\"2\"><param name=\"S\" "
                          "type=\"float\"/><param name=\"T\" type=\"float\"/></accessor></technique_common></source>"
                          "<vertices id=\"v\">"},
                         {"<vcount>", "<input semantic=\"TEXCOORD\" source=\"#w\" offset=\"0\" set=\"1\"/><vcount>"},
                         {"input_set=\"0\"/>",
                          "input_set=\"0\"/><bind_vertex_input semantic=\"UV1\" input_semantic=\"TEXCOORD\" "
                          "input_set=\"1\"/>"}});
  const TemporaryDirectory directory;
  writeFile(directory / "a.dae", asBytes(two));
  writeFile(directory / "wood.png", asBytes("\x89PNG\r\n\x1a\n..."));
  const Imported imported = importFile(directory / "a.dae");
  const Mesh& mesh = imported.scene.meshes.at(0);
  EXPECT_EQ(mesh.texCoordMappings, (std::vector<std::string>{"", "TEXCOORD_1"}));
  EXPECT_TRUE(std::ranges::any_of(mesh.texCoords, [](Vec2f t) { return t.x == 1; }));
  EXPECT_EQ(mesh.texCoords1.size(), mesh.texCoords.size());
  EXPECT_TRUE(std::ranges::all_of(mesh.texCoords1, [](Vec2f t) { return t.x <= .5f && t.y <= .5f; }));
  std::map<TextureRole, std::string> mappings;
  for (const TextureUse& use : imported.scene.graph.appearances.at(0).textures)
    mappings[use.role] = use.mapping;
  EXPECT_EQ(mappings,
            (std::map<TextureRole, std::string>{{TextureRole::color, ""}, {TextureRole::emissive, "TEXCOORD_1"}}));
  EXPECT_EQ(imported.warnings, (std::vector<std::string>{}));

  writeFile(directory / "b.dae",
            asBytes(replaced(two, {{"<emission><texture texture=\"t\" texcoord=\"UV1\"/></emission>", ""}})));
  const Imported unused = importFile(directory / "b.dae");
  EXPECT_TRUE(unused.scene.meshes.at(0).texCoordMappings.empty());
  EXPECT_EQ(unused.warnings, (std::vector<std::string>{
                                 "1 mesh has texture coordinates that no texture uses, which are not carried over."}));
  ImportOptions all;
  all.attributes.all = true;
  EXPECT_EQ(importFile(directory / "b.dae", all).scene.meshes.at(0).texCoordMappings.size(), 2u);
}

TEST(Assimp, GivesMeshesOfAmfNoColoursButTheirOwn) {
  const std::string amf = "<?xml version=\"1.0\"?><amf unit=\"millimeter\"><object id=\"0\"><mesh><vertices>"
                          "<vertex><coordinates><x>0</x><y>0</y><z>0</z></coordinates></vertex>"
                          "<vertex><coordinates><x>1</x><y>0</y><z>0</z></coordinates></vertex>"
                          "<vertex><coordinates><x>0</x><y>1</y><z>0</z></coordinates></vertex></vertices>"
                          "<volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle></volume></mesh></object></amf>";
  EXPECT_TRUE(readByAssimp(asBytes(amf), "a.amf", {}).scene.meshes.at(0).colors.empty());
  const std::string red = replaced(amf, {{"<mesh>", "<color><r>1</r><g>0</g><b>0</b></color><mesh>"}});
  EXPECT_EQ(readByAssimp(asBytes(red), "a.amf", {}).scene.meshes.at(0).colors.size(), 3u);
}

TEST(Assimp, StatesACreaseAngleUnlessThereIsAnother) {
  const std::string cube = "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
                           "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 2 3 7 6\n4 1 2 6 5\n4 0 4 7 3\n";
  EXPECT_EQ(readByAssimp(asBytes(cube), "cube.off", {}).scene.meshes.at(0).creaseDegrees, manMadeCreaseDegrees);
}

} // namespace
} // namespace imgeo::testing
