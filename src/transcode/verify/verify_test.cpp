// Damages sites and expects that verify finds the damage. Most damaged files are named by their new content and the
// documents refer to them, so that a check of names alone would find nothing.

#include "base/error.h"
#include "base/soak_testing.h"
#include "containers/png/png.h"
#include "documents/documents.h"
#include "scene/testing.h"
#include "transcode/sample/sample_file.h"
#include "transcode/site/site_files.h"
#include "transcode/site/testing.h"

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

/// A site of a mesh (by default a sphere) in several patches, which tests damage.
class DamagedSite {
public:
  explicit DamagedSite(Encoding encoding = Encoding::classic, const Mesh& mesh = testing::sphere(30, 30),
                       NormalEncoding normals = NormalEncoding::rgb) {
    testing::writeMesh(directory_ / "input.ply", mesh);
    ConvertOptions options;
    options.encoding = encoding;
    options.normals = normals;
    options.patchVertices = 300;
    convert(directory_ / "input.ply", site(), options);
    opened_ = openDocument(site());
  }

  std::filesystem::path site() const { return directory_ / "site"; }
  SceneDocument& scene() { return opened_.scene; }
  GeometryDescription& geometry() { return opened_.scene.geometries.at(0); }

  /// Writes the page and scene.x3d again.
  void write() {
    const std::vector<std::string> urls = pageFilesOf(opened_.text);
    const bool moduleFirst = urls.at(0).ends_with(".js");
    writeFile(site() / pageName,
              asBytes(writeHtml(opened_.scene, {urls.at(moduleFirst ? 0 : 1), urls.at(moduleFirst ? 1 : 0)})));
    writeFile(site() / sceneName, asBytes(writeX3d(opened_.scene)));
  }

  /// Changes a file, names it by its new content and updates the documents.
  void change(Reference& reference, const std::function<void(Bytes&)>& damage) {
    Bytes bytes = readFile(site() / reference.url);
    damage(bytes);
    reference.url = "geometry/" + contentName(bytes) + std::filesystem::path(reference.url).extension().string();
    writeFile(site() / reference.url, bytes);
    write();
  }

  void changeImage(Reference& reference, const std::function<void(Image&)>& damage) {
    change(reference, [&](Bytes& bytes) {
      Image image = decodePng(bytes, reference.url);
      damage(image);
      bytes = encodePng(image, 1);
    });
  }

  /// Makes room for damaged coordinates, which the readers would refuse.
  void widenBoxes() {
    const Lattice& lattice = geometry().lattice;
    for (PatchDescription& patch : geometry().patches)
      patch.box = {lattice.origin, lattice.point({lattice.maximum(), lattice.maximum(), lattice.maximum()})};
    geometry().box = geometry().patches[0].box;
  }

  VerifyReport verified() const { return verify(site(), directory_ / "input.ply"); }

private:
  TemporaryDirectory directory_;
  SiteDocument opened_;
};

/// Expects that the site does not equal its input and that a finding contains `words`.
void expectFinding(const DamagedSite& site, const std::string& words) {
  const VerifyReport report = site.verified();
  EXPECT_FALSE(report.equal);
  const bool isReported =
      std::ranges::any_of(report.findings, [&](const std::string& f) { return f.find(words) != f.npos; });
  EXPECT_TRUE(isReported) << words
                          << "; said instead: " << (report.findings.empty() ? "nothing" : report.findings.front());
}

TEST(Verify, FindsNoDifferenceInAnUndamagedSite) {
  DamagedSite site;
  ASSERT_GT(site.geometry().patches.size(), 2u);
  EXPECT_TRUE(site.verified().equal);
  site.write(); // tests write damaged scenes in this way
  EXPECT_TRUE(site.verified().equal);
}

TEST(Verify, SeesABytePlaneFlipped) {
  for (const std::size_t plane : {0u, 1u}) {
    DamagedSite site;
    site.widenBoxes();
    site.changeImage(site.geometry().patches[1].coord[plane], [](Image& image) {
      for (std::uint8_t& byte : image.pixels)
        byte = static_cast<std::uint8_t>(255 - byte);
    });
    expectFinding(site, "triangles of the input are missing");
  }
}

