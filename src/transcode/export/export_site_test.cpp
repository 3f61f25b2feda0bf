#include "base/error.h"
#include "base/file.h"
#include "base/soak_testing.h"
#include "base/testing.h"
#include "export/export.h"
#include "imgeo/imgeo.h"
#include "import/import.h"
#include "scene/shape_instances.h"
#include "scene/testing.h"
#include "transcode/export/export_site.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

/// Converts `mesh`, exports the site as `name` and expects that the exported file equals the site.
void expectExportEqualsSite(const Mesh& mesh, const ConvertOptions& options, const std::string& name) {
  const TemporaryDirectory directory;
  const auto path = [&](const std::string& file) { return directory.path() / file; };
  writeFile(path("in.ply"), exportScene(testing::sceneOf({mesh}), MeshFormat::ply));
  convert(path("in.ply"), path("site"), options);
  const ExportReport written = exportSite(path("site"), path(name));
  const VerifyReport report = verify(path("site"), path(name));
  EXPECT_TRUE(report.equal) << ::testing::PrintToString(report.findings);
  const SiteInfo info = inspect(path("site"));
  EXPECT_EQ(written.elements.points, report.site.points);
  EXPECT_EQ(report.input.triangles, report.site.triangles);
  EXPECT_LE(written.vertices, info.vertices);
}

SOAK_TEST(ExportSite, WritesEveryMeshOfEveryEncoding) {
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    ConvertOptions options;
    options.encoding = seed % 2 == 0 ? std::optional<Encoding>() : Encoding::bg;
    options.primitives = seed % 3 == 0 ? Primitives::strips : Primitives::triangles;
    options.positionBits = 8 + seed % 13;
    options.effort = 0;
    expectExportEqualsSite(testing::randomMesh(seed), options, "out.ply");
  }
}

TEST(ExportSite, JoinsPatchesAtTheirBorders) {
  ConvertOptions options;
  options.patchVertices = 256;
  options.effort = 0;
  const Mesh mesh = testing::torus(40, 40);
  expectExportEqualsSite(mesh, options, "out.obj");

  const TemporaryDirectory directory;
  writeFile(directory.path() / "in.ply", exportScene(testing::sceneOf({mesh}), MeshFormat::ply));
  convert(directory.path() / "in.ply", directory.path() / "site", options);
  ASSERT_GT(inspect(directory.path() / "site").patches, 5u);
  exportSite(directory.path() / "site", directory.path() / "out.ply");
  const Imported read = importFile(directory.path() / "out.ply");
  EXPECT_EQ(read.scene.meshes.at(0).wedgeCount(), mesh.wedgeCount());
  EXPECT_EQ(read.scene.meshes.at(0).elementCount(), mesh.elementCount());
}

TEST(ExportSite, WritesNavigationTypesIntoAGlb) {
  const TemporaryDirectory directory;
  const auto path = [&](const std::string& file) { return directory.path() / file; };
  std::string points; // too many to stay in the document
  for (int i = 0; i < 100; ++i)
    points += std::to_string(i) + " 0 0, 1000 0 0, 0 " + std::to_string(i + 1) + " 0, ";
  writeFile(path("hall.x3d"),
            asBytes("<X3D><Scene><NavigationInfo type='\"WALK\" \"ANY\"'/><Shape><TriangleSet><Coordinate "
                    "point='" +
                    points + "'/></TriangleSet></Shape></Scene></X3D>"));
  convert(path("hall.x3d"), path("hall"), {});
  exportSite(path("hall"), path("hall.glb"));
  convert(path("hall.glb"), path("again"), {});
  const Bytes page = readFile(path("again") / "index.html");
  EXPECT_NE(std::string(page.begin(), page.end()).find("<NavigationInfo type='\"WALK\" \"ANY\"'>"), std::string::npos);
  EXPECT_TRUE(verify(path("again"), path("hall.glb")).equal);
}

