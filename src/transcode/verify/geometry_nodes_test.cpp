// Verifies sites of X3D documents whose geometry stays in the documents, after changes of single fields.

#include "base/file.h"
#include "base/testing.h"
#include "transcode/site/testing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

constexpr std::string_view nodesSource = R"(<X3D profile="Immersive" version="4.0"><Scene>
  <Transform DEF="Row"><Shape><Box size="1 2 3"/></Shape><Shape><Box DEF="Cube"/></Shape></Transform>
  <Shape><Box USE="Cube"/></Shape>
  <Shape><Sphere radius="0.1" solid="TRUE"/></Shape>
  <Shape><Text string='"1.0" "two"' length="0 0"><FontStyle family='"SANS"' style="BOLD" size="2"/></Text></Shape>
  <Shape><IndexedFaceSet coordIndex="0 1 2 -1"><Coordinate DEF="Points" point="0 0 0, 1 0 0, 0 1 0.25"/>
    <MetadataString name="note" value='"a"'/></IndexedFaceSet></Shape>
  <Shape><IndexedFaceSet coordIndex="2 1 0 -1"><Coordinate USE="Points"/></IndexedFaceSet></Shape>
  <Shape><Extrusion spine="0 0 0, 0 1 0, 0 2 0, 0 3 0, 0 4 0, 0 5 0"/></Shape>
  <Inline url='"chair.x3d"'/><Inline url='"chair.x3d"'/>
</Scene></X3D>)";

class GeometryNodes : public ::testing::Test {
protected:
  GeometryNodes() {
    writeFile(directory / "hall.x3d", asBytes(nodesSource));
    writeFile(directory / "chair.x3d", asBytes("<X3D><Scene><Shape><Cone height='3'/></Shape></Scene></X3D>"));
    convert(directory / "hall.x3d", directory / "site", {});
  }

  /// Replaces the only occurrence of a text in a file of the site.
  void replace(const std::string& file, std::string_view from, std::string_view to) const {
    std::string text(asText(readFile(directory / "site" / file)));
    const std::size_t at = text.find(from);
    ASSERT_NE(at, text.npos) << from << "\n" << text;
    ASSERT_EQ(text.find(from, at + 1), text.npos) << from << "\n" << text;
    writeFile(directory / "site" / file, asBytes(text.replace(at, from.size(), to)));
  }

  void replaceInBoth(std::string_view from, std::string_view to) const {
    replace("index.html", from, to);
    replace("scene.x3d", from, to);
  }

  std::string findings() const {
    const VerifyReport report = verify(directory / "site", directory / "hall.x3d");
    EXPECT_EQ(report.equal, report.findings.empty());
    return fmt::format("{}", fmt::join(report.findings, "\n"));
  }

  testing::TemporaryDirectory directory;
};

TEST_F(GeometryNodes, OfAConvertedSceneEqualThoseOfItsSource) {
  EXPECT_EQ(findings(), "");
}

TEST_F(GeometryNodes, AreNamedByFileLineAndPathWhereAFieldDiffers) {
  replace("scene.x3d", "size=\"1 2 3\"", "size=\"3 2 1\"");
  const std::string found = findings();
  EXPECT_NE(found.find("scene.x3d:"), found.npos) << found;
  EXPECT_NE(found.find(R"(:5: Scene/Transform "Row"/Shape[1]/Box has size "3 2 1", in the input "1 2 3".)"), found.npos)
      << found;
  EXPECT_EQ(found.find("index.html"), found.npos) << found;
}

struct Change {
  const char *from, *to, *finding;
};

TEST_F(GeometryNodes, MayBeWrittenInOtherWays) {
  for (const Change& change : {
           Change{"size=\"1 2 3\"", "size=\"1.0,2e0 3\" solid=\"TRUE\" class=\"red\"", ""},
           {"<Box DEF=\"Cube\"", "<Box DEF=\"Cube\" size=\"2 2 2\"", ""},
           {"radius=\"0.1\" solid=\"TRUE\"", "radius=\"0.10000000149\"", ""},
           {"family='\"SANS\"'", "family=\"SANS\"", ""},
           {"length=\"0 0\"", "length=\"0.0 0\"", ""},
           {"0 1 0.25", "0 1.0 .25", ""},
       }) {
    replaceInBoth(change.from, change.to);
    EXPECT_EQ(findings(), "") << change.to;
  }
}

