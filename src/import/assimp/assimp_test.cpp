#include "base/file.h"
#include "base/testing.h"
#include "import/assimp/assimp.h"
#include "import/assimp/testing.h"
#include "import/testing.h"
#include "scene/shape_instances.h"
#include "scene/testing.h"

#include <cmath>
#include <gtest/gtest.h>

namespace imgeo::testing {
namespace {

TEST(Assimp, DrawsNoBonesForAScenesNodesWithoutMeshes) {
  // Assimp reads no morph controllers: what the node instantiates is lost.
  const std::string text = replaced(
      collada,
      {{"<library_visual_scenes>",
        R"(<library_controllers><controller id="m"><morph source="#square">
    <source id="t"><IDREF_array id="ta" count="1">square</IDREF_array><technique_common><accessor source="#ta" count="1"
      stride="1"><param name="IDREF" type="IDREF"/></accessor></technique_common></source>
    <source id="k"><float_array id="ka" count="1">0</float_array><technique_common><accessor source="#ka" count="1"
      stride="1"><param name="MORPH_WEIGHT" type="float"/></accessor></technique_common></source>
    <targets><input semantic="MORPH_TARGET" source="#t"/><input semantic="MORPH_WEIGHT" source="#k"/></targets></morph>
    </controller></library_controllers><library_visual_scenes>)"},
       {"<instance_geometry url=\"#square\"><bind_material>", "<instance_controller url=\"#m\"><bind_material>"},
       {"</instance_geometry>", "</instance_controller>"},
       {"<instance_geometry url=\"#square\"><bind_material>", "<instance_controller url=\"#m\"><bind_material>"},
       {"</instance_geometry>", "</instance_controller>"}});
  const Error error = errorOf(text, "a.dae");
  EXPECT_EQ(error.kind(), ErrorKind::malformed);
  EXPECT_EQ(error.message(), "the file has no triangles, lines or points");
}

TEST(Assimp, SaysThatAMotionWithoutAMeshDrawsNothing) {
  const Error error = errorOf(R"(HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 3 Zrotation Xrotation Yrotation
  End Site
  {
    OFFSET 0 1 0
  }
}
MOTION
Frames: 1
Frame Time: 0.04
0 0 0
)",
                              "a.bvh");
  EXPECT_EQ(error.message(), "the file has no triangles, lines or points");
}

TEST(Assimp, ReadsNodesMaterialsTexturesCamerasAndLights) {
  const TemporaryDirectory directory;
  writeFile(directory / "a.dae", asBytes(collada));
  writeFile(directory / "wood.png", asBytes("\x89PNG\r\n\x1a\n..."));
  const Imported imported = importFile(directory / "a.dae");
  EXPECT_EQ(imported.format, "DAE");
  const Scene& scene = imported.scene;
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].elementCount(), 2u);
  EXPECT_EQ(scene.meshes[0].texCoords.size(), 4u);
  const std::vector<ShapeInstance> instances = shapeInstances(scene.graph);
  ASSERT_EQ(instances.size(), 2u);
  EXPECT_EQ(instances[0].worldFromShape.point({}), (Vec3d{-2, 0, 0}));
  EXPECT_EQ(instances[1].worldFromShape.point({}), (Vec3d{2, 0, 0}));
  const Appearance& oak = appearanceOf(scene.graph, 0);
  EXPECT_EQ(oak.name, "oak");
  EXPECT_EQ(std::get<Material>(oak.material).emissiveColor, (Vec3f{0, 0, 0.5f}));
  ASSERT_EQ(oak.textures.size(), 1u);
  EXPECT_EQ(scene.graph.images.at(0).url, "wood.png");
  ASSERT_TRUE(firstOf<Viewpoint>(scene.graph));
  EXPECT_NEAR(firstOf<Viewpoint>(scene.graph)->fieldOfView, 2 * std::atan(std::tan(3.14159265 / 6) / 1.5), 1e-3);
  ASSERT_TRUE(firstOf<PointLight>(scene.graph));
  EXPECT_EQ(firstOf<PointLight>(scene.graph)->color, (Vec3f{1, 0.5f, 0}));
}

TEST(Assimp, SaysWhatItsLibraryHasRepaired) {
  const std::string off = "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n3 0 1 2\n";
  const Imported imported = readByAssimp(asBytes(off), "a.off", {});
  ASSERT_EQ(imported.warnings.size(), 1u);
  EXPECT_EQ(imported.warnings[0], "Assimp, which reads the format, reports: OFF: Vertex index is out of range.");
  ImportOptions strict;
  strict.strict = true;
  EXPECT_THROW(readByAssimp(asBytes(off), "a.off", strict), Error);
}

TEST(Assimp, RefusesUnreadableFiles) {
  const Error error = errorOf(collada.substr(0, 900), "a.dae");
  EXPECT_EQ(error.kind(), ErrorKind::malformed);
  EXPECT_EQ(error.location(), "a.dae");
  EXPECT_EQ(errorOf("nothing", "a.fbx").kind(), ErrorKind::malformed);
  EXPECT_EQ(error.message().substr(0, 63), "is damaged or no DAE file; Assimp, which reads the format, says");
}

TEST(Assimp, SaysWhatElseMayBeDoneWithCadAndBlender) {
  const Error step =
      errorOf("ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');"
              "\nFILE_SCHEMA(('CONFIG_CONTROL_DESIGN'));\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n",
              "a.step");
  EXPECT_NE(step.message().find("export triangles, as glTF, OBJ or STL"), std::string::npos) << step.message();
  const Error blend = errorOf("BLENDER-v279", "a.blend");
  EXPECT_NE(blend.message().find("Blender exports glTF"), std::string::npos) << blend.message();
}

} // namespace
} // namespace imgeo::testing