TEST(Verify, SeesOneLowBitOfOneVertex) {
  DamagedSite site;
  site.widenBoxes();
  site.changeImage(site.geometry().patches[0].coord[1], [](Image& image) { image.pixels[0] ^= 1; });
  expectFinding(site, "triangles of the input are missing");
}

TEST(Verify, SeesOneIndexOff) {
  DamagedSite site;
  site.changeImage(*site.geometry().patches[0].index, [](Image& image) { image.pixels[0] ^= 2; });
  expectFinding(site, "missing from the site");
}

TEST(Verify, SeesALineThatIsDrawnInsteadOfAnother) {
  DamagedSite site(Encoding::bg, testing::polylines(60, 1));
  EXPECT_TRUE(site.verified().equal);
  // Two indices of two bytes a line.
  site.change(*site.geometry().patches[0].index, [](Bytes& indices) { std::copy_n(&indices[8], 4, &indices[0]); });
  expectFinding(site, "1 lines of the input are missing");
  expectFinding(site, "1 lines of the site are not in the input");
}

TEST(Verify, SeesBytePlanesSwapped) {
  DamagedSite site;
  site.widenBoxes();
  std::swap(site.geometry().patches[0].coord[0], site.geometry().patches[0].coord[1]);
  site.write();
  expectFinding(site, "missing");
}

TEST(Verify, SeesTwoFilesSwapped) {
  DamagedSite site;
  const auto path = [&](std::size_t patch) { return site.site() / site.geometry().patches[patch].coord[0].url; };
  std::filesystem::rename(path(0), site.site() / "aside");
  std::filesystem::rename(path(1), path(0));
  std::filesystem::rename(site.site() / "aside", path(1));
  expectFinding(site, "does not hold what its name says");
}

TEST(Verify, SeesAPatchTakenAwayOrPutInTwice) {
  DamagedSite site;
  const PatchDescription last = site.geometry().patches.back();
  site.geometry().patches.pop_back();
  site.write();
  expectFinding(site, "missing from the site");
  site.geometry().patches.push_back(last);
  site.geometry().patches.push_back(last);
  site.write();
  expectFinding(site, "not in the input");
}

TEST(Verify, SeesAChangedLattice) {
  DamagedSite moved, stretched;
  moved.geometry().lattice.origin.x += 2 * moved.geometry().lattice.step;
  moved.widenBoxes();
  moved.write();
  expectFinding(moved, "Positions are off");
  stretched.geometry().lattice.step *= 1.001;
  stretched.widenBoxes();
  stretched.write();
  expectFinding(stretched, "Positions are off");
}

TEST(Verify, SeesABoxThatDoesNotFitItsPatch) {
  DamagedSite site;
  site.geometry().patches[0].box.max.x += 0.1;
  site.write();
  expectFinding(site, "1 of");
}

TEST(Verify, SeesNormalsTurned) {
  for (const Encoding encoding : {Encoding::classic, Encoding::bg}) {
    DamagedSite site(encoding);
    Reference& normal = *site.geometry().patches[0].vertexAttributes[VertexRole::normal];
    if (encoding == Encoding::classic)
      site.changeImage(normal, [](Image& image) { image.pixels[0] = static_cast<std::uint8_t>(image.pixels[0] ^ 4); });
    else
      site.change(normal, [](Bytes& bytes) { bytes[0] = static_cast<std::uint8_t>(bytes[0] ^ 4); });
    expectFinding(site, "Normals are off");
  }
}

