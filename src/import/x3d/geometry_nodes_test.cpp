#include "import/x3d/geometry_nodes.h"

#include "base/error.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

/// The mesh of the element that begins with `start` in a text.
std::optional<NodeMesh> meshAt(const std::string& text, const std::string& start, const std::string& name) {
  const std::size_t at = text.find(start);
  // pugixml states where the name of an element stands, pages where its tag does.
  for (const std::size_t offset : {at, at + 1})
    if (std::optional<NodeMesh> mesh = GeometryNodes(text, name, {}).read(offset))
      return mesh;
  return {};
}

TEST(GeometryNodes, AreReadWhereTheyStandInDocumentsAndPages) {
  const std::string x3d = "<X3D><Scene><Shape><Text/></Shape><Shape><Box size='1 2 3' solid='false'/></Shape>"
                          "<Shape><Cone USE='none'/></Shape></Scene></X3D>";
  const std::optional<NodeMesh> box = meshAt(x3d, "<Box", "a.x3d");
  ASSERT_TRUE(box);
  EXPECT_EQ(box->mesh.elementCount(), 12u);
  EXPECT_EQ(boxOf(box->mesh).max, (Vec3d{0.5, 1, 1.5}));
  EXPECT_FALSE(box->solid);
  EXPECT_FALSE(meshAt(x3d, "<Text", "a.x3d"));

  const std::string page = "<!doctype html><body><x3d><scene><shape><indexedfaceset coordindex='0 1 2'><coordinate "
                           "point='0 0 0 1 0 0 0 1 0'></coordinate></indexedfaceset></shape></scene></x3d>";
  const std::optional<NodeMesh> face = meshAt(page, "<indexedfaceset", "index.html");
  ASSERT_TRUE(face);
  EXPECT_EQ(face->mesh.elementCount(), 1u);
  EXPECT_TRUE(face->solid);
}

TEST(GeometryNodes, AreMappedByTheirOperators) {
  const std::string x3d =
      "<X3D><Scene><Shape><TriangleSet operators='scale(0.5)'><Coordinate point='0 0 0 2 0 0 0 2 0'/>"
      "</TriangleSet></Shape></Scene></X3D>";
  EXPECT_NEAR(boxOf(meshAt(x3d, "<TriangleSet", "a.x3d")->mesh).longestEdge(), 1, 1e-6);
}

TEST(GeometryNodes, ThatAreMalformedAreErrorsAtTheirLine) {
  try {
    meshAt("<X3D><Scene>\n<Shape><Sphere radius='-1'/></Shape></Scene></X3D>", "<Sphere", "a.x3d");
    ADD_FAILURE() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::malformed);
    EXPECT_TRUE(error.location().starts_with("a.x3d:2:")) << error.location();
  }
}

} // namespace
} // namespace imgeo