/// Every geometry node that stays in documents, with what makes it more than its default.
constexpr const char* geometryNodes[] = {
    "<Box size='1 2 3'/>",
    "<Sphere radius='0.5'/>",
    "<Cylinder height='3' top='false'/>",
    "<Cone bottomRadius='2'/>",
    "<Arc2D endAngle='3'/>",
    "<ArcClose2D endAngle='4'/>",
    "<Circle2D radius='2'/>",
    "<Disk2D innerRadius='0.5'/>",
    "<Rectangle2D size='1 2'/>",
    "<Polyline2D lineSegments='0 0 1 2 3 1'/>",
    "<Polypoint2D point='0 0 1 2 3 1'/>",
    "<TriangleSet2D vertices='0 0 1 0 0 1'/>",
    "<ElevationGrid xDimension='3' zDimension='2' height='0 1 0 2 0 1' creaseAngle='1'/>",
    "<Extrusion spine='0 0 0 0 1 0 1 2 0' creaseAngle='0.5'/>",
    "<IndexedFaceSet coordIndex='0 1 2 3 -1 0 1 4' solid='false'><Coordinate point='0 0 0 1 0 0 1 1 0 0 1 0 0 0 1'/>"
    "<Color color='1 0 0 0 1 0 0 0 1 1 1 0 0 1 1'/></IndexedFaceSet>",
    // Coordinates that are small beside the mesh.
    "<IndexedFaceSet coordIndex='0 1 2 -1 0 2 3'><Coordinate point='-0.295 0.007 4.252 0.413 -0.689 4.252 1.083 0 "
    "4.252 "
    "1.083 -0.013 4.252'/></IndexedFaceSet>",
    "<IndexedLineSet coordIndex='0 1 2'><Coordinate point='0 0 0 1 0 0 1 1 0'/></IndexedLineSet>",
    "<LineSet vertexCount='3'><Coordinate point='0 0 0 1 0 0 1 1 0'/></LineSet>",
    "<PointSet><Coordinate point='0 0 0 1 0 0 1 1 0'/></PointSet>",
    "<QuadSet><Coordinate point='0 0 0 1 0 0 1 1 0 0 1 0'/></QuadSet>",
    "<IndexedQuadSet index='0 1 2 3'><Coordinate point='0 0 0 1 0 0 1 1 0 0 1 0'/></IndexedQuadSet>",
    "<TriangleSet><Coordinate point='0 0 0 1 0 0 0 1 0'/></TriangleSet>",
    "<TriangleStripSet stripCount='4'><Coordinate point='0 0 0 1 0 0 0 1 0 1 1 1'/></TriangleStripSet>",
    "<TriangleFanSet fanCount='4'><Coordinate point='0 0 0 1 0 0 1 1 0 0 1 1'/></TriangleFanSet>",
    "<IndexedTriangleSet index='0 1 2'><Coordinate point='0 0 0 1 0 0 0 1 0'/></IndexedTriangleSet>",
    "<IndexedTriangleStripSet index='0 1 2 3'><Coordinate point='0 0 0 1 0 0 0 1 0 1 1 1'/></IndexedTriangleStripSet>",
    "<IndexedTriangleFanSet index='0 1 2 3'><Coordinate point='0 0 0 1 0 0 1 1 0 0 1 1'/></IndexedTriangleFanSet>",
};

/// The corners of all elements, in the world, sorted element by element.
std::vector<std::vector<std::array<float, 3>>> elementsInWorld(const Scene& scene) {
  std::vector<std::vector<std::array<float, 3>>> elements;
  for (const ShapeInstance& instance : shapeInstances(scene.graph)) {
    const Mesh& mesh = scene.meshes.at(shapeOf(scene.graph, instance.node).mesh);
    const std::size_t count = cornersPerElement(mesh.topology);
    for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
      if (i % count == 0)
        elements.emplace_back();
      const Vec3f corner(instance.worldFromShape.point(Vec3d(mesh.cornerPosition(i))));
      const auto rounded = [](float value) { return std::round(value * 1e4f) / 1e4f + 0.0f; };
      elements.back().push_back({rounded(corner.x), rounded(corner.y), rounded(corner.z)});
    }
  }
  for (auto& element : elements)
    std::ranges::sort(element);
  std::ranges::sort(elements);
  return elements;
}

