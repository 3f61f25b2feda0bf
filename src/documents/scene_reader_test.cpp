// Reads texts of documents: those of other programs, with defaults, and damaged ones.

#include "documents/testing.h"
#include "scene/shape_instances.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::errorKindOf;

TEST(ReadScene, IgnoresTextThatResemblesTheX3dElement) {
  const SceneDocument document = readScene("<!DOCTYPE html><!-- <X3D> --><script>'<X3D>'</script><title><x3d></title>"
                                           "<p title='<X3D>'></p><X3D><Scene><WorldInfo title='here'/></Scene></X3D>",
                                           "x");
  EXPECT_EQ(document.graph.title, "here");
}

TEST(ReadScene, RefusesDocumentTypesAndEntities) {
  EXPECT_EQ(errorKindOf("<!DOCTYPE X3D [<!ENTITY a 'aaaaaaaa'>]><X3D><Scene/></X3D>", "s.x3d:1"),
            ErrorKind::unsupported);
  EXPECT_EQ(errorKindOf("<!DOCTYPE X3D SYSTEM 'file:///etc/passwd'><X3D><Scene/></X3D>"), ErrorKind::unsupported);
  EXPECT_EQ(errorKindOf("<X3D>\n<Scene><WorldInfo title='&a;'/></Scene></X3D>", "s.x3d:2"), ErrorKind::malformed);
  EXPECT_EQ(errorKindOf("<X3D><!ENTITY a 'b'><Scene/></X3D>"), ErrorKind::malformed);
}

TEST(ReadScene, ReportsTheLineOfAFieldThatCannotBeReadAndOfOneThatCountsAsAbsent) {
  const std::string before = "<X3D><Scene>\n<Shape>\n";
  const auto shape = [&](const std::string& fields) {
    const std::string count = fields.starts_with("vertexCount") ? "" : " vertexCount='3'";
    return before + "<ImageGeometry><GeometryPatch coord='a' " + fields + count +
           "></GeometryPatch></ImageGeometry></Shape></Scene></X3D>";
  };
  for (const std::string fields : {"vertexCount='-1'", "recordCount='-1'", "index='a#b'", "index='#5'", "index='a#1+4'",
                                   "index='a#1#4'", "implicitMeshSize='0 1'", "implicitMeshSize='1e9 1'"})
    EXPECT_EQ(errorKindOf(shape(fields), "s.x3d:3"), ErrorKind::malformed) << fields;
  for (const auto& [fields, sentence] : std::initializer_list<std::pair<std::string, std::string>>{
           {"recordCount='1 2'", "recordCount=\"1 2\" is no SFInt32"},
           {"bboxSize='1 nan 1'", "bboxSize=\"1 nan 1\" is no SFVec3f"},
           {"bboxSize='1 1e39 1'", "bboxSize=\"1 1e39 1\" is no SFVec3f"},
           {"bboxSize='1 1'", "bboxSize=\"1 1\" is no SFVec3f"}})
    EXPECT_EQ(readScene(shape(fields), "s.x3d").warnings,
              std::vector{"s.x3d:3: GeometryPatch: " + sentence + "; it counts as absent."});
}

TEST(ReadScene, ReadsTheMovieOfAGeometry) {
  const SceneDocument document = readScene(
      "<X3D><Scene><Shape><ImageGeometry coord='a' vertexCount='3'><MovieTexture DEF='m' containerField='coord' "
      R"(url='"g/v.webm" "g/i.json?v=2"' loop='true'/></ImageGeometry></Shape></Scene></X3D>)",
      "s.x3d");
  EXPECT_EQ(document.warnings, std::vector<std::string>{});
  ASSERT_EQ(document.graph.nodes.size(), 2u);
  const auto& frames = std::get<Interpolator>(document.graph.nodes[0].content);
  EXPECT_EQ(frames.video, "g/v.webm");
  EXPECT_EQ(frames.url, "g/i.json?v=2");
  EXPECT_EQ(document.geometries.at(0).patches.at(0).coord.size(), 1u);
}

TEST(ReadScene, WarnsOfMalformedFieldsAndReadsTheRest) {
  const SceneDocument document =
      readScene("<X3D><Scene>\n<Shape/><Viewpoint position='1 2' fieldOfView='1'/>\n"
                "<Shape><Appearance USE='a'/><ImageGeometry coord='c' vertexCount='3'/></Shape>"
                "</Scene></X3D>",
                "folder/s.x3d");
  EXPECT_EQ(document.warnings,
            (std::vector<std::string>{
                "s.x3d:2: Viewpoint: position=\"1 2\" is no SFVec3f; it counts as absent.",
                "s.x3d:3: Appearance: USE names no Appearance that stands before; it has its defaults."}));
  const Viewpoint& viewpoint = std::get<Viewpoint>(document.graph.nodes.at(0).content);
  EXPECT_EQ(viewpoint.position, Viewpoint{}.position);
  EXPECT_EQ(viewpoint.fieldOfView, 1);
  EXPECT_EQ(shapeNodes(document.graph).size(), 1u);
}

TEST(ReadScene, RefusesExcessiveDepth) {
  std::string text = "<X3D><Scene>";
  for (int i = 0; i < 100000; ++i)
    text += "<Group>";
  for (int i = 0; i < 100000; ++i)
    text += "</Group>";
  EXPECT_EQ(errorKindOf(text + "</Scene></X3D>"), ErrorKind::limit);

  std::string chain = "<X3D><Scene><Group DEF='g0'></Group>";
  for (int i = 1; i < 100000; ++i)
    chain += "<Group DEF='g" + std::to_string(i) + "'><Group USE='g" + std::to_string(i - 1) + "'/></Group>";
  EXPECT_EQ(errorKindOf(chain + "</Scene></X3D>"), ErrorKind::limit);
}

TEST(ReadScene, RefusesAUseWithoutADefBefore) {
  for (const std::string use : {"<Shape USE='a'/>", "<Group DEF='a'><Group USE='a'/></Group>",
                                "<Transform USE='a'/><Transform DEF='a'/>", "<Shape><ImageGeometry USE='a'/></Shape>"})
    EXPECT_EQ(errorKindOf("<X3D><Scene>" + use + "</Scene></X3D>"), ErrorKind::malformed) << use;
}

} // namespace
} // namespace imgeo
