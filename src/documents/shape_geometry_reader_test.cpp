// Reads the geometries of Shapes that are joined, and leaves out those in no file.

#include "documents/testing.h"
#include "scene/shape_instances.h"
#include "scene/testing.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::shapeName;

TEST(ShapeGeometryReader, JoinsAGroupOfShapesThatShareTheirAppearance) {
  const auto shape = [](const std::string& appearance, const std::string& coord) {
    return "<Shape bboxSize='1 1 1'><Appearance " + appearance +
           "><Material diffuseColor='1 0 0'/></Appearance>"
           "<BinaryGeometry size='2 2 2' coordType='Uint16' coord='" +
           coord + "'/></Shape>";
  };
  const auto scene = [](const std::string& shapes) {
    return readScene("<X3D><Scene><Group DEF='statue' bboxSize='3 3 3'>" + shapes + "</Group></Scene></X3D>", "x");
  };
  const SceneDocument joined = scene(shape("DEF='A'", "a") + shape("USE='A'", "b"));
  ASSERT_EQ(shapeNodes(joined.graph).size(), 1u);
  EXPECT_EQ(shapeName(joined.graph, 0), "statue");
  EXPECT_EQ(testing::appearanceOf(joined.graph, 0).material, AnyMaterial(Material{.diffuseColor{1, 0, 0}}));
  ASSERT_EQ(joined.geometries.at(0).patches.size(), 2u);
  EXPECT_EQ(joined.geometries[0].patches[1].coord[0].url, "b");
  EXPECT_EQ(joined.geometries[0].patches[1].box.size(), (Vec3d{1, 1, 1}));
  EXPECT_EQ(joined.geometries[0].box.size(), (Vec3d{3, 3, 3}));

  EXPECT_EQ(shapeNodes(scene(shape("DEF='A'", "a") + shape("DEF='B'", "b")).graph).size(), 2u);
  EXPECT_EQ(shapeNodes(scene(shape("", "a") + shape("", "b")).graph).size(), 2u);
  const std::string otherBox =
      "<Shape><Appearance USE='A'/><BinaryGeometry size='3 3 3' coordType='Uint16' coord='b'/></Shape>";
  EXPECT_EQ(shapeNodes(scene(shape("DEF='A'", "a") + otherBox).graph).size(), 2u);
}

TEST(ShapeGeometryReader, LeavesOutGeometryThatIsInNoFile) {
  const std::string movie = "a movie with coordinates names a lossless video and the index of its frames",
                    videos = "movies are not drawn; images and live streams are",
                    stream = "a live stream is in no file";
  const std::pair<std::string, std::string> cases[] = {
      {"><MovieTexture containerField='coord' url='a.mp4'/>", movie},
      {"><Texture containerField='coord'><video src='a.mp4'/></Texture>", videos},
      {"><GeometryPatch><video containerField='coord' src='a.mp4'/></GeometryPatch>", videos},
      {"><Texture containerField='coord'><canvas/></Texture>", "a canvas has pixels only in a page"},
      {"><PixelTexture containerField='coord'/>", "the pixels of a PixelTexture are not read as geometry; images are"},
      {" coord='live/cloth'>", stream},
      {" coord='https://a.example/live/cloth-1?token=a/b'>", stream},
      {"><MovieTexture containerField='coord' url='live/cloth'/>", stream},
      {"><ImageTexture containerField='coord' url='live/cloth'/>", stream},
  };
  for (const auto& [geometry, reason] : cases) {
    SCOPED_TRACE(geometry);
    const SceneDocument document =
        readScene("<X3D><Scene>\n<Shape><ImageGeometry DEF='g'" + geometry +
                      "</ImageGeometry></Shape><Shape><ImageGeometry USE='g'/></Shape>"
                      "<Shape><ImageGeometry coord='alive/c' vertexCount='3'/></Shape></Scene></X3D>",
                  "folder/s.x3d");
    EXPECT_EQ(document.geometries.size(), 1u);
    EXPECT_EQ(document.warnings,
              std::vector<std::string>{"s.x3d:2: ImageGeometry: " + reason + "; its Shape is left out."});
  }
}

} // namespace
} // namespace imgeo