SOAK_TEST(Verify, SeesNormalsTurnedInEveryEncoding) {
  for (const NormalEncoding normals : {NormalEncoding::octahedral, NormalEncoding::spherical}) {
    DamagedSite images(Encoding::classic, testing::sphere(30, 30), normals),
        arrays(Encoding::bg, testing::sphere(30, 30), normals);
    images.changeImage(*images.geometry().patches[0].vertexAttributes[VertexRole::normal],
                       [](Image& image) { image.pixels[0] = static_cast<std::uint8_t>(image.pixels[0] ^ 16); });
    expectFinding(images, "Normals are off");
    // The file that the normals share with the coordinates.
    PatchDescription& patch = arrays.geometry().patches[0];
    arrays.change(patch.coord[0], [](Bytes& bytes) { bytes[6] = static_cast<std::uint8_t>(bytes[6] ^ 16); });
    patch.vertexAttributes[VertexRole::normal]->url = patch.coord[0].url;
    arrays.write();
    expectFinding(arrays, "Normals are off");
  }
  DamagedSite palette(Encoding::classic, testing::sphere(30, 30), NormalEncoding::palette);
  EXPECT_TRUE(palette.verified().equal);
  palette.changeImage(*palette.geometry().patches[0].vertexAttributes[VertexRole::normal], [](Image& image) {
    for (std::size_t i = 0; i < 3; ++i)
      image.pixels[i] = static_cast<std::uint8_t>(255 - image.pixels[i]);
  });
  expectFinding(palette, "Normals are off");
}

TEST(Verify, SeesNormalsLeftOut) {
  DamagedSite site;
  for (PatchDescription& patch : site.geometry().patches)
    patch.vertexAttributes[VertexRole::normal].reset();
  site.write();
  expectFinding(site, "normals that the site lacks");
}

TEST(Verify, SeesOtherColoursAndTextureCoordinates) {
  Mesh mesh = testing::torus(20, 20);
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge)
    mesh.colors.push_back(Rgba8{static_cast<std::uint8_t>(wedge), 7, 9, 255});
  DamagedSite colored(Encoding::classic, mesh), mapped(Encoding::classic, mesh);
  EXPECT_TRUE(colored.verified().equal);
  colored.changeImage(*colored.geometry().patches[0].vertexAttributes[VertexRole::color],
                      [](Image& image) { image.pixels[0] ^= 1; });
  expectFinding(colored, "other colours");
  mapped.changeImage(*mapped.geometry().patches[0].vertexAttributes[VertexRole::texCoord],
                     [](Image& image) { image.pixels[2] ^= 4; });
  expectFinding(mapped, "Texture coordinates are off");
}

TEST(Verify, SeesTrianglesDrawnAsPoints) {
  DamagedSite site;
  for (PatchDescription& patch : site.geometry().patches)
    for (Draw& draw : patch.draws)
      draw.primitive = Primitive::points;
  site.write();
  EXPECT_FALSE(site.verified().equal);
}

TEST(Verify, SeesDocumentsThatDiffer) {
  DamagedSite site;
  std::get<Material>(site.scene().graph.appearances.at(0).material).shininess = 0.9f;
  writeFile(site.site() / sceneName, asBytes(writeX3d(site.scene())));
  expectFinding(site, "index.html and scene.x3d differ");
}

TEST(Verify, SeesFilesThatAreGoneOrCutShort) {
  DamagedSite gone, cut;
  std::filesystem::remove(gone.site() / *pageFilesOf(asText(readFile(gone.site() / pageName))).begin());
  expectFinding(gone, "is not there");
  cut.change(*cut.geometry().patches[0].index, [](Bytes& bytes) { bytes.resize(bytes.size() / 2); });
  EXPECT_FALSE(cut.verified().equal);
}

TEST(Verify, SeesAnotherRuntime) {
  DamagedSite site;
  const auto name = testing::namesIn(site.site() / runtimeFolder).front();
  writeFile(site.site() / runtimeFolder / name, asBytes("alert(1)"));
  expectFinding(site, "does not hold what its name says");
}

TEST(Verify, SeesThatTheModuleOfOtherPagesIsGoneOrLeadsNowhere) {
  DamagedSite gone, old;
  std::filesystem::remove(gone.site() / runtimeFolder / runtimeModuleName);
  expectFinding(gone, "runtime/imgeo.js is named by the document but is not there");
  writeFile(old.site() / runtimeFolder / runtimeModuleName, asBytes("import \"./imgeo-0123456789abcdef.js\";\n"));
  expectFinding(old, "runtime/imgeo-0123456789abcdef.js is named by the document but is not there");
}

