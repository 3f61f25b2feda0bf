// Textured geometry of X3D without texture coordinates has the default ones: in containers, and in exports of nodes.

#include "base/file.h"
#include "base/testing.h"
#include "imgeo/imgeo.h"
#include "import/import.h"
#include "scene/shape_instances.h"
#include "transcode/export/export_site.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

// 1 x 1 pixel.
const std::string onePixel("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\x8\2\0\0\0\x90wS\xde\0\0\0\fIDATx\x9c"
                           "c\xf8\xff\xff?\0\5\xfe\2\xfe\r\xef"
                           "F\xb8\0\0\0\0IEND\xae"
                           "B`\x82",
                           69);

const std::string texturedAppearance = "<Appearance><Material/><ImageTexture url='\"a.png\"'/></Appearance>",
                  plainAppearance = "<Appearance><Material/></Appearance>";

struct TexturedSite {
  TemporaryDirectory directory;
  std::filesystem::path path(const std::string& name) const { return directory.path() / name; }

  /// The scene of the exported site.
  Scene exportOf(const std::string& nodes, const std::string& name = "out.glb") const {
    writeFile(path("a.png"), asBytes(onePixel));
    writeFile(path("in.x3d"), asBytes("<X3D version='4.0'><Scene>" + nodes + "</Scene></X3D>"));
    ConvertOptions options;
    options.force = true;
    options.pictures = false;
    options.effort = 0;
    convert(path("in.x3d"), path("site"), options);
    EXPECT_EQ(verify(path("site"), path("in.x3d")).findings, std::vector<std::string>{});
    exportSite(path("site"), path(name));
    EXPECT_EQ(verify(path("site"), path(name)).findings, std::vector<std::string>{});
    return importFile(path(name)).scene;
  }
};

/// A plate with its longer edge along z; `copies` of the same face lengthen its text.
std::string plate(std::size_t copies) {
  std::string index;
  for (std::size_t i = 0; i < copies; ++i)
    index += "0 1 2 3 -1 ";
  return "<IndexedFaceSet solid='false' coordIndex='" + index +
         "'><Coordinate point='1 5 0, 1 5 4, 3 5 4, 3 5 0'/></IndexedFaceSet>";
}

TEST(DefaultTextureCoordinates, OfNodesAreExportedWithTheTexture) {
  const TexturedSite site;
  for (const std::string node :
       {"<Box/>", "<Sphere/>", "<Cylinder/>", "<Cone/>", "<Rectangle2D/>", "<TriangleSet2D vertices='0 0 1 0 0 1'/>",
        "<ElevationGrid xDimension='2' zDimension='2' height='0 1 0 2'/>", "<Extrusion/>",
        "<TriangleSet><Coordinate point='0 0 0 1 0 0 0 1 0'/></TriangleSet>"}) {
    SCOPED_TRACE(node);
    const Scene scene = site.exportOf("<Shape>" + texturedAppearance + node + "</Shape>");
    EXPECT_TRUE(inspect(site.path("site")).geometries.empty());
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].texCoords.size(), scene.meshes[0].wedgeCount());
    ASSERT_EQ(scene.graph.appearances.size(), 1u);
    EXPECT_EQ(scene.graph.appearances[0].textures.size(), 1u);
    EXPECT_EQ(scene.graph.images.size(), 1u);
  }
}

TEST(DefaultTextureCoordinates, RunAlongTheLongestEdgesOfTheBox) {
  const TexturedSite site;
  for (const std::size_t copies : {std::size_t{1}, std::size_t{300}}) { // in the document, and in a file
    const Scene scene = site.exportOf("<Shape>" + texturedAppearance + plate(copies) + "</Shape>");
    EXPECT_EQ(inspect(site.path("site")).geometries.size(), copies > 1 ? 1u : 0u);
    ASSERT_EQ(scene.meshes.size(), 1u);
    const Mesh& mesh = scene.meshes[0];
    ASSERT_EQ(mesh.texCoords.size(), mesh.wedgeCount());
    for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
      const Vec3f& position = mesh.positions[mesh.wedgePositions[wedge]];
      EXPECT_NEAR(mesh.texCoords[wedge].x, position.z / 4, 3e-4);
      EXPECT_NEAR(mesh.texCoords[wedge].y, (position.x - 1) / 4, 3e-4);
    }
  }
}

TEST(DefaultTextureCoordinates, AreThoseOfTexturedShapesAlone) {
  const TexturedSite site;
  EXPECT_TRUE(site.exportOf("<Shape>" + plainAppearance + plate(1) + "</Shape>").meshes.at(0).texCoords.empty());
  // Where one of several Shapes has a texture, they are there; appearances and materials may be USEd.
  std::string named = plate(1);
  named.insert(named.find(' '), " DEF='plate'");
  const Scene scene = site.exportOf(
      "<Shape><Appearance DEF='picture'><PhysicalMaterial><ImageTexture url='\"a.png\"' "
      "containerField='baseTexture'/></PhysicalMaterial></Appearance><Box/></Shape><Shape>" +
      plainAppearance + named + "</Shape><Shape><Appearance USE='picture'/><IndexedFaceSet USE='plate'/></Shape>");
  ASSERT_EQ(shapeInstances(scene.graph).size(), 3u);
  for (const Mesh& mesh : scene.meshes)
    EXPECT_FALSE(mesh.texCoords.empty());
}

TEST(DefaultTextureCoordinates, DifferFromOthersForVerify) {
  const TexturedSite site;
  site.exportOf("<Shape>" + texturedAppearance + plate(1) + "</Shape>", "default.glb");
  std::string stated = plate(1);
  stated.insert(stated.rfind('<'), "<TextureCoordinate point='0 0, 0.5 0, 0.5 0.5, 0 0.5'/>");
  site.exportOf("<Shape>" + texturedAppearance + stated + "</Shape>", "stated.glb");
  EXPECT_FALSE(verify(site.path("site"), site.path("default.glb")).equal);
  site.exportOf("<Shape>" + plainAppearance + plate(1) + "</Shape>", "without.glb");
  EXPECT_FALSE(verify(site.path("site"), site.path("default.glb")).equal);
}

} // namespace
} // namespace imgeo
