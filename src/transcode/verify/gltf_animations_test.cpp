// Animated sites and their exports as GLB.

#include "base/file.h"
#include "base/testing.h"
#include "imgeo/imgeo.h"
#include "transcode/export/export_site.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryDirectory;

/// A scene with what glTF can express, what it cannot, and the same in other ways.
struct MovingDocument {
  std::string quarter = "1.5708", cycle = "4", moved = "Ball", further = "";

  std::string text() const {
    const auto route = [](const std::string& from, const std::string& to) {
      const std::size_t a = from.find('.'), b = to.find('.');
      return fmt::format("<ROUTE fromNode='{}' fromField='{}' toNode='{}' toField='{}'/>", from.substr(0, a),
                         from.substr(a + 1), to.substr(0, b), to.substr(b + 1));
    };
    std::string routes =
        route("Clock.fraction_changed", "Turn.set_fraction") + route("Turn.value_changed", "Door.rotation") +
        route("Turn.value_changed", "Twice.rotation") + route("Clock.fraction_changed", "Move.set_fraction") +
        route("Move.value_changed", moved + ".set_translation") + route("Later.fraction_changed", "Half.set_fraction") +
        route("Half.value_changed", "Wheel.rotation");
    return fmt::format(
        "<X3D version='4.0'><Scene><TimeSensor DEF='Clock' cycleInterval='{}' loop='true'/>"
        "<TimeSensor DEF='Later' cycleInterval='2' loop='true' enabled='false'/>"
        "<Transform DEF='Door' center='1 0 0'><Shape><Box/></Shape></Transform>"
        "<Transform DEF='Twice'><Shape><Cone/></Shape></Transform>"
        "<Transform translation='0 9 0'><Transform USE='Twice'/></Transform>"
        "<Transform DEF='Ball' rotation='0 0 1 0.5'><Transform DEF='Inner'><Shape><Sphere/></Shape></Transform>"
        "</Transform>"
        "<Transform DEF='Wheel'><Shape><Appearance><Material DEF='Paint'/></Appearance><Cylinder/>"
        "</Shape></Transform><Transform DEF='Eye'><Viewpoint/></Transform>"
        "<OrientationInterpolator DEF='Turn' key='0 0.25 0.25 1' "
        "keyValue='0 1 0 0 0 1 0 {} 0 1 0 3 1 0 0 0.5'/>"
        "<OrientationInterpolator DEF='Half' key='0 0.5 1' "
        "keyValue='0 0 1 0 0 0 1 3.14159265 0 0 1 6.2831853'/>"
        "<PositionInterpolator DEF='Move' key='0 0.5 1' keyValue='0 0 0 0 2 0 0 0 0'/>{}{}</Scene></X3D>",
        cycle, quarter, routes, further);
  }
};

/// What glTF cannot express: a colour, a sensor, a viewpoint that moves.
const std::string beyondGltf =
    "<TouchSensor DEF='Touch'/><TimeSensor DEF='Once'/>"
    "<ColorInterpolator DEF='Colors' key='0 1' keyValue='1 0 0 0 1 0'/>"
    "<ROUTE fromNode='Clock' fromField='fraction_changed' toNode='Colors' toField='set_fraction'/>"
    "<ROUTE fromNode='Colors' fromField='value_changed' toNode='Paint' toField='diffuseColor'/>"
    "<ROUTE fromNode='Move' fromField='value_changed' toNode='Eye' toField='translation'/>"
    "<ROUTE fromNode='Touch' fromField='touchTime' toNode='Once' toField='startTime'/>";

struct AnimatedSite {
  TemporaryDirectory directory;
  fs::path path(const std::string& name) const { return directory.path() / name; }

  void convertText(const std::string& text) const {
    writeFile(path("in.x3d"), asBytes(text));
    convertFile("in.x3d");
  }

  void convertFile(const std::string& name) const {
    ConvertOptions options;
    options.force = true;
    options.pictures = false;
    convert(path(name), path("site"), options);
    EXPECT_EQ(verify(path("site"), path(name)).findings, std::vector<std::string>{});
  }

  void exportAs(const std::string& name) const { exportSite(path("site"), path(name)); }
  VerifyReport verified(const std::string& name) const { return verify(path("site"), path(name)); }
};

TEST(GltfAnimations, OfAnExportAreThoseOfTheSite) {
  const AnimatedSite site;
  site.convertText(MovingDocument().text());
  site.exportAs("out.glb");
  const VerifyReport report = site.verified("out.glb");
  EXPECT_EQ(report.findings, std::vector<std::string>{});
  EXPECT_EQ(report.notCompared, std::vector<std::string>{});
}