TEST(Verify, SeesPicturesThatAreGoneOrOfAnotherSite) {
  DamagedSite site;
  std::filesystem::copy_file(site.site() / iconName, site.site() / pictureName,
                             std::filesystem::copy_options::overwrite_existing);
  expectFinding(site, "picture.png is not");
  std::filesystem::remove(site.site() / pictureName);
  std::filesystem::remove(site.site() / iconName);
  expectFinding(site, "icon.png is named by imgeo.json but is not there");
  writeFile(site.site() / iconName, asBytes("another picture"));
  expectFinding(site, "icon.png is not the picture that convert wrote");
}

TEST(Verify, SeesPicturesInASiteThatHasNone) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "input.ply", testing::sphere(6, 6));
  ConvertOptions options;
  options.pictures = false;
  convert(directory / "input.ply", directory / "site", options);
  EXPECT_FALSE(std::filesystem::exists(directory / "site" / iconName));
  EXPECT_TRUE(verify(directory / "site", directory / "input.ply").equal);
  writeFile(directory / "site" / iconName, asBytes("of another program"));
  EXPECT_EQ(verify(directory / "site", directory / "input.ply").findings,
            (std::vector<std::string>{"icon.png is not of this site: imgeo.json does not name it."}));
}

TEST(Verify, ReadsNoFileOutsideTheSite) {
  DamagedSite site;
  site.geometry().patches[0].index->url = "../input.ply";
  site.write();
  expectFinding(site, "is not a file of the site");
}

TEST(Verify, SeesAnotherMaterialAndAnotherTextureTransform) {
  const TemporaryDirectory directory;
  const std::filesystem::path input = directory / "hall.glb", site = directory / "site";
  writeSampleHall(40, input);
  convert(input, site, {});
  const VerifyReport whole = verify(site, input);
  EXPECT_TRUE(whole.equal);
  EXPECT_GT(whole.comparedMaterials, 40u);

  SiteDocument opened = openDocument(site);
  const auto verified = [&](const SceneDocument& scene) {
    const std::vector<std::string> urls = pageFilesOf(opened.text);
    writeFile(site / pageName, asBytes(writeHtml(scene, {urls.at(0), urls.at(1)})));
    writeFile(site / sceneName, asBytes(writeX3d(scene)));
    return verify(site, input).findings;
  };
  const auto isTextured = [](const Appearance& appearance) { return !appearance.textures.empty(); };
  SceneDocument red = opened.scene, moved = opened.scene;
  const auto plain = std::ranges::find_if_not(red.graph.appearances, isTextured);
  std::get<PhysicalMaterial>(plain->material).baseColor = {1, 0, 0};
  const auto sign = std::ranges::find_if(moved.graph.appearances, isTextured);
  sign->textures[0].transform.translation = {0.5f, 0};
  const std::string sentence = "have other materials than in the input, or other texture transforms.";
  for (const SceneDocument& changed : {red, moved}) {
    const std::vector<std::string> findings = verified(changed);
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_NE(findings[0].find(sentence), std::string::npos) << findings[0];
  }
}

TEST(Verify, ComparesTheMaterialsOfLinesAsTheyAreWritten) {
  const testing::TemporaryDirectory directory;
  writeFile(directory / "a.mtl", asBytes("newmtl red\nKd 1 0 0\n"));
  writeFile(directory / "a.obj", asBytes("mtllib a.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\nf 1 2 3\n"));
  convert(directory / "a.obj", directory / "site", {});
  const VerifyReport report = verify(directory / "site", directory / "a.obj");
  EXPECT_TRUE(report.equal) << ::testing::PrintToString(report.findings);
  EXPECT_EQ(report.comparedMaterials, 2u);
}

} // namespace
} // namespace imgeo
