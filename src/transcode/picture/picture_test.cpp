#include "scene/testing.h"
#include "transcode/picture/draw_picture.h"
#include "transcode/picture/generic_fields.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

/// A unit sphere of one colour around the origin; `parent` holds its shape.
Scene sphereScene(NodeContent parent = Group{}, Vec3f color = {1, 0, 0}) {
  Scene scene;
  scene.meshes.push_back(testing::sphere(40, 40));
  Appearance appearance;
  appearance.material = Material{.diffuseColor = color};
  scene.graph.appearances.push_back(appearance);
  const std::size_t shape =
      addNode(scene.graph, {.name = "", .content = Shape{.appearance = 0}, .children = {}, .extras = ""});
  addRoot(scene.graph, {.name = "", .content = std::move(parent), .children = {shape}, .extras = ""});
  return scene;
}

GenericNode genericNode(const char* element) {
  GenericNode node;
  node.element = element;
  return node;
}

/// Adds a viewpoint on the z axis that looks at the origin.
void addViewpoint(Scene& scene, double z) {
  Viewpoint viewpoint;
  viewpoint.position = {0, 0, z};
  addRoot(scene.graph, {.name = "", .content = viewpoint, .children = {}, .extras = ""});
}

std::array<int, 3> pixelOf(const Image& image, std::size_t x, std::size_t y) {
  const std::size_t at = image.channels * (y * image.width + x);
  return {image.pixels[at], image.pixels[at + 1], image.pixels[at + 2]};
}

TEST(Picture, ShowsTheSceneFromItsViewpointInFrontOfItsBackground) {
  Scene scene = sphereScene();
  const PictureSamples samples = pictureSamplesOf(scene);
  addViewpoint(scene, 6);
  const Image image = drawPicture(samples.samples, pictureCameraOf(scene.graph, samples.samples), {0, 0, 1}).value();
  ASSERT_EQ(image.width, 1200u);
  ASSERT_EQ(image.height, 630u);
  const auto [red, green, blue] = pixelOf(image, 600, 315);
  EXPECT_GT(red, 120);
  EXPECT_EQ(green, 0);
  EXPECT_EQ(blue, 0);
  EXPECT_EQ(pixelOf(image, 5, 5), (std::array{0, 0, 255}));
  // The silhouette of a unit sphere at distance 6 has the radius of tan(asin(1/6)) in units of the focal length.
  std::size_t covered = 0;
  for (std::size_t x = 0; x < image.width; ++x)
    covered += pixelOf(image, x, 315)[2] < 128;
  const double focal = 315 / std::tan(0.7854 / 2), radius = focal * std::tan(std::asin(1.0 / 6));
  EXPECT_NEAR(static_cast<double>(covered), 2 * radius, 4);
  // No holes: every pixel well inside is red.
  for (std::size_t x = 560; x < 640; ++x)
    for (std::size_t y = 275; y < 355; ++y)
      ASSERT_EQ(pixelOf(image, x, y)[2], 0) << x << " " << y;
}

TEST(Picture, IsNotDrawnFromInsideWhereSamplesWouldBeVisible) {
  Scene scene = sphereScene();
  const PictureSamples samples = pictureSamplesOf(scene, 2000);
  addViewpoint(scene, 1.2);
  EXPECT_FALSE(drawPicture(samples.samples, pictureCameraOf(scene.graph, samples.samples), {0, 0, 1}));
}

/// Cubes around the origin, one in the other.
Mesh cubes(std::initializer_list<float> edges) {
  Mesh mesh;
  for (const float edge : edges) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto coordinate = [&](bool isPositive) { return isPositive ? edge / 2 : -edge / 2; };
    for (std::uint32_t i = 0; i < 8; ++i)
      mesh.positions.push_back({coordinate((i & 1) != 0), coordinate((i & 2) != 0), coordinate((i & 4) != 0)});
    constexpr std::array<std::array<std::uint32_t, 4>, 6> faces{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (const auto& [a, b, c, d] : faces) {
      testing::addTriangle(mesh, first + a, first + b, first + c);
      testing::addTriangle(mesh, first + a, first + c, first + d);
    }
  }
  testing::addPlainWedges(mesh);
  return mesh;
}

TEST(Picture, IsDrawnOfACubeAndOfWhatHasAnInside) {
  for (const Mesh& mesh : {cubes({1}), cubes({1, 0.5f})}) {
    Scene scene = sphereScene();
    scene.meshes[0] = mesh;
    const std::vector<PictureSample> samples = pictureSamplesOf(scene).samples;
    EXPECT_TRUE(drawPicture(samples, pictureCameraOf({}, samples), {1, 1, 1})) << samples.size() << " samples";
    const std::vector<PictureSample> fewer = pictureSamplesOf(scene, minPictureSamples).samples;
    EXPECT_FALSE(drawPicture(fewer, pictureCameraOf({}, fewer), {1, 1, 1})) << "more samples are for nothing";
  }
}

TEST(Picture, LeavesOutWhatAPageHides) {
  EXPECT_FALSE(pictureSamplesOf(sphereScene()).samples.empty());
  const PictureSamples hidden = pictureSamplesOf(sphereScene(genericNode("Switch")));
  EXPECT_TRUE(hidden.samples.empty()) << "a Switch without whichChoice shows nothing";
  EXPECT_TRUE(hidden.isWhole);
  EXPECT_FALSE(pictureSamplesOf(sphereScene(genericNode("LOD"))).samples.empty());
}