TEST_F(GeometryNodes, AreComparedFieldByField) {
  for (const Change& change : {
           Change{"radius=\"0.1\"", "radius=\"0.1001\"", "Sphere has radius \"0.1001\", in the input \"0.1\"."},
           {" radius=\"0.1\"", "", "Sphere has radius \"1\", in the input \"0.1\"."},
           {"solid=\"TRUE\"", "solid=\"false\"", "Sphere has solid \"false\", in the input \"TRUE\"."},
           {"<Box DEF=\"Cube\"", "<Box DEF=\"Cube\" size=\"2 2 3\"", "Box \"Cube\" has size \"2 2 3\", in the input"},
           {"\"1.0\" \"two\"", "\"1.00\" \"two\"", R"(Text has string '"1.00" "two"', in the input '"1.0" "two"'.)"},
           {"size=\"2\"", "size=\"2.5\"", "Text has a FontStyle that has size \"2.5\", in the input \"2\"."},
           {"coordIndex=\"2 1 0 -1\"", "coordIndex=\"1 2 0 -1\"",
            "has coordIndex \"1 2 0 -1\", in the input \"2 1 0 -1\"."},
           {"0 1 0.25", "0 1 0.2501", "has a Coordinate that has point "},
           {"0 4 0", "0 4 1", "Extrusion has 1 as number 15 of spine, in the input 0."},
           {", 0 5 0", "", "Extrusion has 15 numbers of spine, in the input 18."},
           {"<Coordinate USE=\"Points\"></Coordinate>", "<Normal></Normal>",
            "has a Normal where the input has a Coordinate."},
           {"<Coordinate USE=\"Points\"", "<Coordinate USE=\"Pints\"", "is the DEF of none."},
       }) {
    testing::TemporaryDirectory kept;
    std::filesystem::copy(directory / "site", kept / "site", std::filesystem::copy_options::recursive);
    replaceInBoth(change.from, change.to);
    const std::string found = findings();
    EXPECT_NE(found.find(change.finding), found.npos) << change.to << "\n" << found;
    EXPECT_NE(found.find("index.html:"), found.npos) << found;
    EXPECT_NE(found.find("scene.x3d:"), found.npos) << found;
    std::filesystem::remove_all(directory / "site");
    std::filesystem::copy(kept / "site", directory / "site", std::filesystem::copy_options::recursive);
  }
}

TEST_F(GeometryNodes, OfInlinedDocumentsAreCompared) {
  for (const auto& entry : std::filesystem::directory_iterator(directory / "site"))
    if (entry.path().extension() == ".x3d" && entry.path().filename() != "scene.x3d")
      replace(entry.path().filename().string(), "height=\"3\"", "height=\"4\"");
  const std::string found = findings();
  EXPECT_NE(found.find("Cone has height \"4\", in the input \"3\"."), found.npos) << found;
  EXPECT_EQ(found.find("Cone", found.find("Cone") + 1), found.npos) << "found twice\n" << found;
}

TEST_F(GeometryNodes, OfWhichManyDifferAreCounted) {
  std::string text = "<X3D><Scene>", changed = text;
  for (int i = 0; i < 50; ++i) {
    text += fmt::format("<Shape><Sphere radius='{}'/></Shape>", i + 1);
    changed += fmt::format("<Shape><Sphere radius='{}'/></Shape>", i + 2);
  }
  writeFile(directory / "many.x3d", asBytes(text + "</Scene></X3D>"));
  writeFile(directory / "changed.x3d", asBytes(changed + "</Scene></X3D>"));
  convert(directory / "many.x3d", directory / "many", {});
  EXPECT_TRUE(verify(directory / "many", directory / "many.x3d").equal);
  const VerifyReport report = verify(directory / "many", directory / "changed.x3d");
  ASSERT_EQ(report.findings.size(), 21u);
  EXPECT_EQ(report.findings.back(), "80 more geometry nodes of documents differ."); // of 50 in each of two documents
}

} // namespace
} // namespace imgeo