/// A folder in which X3D scenes become sites.
struct DocumentSite {
  TemporaryDirectory directory;
  std::filesystem::path path(const std::string& file) const { return directory.path() / file; }
  std::filesystem::path of(const std::string& nodes) const {
    writeFile(path("in.x3d"), asBytes("<X3D version='4.0'><Scene>" + nodes + "</Scene></X3D>"));
    ConvertOptions options;
    options.force = true;
    convert(path("in.x3d"), path("site"), options);
    return path("site");
  }
};

TEST(ExportSite, WritesEveryGeometryNodeOfTheDocument) {
  const DocumentSite site;
  for (const std::string node : geometryNodes) {
    SCOPED_TRACE(node);
    site.of("<Transform translation='1 2 3' scale='1 2 1'><Shape>" + node + "</Shape></Transform>");
    ASSERT_TRUE(inspect(site.path("site")).geometries.empty());
    ImportOptions all;
    all.solids = true;
    const Imported expected = importFile(site.path("in.x3d"), all);
    for (const std::string name : {"out.glb", "out.ply", "out.obj"}) {
      SCOPED_TRACE(name);
      const ExportReport report = exportSite(site.path("site"), site.path(name));
      EXPECT_TRUE(report.geometryLeftOut.empty());
      EXPECT_EQ(report.shapes, 1u);
      EXPECT_EQ(elementsInWorld(importFile(site.path(name)).scene), elementsInWorld(expected.scene));
    }
    const VerifyReport report = verify(site.path("site"), site.path("out.glb"));
    EXPECT_TRUE(report.equal) << ::testing::PrintToString(report.findings);
  }
}

TEST(ExportSite, WritesNodesWithTheirMaterialsAndInstances) {
  const DocumentSite site;
  std::string nodes;
  for (const std::string node : geometryNodes)
    nodes += "<Transform translation='0 0 " + std::to_string(nodes.size()) + "'><Shape><Appearance><Material " +
             "diffuseColor='1 0.5 0' shininess='0.4' transparency='0.25'/></Appearance>" + node +
             "</Shape></Transform>";
  site.of(nodes + "<Shape DEF='Ball'><Appearance><Material emissiveColor='0 0 0.5'/></Appearance><Sphere DEF='Round'/>"
                  "</Shape><Transform translation='5 0 0'><Shape USE='Ball'/></Transform>"
                  "<Transform translation='0 5 0'><Shape><Sphere USE='Round'/></Shape></Transform>");
  const ExportReport written = exportSite(site.path("site"), site.path("out.glb"));
  EXPECT_EQ(written.shapes, std::size(geometryNodes) + 3);
  const VerifyReport report = verify(site.path("site"), site.path("out.glb"));
  EXPECT_TRUE(report.equal) << ::testing::PrintToString(report.findings);
  EXPECT_EQ(report.comparedMaterials, std::size(geometryNodes) + 3);

  site.of(nodes + "<Shape><Sphere radius='0.9'/></Shape>");
  EXPECT_FALSE(verify(site.path("site"), site.path("out.glb")).equal);
}

TEST(ExportSite, WritesNodesBesideMeshesOfFilesAndOfInlinedDocuments) {
  const DocumentSite site;
  std::string points; // too many to stay in the document
  for (int i = 0; i < 100; ++i)
    points += std::to_string(i) + " 0 0, 1000 0 0, 0 " + std::to_string(i + 1) + " 0, ";
  writeFile(site.path("part.x3d"), asBytes("<X3D><Scene><Shape><Box/></Shape></Scene></X3D>"));
  site.of("<Shape><Cone/></Shape><Shape><TriangleSet><Coordinate point='" + points +
          "'/></TriangleSet></Shape><Inline url='part.x3d'/>");
  const ExportReport report = exportSite(site.path("site"), site.path("out.glb"));
  EXPECT_EQ(report.shapes, 3u);
  EXPECT_EQ(report.elements.triangles, 96u + 100u + 12u);
  const VerifyReport verified = verify(site.path("site"), site.path("out.glb"));
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
}

