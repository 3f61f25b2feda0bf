// Converts a scene of several documents into a site of as many documents, and reads it back.

#include "base/error.h"
#include "base/file.h"
#include "base/testing.h"
#include "transcode/site/testing.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

namespace fs = std::filesystem;

/// A square of n x n quads. With n = 10 it is too large to stay in the document.
std::string gridOf(int n) {
  std::string points, faces;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x)
      points += std::to_string(x) + " " + std::to_string(y) + " 0 ";
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int at = y * (n + 1) + x;
      for (const int corner : {at, at + 1, at + n + 2, at, at + n + 2, at + n + 1})
        faces += std::to_string(corner) + " ";
    }
  return "IndexedTriangleSet { index [ " + faces + "] coord Coordinate { point [ " + points + "] } }";
}

class InlineSite : public ::testing::Test {
protected:
  InlineSite() {
    fs::create_directories(directory_ / "in/parts");
    write("out.x3d", "<X3D><Scene/></X3D>");
    write("in/parts/seat.wrl", "#VRML V2.0 utf8\nDEF Seat Group { children [ DEF Back Shape { geometry " + gridOf(10) +
                                   " } Inline { url \"row.x3d\" } ] }");
    write("in/parts/row.x3d", "<X3D version='3.2'><Scene><Transform DEF='Seat' translation='1 0 0'>"
                              "<Inline url='\"lost.x3d\" \"seat.wrl\"'/></Transform></Scene></X3D>");
    write("in/hall.x3d", "<X3D><Scene><Inline DEF='A' url='\"parts/row.x3d\"'/>"
                         "<Transform DEF='Seat' translation='0 5 0'><Inline url='\"parts/row.x3d\"'/></Transform>"
                         "<Inline url='\"https://example.org/a.x3d\"'/><Inline url='\"../out.x3d\"'/>"
                         "<Inline url='\"hall.x3d\"'/></Scene></X3D>");
  }

  void write(const std::string& name, const std::string& text) { writeFile(directory_ / name, asBytes(text)); }
  ConvertReport convertHall(const ConvertOptions& options = {}) {
    return convert(directory_ / "in/hall.x3d", directory_ / "site", options);
  }
  std::string textOf(const std::string& file) { return std::string(asText(readFile(directory_ / "site" / file))); }

  testing::TemporaryDirectory directory_;
};

std::string urlIn(const std::string& text, std::size_t from = 0) {
  const std::string begin = "<Inline url='\"";
  const std::size_t at = text.find(begin, from) + begin.size();
  return text.substr(at, text.find('"', at) - at);
}

TEST_F(InlineSite, KeepsItsDocumentsApart) {
  const ConvertReport report = convertHall();
  EXPECT_EQ(report.elements.triangles, 200u);
  const std::string page = textOf("index.html"), row = textOf(urlIn(page, page.find("translation=\"0 5 0\""))),
                    seat = textOf(urlIn(row));
  EXPECT_EQ(page.find("ImageGeometry"), std::string::npos);
  EXPECT_NE(page.find("<Inline DEF=\"A\" url='\"" + urlIn(page, page.find("translation=\"0 5 0\""))),
            std::string::npos);
  EXPECT_NE(row.find("<X3D version=\"3.2\">"), std::string::npos) << row;
  EXPECT_NE(row.find("<Transform DEF=\"Seat\" translation=\"1 0 0\">"), std::string::npos) << row;
  EXPECT_NE(seat.find("<Shape DEF=\"Back\""), std::string::npos) << seat;
  EXPECT_NE(seat.find("<ImageGeometry"), std::string::npos) << seat;
  for (const char* kept : {"https://example.org/a.x3d", "../out.x3d", "hall.x3d"})
    EXPECT_NE(page.find(kept), std::string::npos) << kept;
}

TEST_F(InlineSite, WritesEachDocumentForX3dom) {
  ConvertOptions options;
  options.target = Target::x3dom;
  convertHall(options);
  const std::string page = textOf("index.html"), row = textOf(urlIn(page, page.find("translation=\"0 5 0\""))),
                    seat = textOf(urlIn(row));
  EXPECT_NE(seat.find("<ImageGeometry"), std::string::npos) << seat;
  EXPECT_EQ(seat.find("GeometryPatch"), std::string::npos) << seat;
}

TEST_F(InlineSite, WarnsOnceOfContentThatItLeavesOut) {
  const ConvertReport report = convertHall();
  const auto count = [&](const std::string& part) {
    return std::ranges::count_if(report.warnings,
                                 [&](const std::string& warning) { return warning.find(part) != std::string::npos; });
  };
  EXPECT_EQ(count("names row.x3d, which contains it"), 1) << ::testing::PrintToString(report.warnings);
  EXPECT_EQ(count("names hall.x3d, which contains it"), 1);
  EXPECT_EQ(count("1 Inline is left on other hosts"), 1);
  EXPECT_EQ(count("outside of the folder"), 1);
  EXPECT_EQ(report.warnings.size(), 4u) << ::testing::PrintToString(report.warnings);
  ConvertOptions strict;
  strict.strict = true;
  EXPECT_THROW(convertHall(strict), Error);
}

TEST_F(InlineSite, EqualsItsSourceAndCanBeExported) {
  const ConvertReport report = convertHall();
  const VerifyReport verified = verify(directory_ / "site", directory_ / "in/hall.x3d");
  EXPECT_TRUE(verified.equal) << verified.findings.at(0);
  EXPECT_EQ(exportSite(directory_ / "site", directory_ / "hall.ply").elements.triangles, 400u);
  const SiteInfo info = inspect(directory_ / "site");
  EXPECT_EQ(std::ranges::count(info.files, "document", &SiteFile::role), 3);
  fs::remove(directory_ / "site" / urlIn(textOf("index.html"), textOf("index.html").find("0 5 0")));
  EXPECT_FALSE(verify(directory_ / "site", directory_ / "in/hall.x3d").equal);
}

} // namespace
} // namespace imgeo