TEST(GltfAnimations, ThatGltfCannotExpressAreCountedAndNotCompared) {
  const AnimatedSite site;
  site.convertText(MovingDocument{.further = beyondGltf}.text());
  site.exportAs("out.glb");
  const VerifyReport report = site.verified("out.glb");
  EXPECT_EQ(report.findings, std::vector<std::string>{});
  EXPECT_EQ(report.notCompared, std::vector<std::string>{"Not compared, since glTF cannot express it: 4 routes, "
                                                         "1 interpolator, 1 TimeSensor."});
  EXPECT_EQ(site.verified("in.x3d").notCompared, std::vector<std::string>{});
  std::string text = MovingDocument().text();
  text.replace(text.find("loop='true'"), 11, "startTime='5'");
  site.convertText(text);
  site.exportAs("out.glb");
  EXPECT_EQ(site.verified("out.glb").notCompared,
            std::vector<std::string>{"Not compared, since glTF cannot express it: when 1 TimeSensor plays."});
}

TEST(GltfAnimations, ThatDifferAreFindings) {
  const AnimatedSite site;
  site.convertText(MovingDocument().text());
  site.exportAs("out.glb");
  const std::vector<std::string> oneOfTwo{"1 of 2 animations of the site are not in the input.",
                                          "1 of 2 animations of the input are not in the site."};
  for (const MovingDocument& other : {MovingDocument{.quarter = "1.58"}, MovingDocument{.cycle = "4.01"},
                                      MovingDocument{.moved = "Door"}, MovingDocument{.moved = "Inner"}}) {
    SCOPED_TRACE(other.quarter + other.cycle + other.moved);
    site.convertText(other.text());
    EXPECT_EQ(site.verified("out.glb").findings, oneOfTwo);
  }
  std::string text = MovingDocument().text();
  text.replace(text.find("toNode='Wheel'"), 14, "toNode='Paint'");
  site.convertText(text);
  EXPECT_EQ(site.verified("out.glb").findings,
            std::vector<std::string>{"1 of 2 animations of the input are not in the site."});
}

TEST(GltfAnimations, LastForTheWholeCycleWhereKeysEndEarlier) {
  const AnimatedSite site;
  site.convertText("<X3D version='4.0'><Scene><TimeSensor DEF='Clock' cycleInterval='4' loop='true'/>"
                   "<Transform DEF='Door'><Shape><Box/></Shape></Transform>"
                   "<OrientationInterpolator DEF='Turn' key='0 0.25 0.5' keyValue='0 1 0 0 0 1 0 1 0 1 0 2'/>"
                   "<ROUTE fromNode='Clock' fromField='fraction_changed' toNode='Turn' toField='set_fraction'/>"
                   "<ROUTE fromNode='Turn' fromField='value_changed' toNode='Door' toField='rotation'/></Scene></X3D>");
  site.exportAs("out.glb");
  EXPECT_EQ(site.verified("out.glb").findings, std::vector<std::string>{});
  site.convertFile("out.glb");
  EXPECT_NE(asText(readFile(site.path("site") / "scene.x3d")).find("cycleInterval=\"4\""), std::string_view::npos);
}

TEST(GltfAnimations, OfASiteThatWasMadeOfGltfAreComparedWhole) {
  const AnimatedSite site;
  site.convertText(MovingDocument().text());
  site.exportAs("first.glb"); // two nodes share a sampler
  site.convertFile("first.glb");
  site.exportAs("second.glb"); // each has its own
  EXPECT_EQ(site.verified("second.glb").findings, std::vector<std::string>{});
  for (const std::string name : {"index.html", "scene.x3d"}) {
    const Bytes bytes = readFile(site.path("site") / name);
    std::string text(asText(bytes));
    const std::size_t loop = text.find("loop=\"true\"");
    ASSERT_NE(loop, text.npos);
    text.replace(loop, 11, "loop=\"false\"");
    writeFile(site.path("site") / name, asBytes(text));
  }
  for (const std::string name : {"first.glb", "second.glb"}) {
    const std::vector<std::string> findings = site.verified(name).findings;
    EXPECT_TRUE(std::ranges::count(findings, "1 of 2 TimeSensors differ from those of the input.") == 1)
        << ::testing::PrintToString(findings);
  }
}

} // namespace
} // namespace imgeo