TEST(ExportSite, NamesWhatItCannotWriteAsTheDocumentHasIt) {
  const DocumentSite site;
  site.of("<Shape><Box/></Shape><Shape><Text string='\"a\"'/></Shape><Switch whichChoice='0'><Shape><Cone/></Shape>"
          "<Shape><Sphere/></Shape></Switch>");
  const ExportReport report = exportSite(site.path("site"), site.path("out.glb"));
  EXPECT_EQ(report.shapes, 3u);
  EXPECT_EQ(report.geometryLeftOut, (std::map<std::string, std::size_t>{{"Text", 1}}));
  EXPECT_EQ(report.choicesWritten, (std::map<std::string, std::size_t>{{"Switch", 1}}));
  EXPECT_EQ(verify(site.path("site"), site.path("out.glb")).findings,
            std::vector<std::string>{"The site has 1 Text node, of which the input can have no mesh."});

  const std::filesystem::path texts = site.of("<Shape><Text string='\"a\"'/></Shape>");
  try {
    exportSite(texts, site.path("none.ply"));
    ADD_FAILURE() << "was written";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              (texts / "index.html").string() + ": has no geometry of which a mesh can be made, only Text (1)");
  }
  EXPECT_FALSE(std::filesystem::exists(site.path("none.ply")));
}

TEST(ExportSite, LeavesOutNodesThatCannotBeReadAndSaysWhy) {
  const DocumentSite site;
  writeFile(site.path("scene.x3d"), asBytes("<X3D><Scene><Shape><Box/></Shape>\n<Shape><Sphere radius='-1'/></Shape>"
                                            "</Scene></X3D>"));
  const ExportReport report = exportSite(site.path("scene.x3d"), site.path("out.glb"));
  EXPECT_EQ(report.shapes, 1u);
  EXPECT_EQ(report.geometryLeftOut, (std::map<std::string, std::size_t>{{"Sphere", 1}}));
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_NE(report.warnings[0].find("Sphere: radius '-1' is not a size; its Shape is left out."), std::string::npos)
      << report.warnings[0];
}

TEST(ExportSite, CountsRoutesInAnyCaseAndInAnyNode) {
  const DocumentSite site;
  writeFile(
      site.path("page.html"),
      asBytes("<!doctype html><x3d><scene><timesensor def='clock'></timesensor><transform def='t'><shape><appearance>"
              "<material def='m'></material><route fromnode='c' fromfield='value_changed' tonode='m' "
              "tofield='diffuseColor'></route></appearance><box></box><Route fromnode='clock' "
              "fromfield='fraction_changed' tonode='c' tofield='set_fraction'></Route></shape></transform>"
              "<positioninterpolator def='p' key='0 1' keyvalue='0 0 0 1 0 0'></positioninterpolator>"
              "<colorinterpolator def='c' key='0 1' keyvalue='1 0 0 0 1 0'></colorinterpolator>"
              "<route fromnode='clock' fromfield='fraction_changed' tonode='p' tofield='set_fraction'></route>"
              "<ROUTE fromnode='p' fromfield='value_changed' tonode='t' tofield='translation'></ROUTE>"
              "</scene></x3d>"));
  EXPECT_EQ(inspect(site.path("page.html")).routes, 4u);
  const ExportReport report = exportSite(site.path("page.html"), site.path("out.glb"));
  EXPECT_EQ(report.shapes, 1u);
  EXPECT_EQ(report.routesLeftOut, 2u);
  EXPECT_TRUE(report.geometryLeftOut.empty()) << report.geometryLeftOut.begin()->first;
  EXPECT_EQ(countNodes<TimeSensor>(importFile(site.path("out.glb")).scene.graph), 1u);
}

TEST(ExportSite, RefusesAFormatThatItCannotWrite) {
  try {
    exportSite("site", "out.fbx");
    ADD_FAILURE() << "was written";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
  }
}

} // namespace
} // namespace imgeo
