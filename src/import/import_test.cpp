#include "base/testing.h"
#include "import/format.h"
#include "import/gltf/testing.h"
#include "import/testing.h"

#include <algorithm>
#include <filesystem>
#include <set>

namespace imgeo::testing {
namespace {

const std::string plyText = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                            "property float z\nend_header\n0 0 0\n";
const std::string handmadeObj = "# made by hand\n\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string stlText = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                            "endloop\nendfacet\nendsolid a\n";

TEST(Formats, HaveAReaderAndExtensionsOfTheirOwn) {
  std::set<std::string_view> extensions;
  for (const Format& format : formats()) {
    EXPECT_NE(format.read, nullptr) << format.name;
    EXPECT_TRUE(format.sniff || !format.extensions.empty() || format.readsExtension) << format.name;
    for (const std::string_view extension : format.extensions) {
      const bool isFirst = extensions.insert(extension).second;
      EXPECT_TRUE(isFirst || format.sniffing == Sniffing::extension) << extension << " has two readers";
      EXPECT_TRUE(extension.starts_with('.')) << extension;
      EXPECT_TRUE(std::ranges::none_of(extension, [](char c) { return c >= 'A' && c <= 'Z'; })) << extension;
      const Format& byExtension = formatOf(asBytes("no format's content"), "a" + std::string(extension));
      EXPECT_EQ(&byExtension == &format, isFirst) << extension;
    }
  }
}

TEST(Formats, AreNamedInTheHelp) {
  for (const Format& format : formats())
    EXPECT_NE(formatHelp().find(format.help), std::string::npos) << format.name;
}

TEST(Import, RecognisesTheFormatByItsContentUnderAnyName) {
  for (const char* name : {"a.ply", "a.obj", "a.stl", "a", "a.gz", "-"}) {
    EXPECT_EQ(importBytes(asBytes(plyText), name).format, "PLY");
    EXPECT_EQ(importBytes(asBytes(handmadeObj), name).format, "OBJ");
    EXPECT_EQ(importBytes(asBytes(stlText), name).format, "STL");
  }
}

TEST(Import, RecognisesTheFormatByTheExtensionWhereTheContentDoesNot) {
  EXPECT_NE(errorOf("no such thing", "a.PLY").message().find("'ply'"), std::string::npos);
  EXPECT_NE(errorOf("no such thing", "a.stl").message().find("STL"), std::string::npos);
  EXPECT_EQ(importBytes(asBytes("parm u 0\nv 0 0 0\n"), "a.obj.gz").format, "OBJ");
}

TEST(Import, ListsTheFormatsWhereItRecognisesNone) {
  const Error error = errorOf("BC....", "a.bc");
  EXPECT_EQ(error.kind(), ErrorKind::unsupported);
  EXPECT_EQ(error.location(), "a.bc");
  for (const Format& format : formats())
    EXPECT_NE(error.message().find(format.name), std::string::npos) << error.message();
}

TEST(Import, SaysWhatMayBeDoneWithFilesOfProgramsThatItDoesNotRead) {
  const auto adviceOn = [](const std::string& name) {
    const std::string message = errorOf("BC....", name).message();
    const std::size_t at = message.find("; ");
    return at == std::string::npos ? "" : message.substr(at);
  };
  EXPECT_EQ(adviceOn("a.BREP"),
            "; imgeo does not read the curved surfaces of CAD: export triangles, as glTF, OBJ or STL");
  EXPECT_EQ(adviceOn("a.iges"), adviceOn("a.BREP"));
  EXPECT_EQ(adviceOn("a.usdc"), "; export the scene as glTF, which imgeo reads");
  EXPECT_EQ(adviceOn("a.bc"), "");
}

TEST(Import, RefusesAnEmptyFile) {
  EXPECT_EQ(errorOf("", "a.ply").kind(), ErrorKind::truncated);
}

TEST(Import, SkipsAByteOrderMark) {
  EXPECT_EQ(importBytes(asBytes("\xef\xbb\xbf" + handmadeObj), "a.obj").format, "OBJ");
}

TEST(Import, ReadsTextInUtf16) {
  std::string little = "\xff\xfe", big = "\xfe\xff";
  for (const char c : handmadeObj) {
    little += {c, '\0'};
    big += {'\0', c};
  }
  EXPECT_EQ(importBytes(asBytes(little), "a.obj").format, "OBJ");
  EXPECT_EQ(importBytes(asBytes(big), "a.obj").format, "OBJ");
  EXPECT_EQ(errorOf("\xff\xfe", "a.obj").kind(), ErrorKind::truncated);
}

TEST(Import, NamesTheSceneAfterTheFile) {
  for (const char* name : {"models/bunny.ply", "bunny.ply.gz", "bunny"}) {
    const Scene scene = importBytes(asBytes(plyText), name).scene;
    EXPECT_EQ(scene.graph.title, "bunny");
    EXPECT_EQ(scene.meshes.at(0).name, "bunny");
  }
}

TEST(Import, ThrowsForAMissingFile) {
  try {
    importFile("no/such/file.ply");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::io);
  }
}

TEST(Import, TakesATextureThatIsMissingForAFaultOfTheSourceIfStrict) {
  const TemporaryDirectory directory;
  const auto write = [&](const char* name, const std::string& text) { writeFile(directory / name, asBytes(text)); };
  write("a.mtl", "newmtl red\nmap_Kd missing.png\n");
  write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl red\nf 1/1 2/1 3/1\n");
  write("a.x3d", "<X3D><Scene><Shape><Appearance><ImageTexture url='missing.png'/></Appearance><TriangleSet>"
                 "<Coordinate point='0 0 0 1 0 0 0 1 0'/></TriangleSet></Shape></Scene></X3D>");
  GltfText gltf;
  gltf.json["images"] = {{{"uri", "missing.png"}}};
  gltf.json["textures"] = {{{"source", 0}}};
  gltf.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  const std::size_t triangle = gltf.addTriangle();
  gltf.json["meshes"][triangle]["primitives"][0]["material"] = 0;
  gltf.show(triangle);
  writeFile(directory / "a.glb", gltf.glb());
  ImportOptions strict;
  strict.strict = true;
  for (const char* name : {"a.obj", "a.x3d", "a.glb"}) {
    EXPECT_EQ(importFile(directory / name).warnings.size(), 1u) << name;
    try {
      importFile(directory / name, strict);
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::malformed) << name;
      EXPECT_NE(std::string(error.what()).find("missing.png"), std::string::npos) << error.what();
    }
  }
}

} // namespace
} // namespace imgeo::testing