TEST(Picture, CountsNeitherCommentsNorMetadataAsLevelsOrChoices) {
  Scene scene = sphereScene(genericNode("LOD"));
  Node& levels = scene.graph.nodes[scene.graph.roots[0]];
  const std::size_t shape = levels.children[0];
  for (const char* element : {commentElement, "MetadataString"})
    scene.graph.nodes.push_back({.name = "", .content = genericNode(element), .children = {}, .extras = ""});
  const std::size_t metadata = scene.graph.nodes.size() - 1, comment = metadata - 1;
  scene.graph.nodes[scene.graph.roots[0]].children = {comment, metadata, shape};
  EXPECT_FALSE(pictureSamplesOf(scene).samples.empty());
}

TEST(Picture, IsTakenFromTheViewpointAndInFrontOfTheSkyOfAnX3dSource) {
  SceneGraph graph;
  Node viewpoint{.name = "", .content = genericNode("Viewpoint"), .children = {}, .extras = ""};
  viewpoint.fields = {{"position", "1 2,3"}, {"fieldOfView", "0.5"}, {"orientation", "0 1 0 1.5"}};
  addRoot(graph, viewpoint);
  const PictureCamera camera = pictureCameraOf(graph, {});
  EXPECT_EQ(camera.worldFromCamera.translation, (Vec3d{1, 2, 3}));
  EXPECT_DOUBLE_EQ(camera.fieldOfView, 0.5);
  EXPECT_NEAR(camera.worldFromCamera.z.x, std::sin(1.5), 1e-12);
  EXPECT_EQ(skyColorOf(graph), std::nullopt);
  Node background{.name = "", .content = genericNode("Background"), .children = {}, .extras = ""};
  background.fields = {{"skyColor", "0.5 0.25 1, 1 1 1"}, {"skyAngle", "1.5"}};
  addRoot(graph, background);
  EXPECT_EQ(skyColorOf(graph), (Vec3f{0.5f, 0.25f, 1}));
}

TEST(Picture, OfAnOrthoViewpointShowsItsRectangle) {
  SceneGraph graph;
  Node viewpoint{.name = "", .content = genericNode("OrthoViewpoint"), .children = {}, .extras = ""};
  viewpoint.fields = {{"position", "0 0 20"}, {"fieldOfView", "-4 -2 4 2"}};
  addRoot(graph, viewpoint);
  EXPECT_NEAR(pictureCameraOf(graph, {}).fieldOfView, 2 * std::atan(2.0 / 20), 1e-12);
}

TEST(Picture, IsNotDrawnWhereShapesOfTheDocumentWouldBeMissing) {
  Scene scene = sphereScene();
  addRoot(scene.graph, {.name = "", .content = genericNode("Shape"), .children = {}, .extras = ""});
  EXPECT_FALSE(pictureSamplesOf(scene).isWhole);
}

TEST(Picture, OfOneSceneIsTheSameEveryTime) {
  const auto draw = [] {
    const std::vector<PictureSample> samples = pictureSamplesOf(sphereScene()).samples;
    return drawPicture(samples, pictureCameraOf({}, samples), {1, 1, 1}).value();
  };
  EXPECT_EQ(draw(), draw());
}

TEST(Picture, AsAnIconFillsItsSquareAndIsTransparentAroundTheScene) {
  const std::vector<PictureSample> samples = pictureSamplesOf(sphereScene()).samples;
  const Image icon = drawIcon(samples, pictureCameraOf({}, samples)).value();
  ASSERT_EQ(icon.pixels.size(), 64u * 64 * 4);
  const auto alphaAt = [&](std::size_t x, std::size_t y) { return icon.pixels[4 * (64 * y + x) + 3]; };
  EXPECT_EQ(alphaAt(0, 0), 0);
  EXPECT_EQ(alphaAt(63, 63), 0);
  EXPECT_GT(alphaAt(32, 1), 100);
  EXPECT_GT(alphaAt(1, 32), 100);
  EXPECT_EQ(alphaAt(32, 32), 255);
  EXPECT_EQ(drawCubeIcon().width, 64u);
}

TEST(Picture, OfAShapeWithoutAppearanceHasTheMaterialAndTheLightsOfAPage) {
  Scene scene = sphereScene();
  for (Node& node : scene.graph.nodes)
    if (Shape* shape = std::get_if<Shape>(&node.content))
      shape->appearance.reset();
  addViewpoint(scene, 6);
  const PictureSamples samples = pictureSamplesOf(scene);
  const Image image = drawPicture(samples.samples, pictureCameraOf(scene.graph, samples.samples), {0, 0, 1}).value();
  // In the middle the surface faces the viewer and the headlight; the key light adds 0.4 times its cosine of 0.4, and
  // ambient light has the colour of the fill light.
  const std::array expected{0.52 * (1 + 0.16 * 1.00 + 0.2 * 0.90), 0.51 * (1 + 0.16 * 0.96 + 0.2 * 0.95),
                            0.485 * (1 + 0.16 * 0.90 + 0.2 * 1.00)};
  const std::array<int, 3> pixel = pixelOf(image, 600, 315);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(pixel[i], 255 * expected[i], 3) << i;
}

TEST(Picture, OfPointsAndLinesHasTheirColours) {
  Scene scene = sphereScene();
  Mesh& mesh = scene.meshes[0];
  for (const Topology topology : {Topology::points, Topology::lines}) {
    mesh.topology = topology;
    mesh.corners.resize(mesh.corners.size() / 2 * 2);
    const std::vector<PictureSample> samples = pictureSamplesOf(scene).samples;
    ASSERT_FALSE(samples.empty());
    EXPECT_EQ(samples[0].color, (std::array<std::uint8_t, 3>{255, 0, 0}));
    EXPECT_LE(samples.size(), 200'000u);
  }
}

} // namespace
} // namespace imgeo
