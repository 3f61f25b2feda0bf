#include "import/testing.h"

#include "import/e57/point_fields.h"
#include "import/e57/testing.h"
#include "import/mesh/point_cloud_testing.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

namespace imgeo {

namespace {

using testing::BitWriter;
using testing::cartesian;
using testing::errorOf;
using testing::fileOf;
using testing::float32;
using testing::float64;
using testing::hasWarning;
using testing::integer;
using testing::keepingAll;
using testing::metadata;
using testing::onlyMesh;
using testing::TestField;
using testing::TestFile;
using testing::TestScan;
using testing::text;
using testing::valuesOf;

/// The file with the checksums of its changed bytes.
Bytes repaired(const Bytes& file) {
  Bytes content;
  for (std::size_t page = 0; page < file.size(); page += e57::pageBytes)
    content.insert(content.end(), file.begin() + static_cast<std::ptrdiff_t>(page),
                   file.begin() + static_cast<std::ptrdiff_t>(page + e57::pageContentBytes));
  return TestFile::paged(content);
}

TEST(E57, ChecksumsAreThoseOfTheStandard) {
  EXPECT_EQ(e57::crc32c(asBytes("123456789")), 0xe3069283); // the check value of CRC-32C
  EXPECT_EQ(e57::crc32c(Bytes(32, 0)), 0x8a9136aa);         // RFC 3720, B.4
  EXPECT_EQ(e57::crc32c(Bytes(32, 0xff)), 0x62a8ab43);
}

TEST(E57, PointsOfFloatsIntegersAndScaledIntegersHaveTheirPositions) {
  const std::vector<std::vector<double>> points{{0.5, -7, 1.25}, {1.5, 100, -3}, {-2, 3, 0}};
  const std::vector<Vec3f> expected{{0.5, -7, 1.25}, {1.5, 100, -3}, {-2, 3, 0}};
  for (const std::size_t packetBytes : {1, 3, 5, 1000}) {
    SCOPED_TRACE(packetBytes);
    TestFile file = fileOf(
        {float32("cartesianX"), integer("cartesianY", -7, 100), integer("cartesianZ", -1000, 1000, 0.25, 0.5)}, points);
    file.packetBytes = packetBytes;
    const Mesh mesh = onlyMesh(file.file(), "a.e57");
    EXPECT_EQ(mesh.topology, Topology::points);
    EXPECT_EQ(mesh.positions, expected);
    file.scans[0].fields = cartesian();
    EXPECT_EQ(onlyMesh(file.file(), "a.e57").positions, expected);
  }
  const Imported imported = importBytes(fileOf(cartesian(), points).file(), "a.e57");
  EXPECT_EQ(imported.format, "E57");
  EXPECT_EQ(imported.up, AxisDirection::z);
  EXPECT_EQ(imported.metres, 1);
}

TEST(E57, IntegersOfAnyNumberOfBitsGoOnFromPacketToPacket) {
  for (std::uint32_t bits = 0; bits <= 64; ++bits) {
    SCOPED_TRACE(bits);
    e57::Field field{.name = "n", .type = e57::Field::Type::integer, .minimum = 0};
    field.range = bits == 0 ? 0 : ~std::uint64_t{0} >> (64 - bits);
    field.scale = 1;
    BitWriter out;
    std::vector<double> expected;
    std::uint64_t number = 0x9e3779b97f4a7c15;
    for (int n = 0; n < 50; ++n) {
      number = number * 6364136223846793005u + 1442695040888963407u;
      out.put(number & field.range, bits);
      expected.push_back(field.valueOf(number & field.range));
    }
    for (const std::size_t piece : {1, 7, 64}) {
      e57::FieldValues values(field, {0, 50}, false);
      for (std::size_t at = 0; at < out.bytes().size(); at += piece)
        values.append(ByteSpan(out.bytes()).subspan(at, std::min(piece, out.bytes().size() - at)));
      EXPECT_TRUE(values.isComplete());
      EXPECT_EQ(values.wide(), expected);
    }
  }
}

TEST(E57, FilesOfManyPagesAreReadAcrossChecksums) {
  std::vector<std::vector<double>> points;
  std::vector<Vec3f> expected;
  for (int n = 0; n < 2000; ++n) {
    points.push_back({n * 0.5, n * 0.25, -n * 1.0});
    expected.emplace_back(static_cast<float>(n) * 0.5f, static_cast<float>(n) * 0.25f, static_cast<float>(-n));
  }
  TestFile file = fileOf(cartesian(), points);
  file.packetBytes = 1500;
  Bytes bytes = file.file();
  EXPECT_GT(bytes.size(), 40u * e57::pageBytes);
  EXPECT_EQ(onlyMesh(bytes, "a.e57").positions, expected);
  bytes[20 * e57::pageBytes + 100] ^= 1;
  const Error error = errorOf(bytes, "a.e57");
  EXPECT_EQ(error.message(), "a page's checksum is not that of its bytes");
  EXPECT_EQ(error.location(), fmt::format("a.e57, byte {}", 21 * e57::pageBytes - 4));
}

TEST(E57, SphericalCoordinatesBecomeCartesianOnes) {
  const double quarter = std::numbers::pi / 2;
  const Mesh mesh =
      onlyMesh(fileOf({float64("sphericalRange"), float64("sphericalAzimuth"), float64("sphericalElevation")},
                      {{2, 0, 0}, {2, quarter, 0}, {3, 1, quarter}})
                   .file(),
               "a.e57");
  const std::vector<Vec3f> expected{{2, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  for (std::size_t n = 0; n < 3; ++n)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(mesh.positions[n][axis], expected[n][axis], 1e-6);
}

const std::string quarterTurn =
    R"(<pose type="Structure"><rotation type="Structure"><w type="Float">0.5</w><x type="Float"/><y type="Float"/>)"
    R"(<z type="Float">0.5</z></rotation><translation type="Structure"><x type="Float">{}</x>)"
    R"(<y type="Integer">20</y><z type="Float">3e1</z></translation></pose>)";

TEST(E57, EachScanIsAShapeOfItsNameInItsPose) {
  TestFile file = fileOf(cartesian(), {{1, 0, 0}});
  file.scans[0].elements =
      "<name type=\"String\"><![CDATA[Setup 1]]></name>" + fmt::format(fmt::runtime(quarterTurn), 10);
  file.scans.push_back({.elements = "", .fields = cartesian(), .points = {}});
  file.scans.push_back({.elements = "", .fields = cartesian(), .points = {{7, 8, 9}}});
  const Imported imported = importBytes(file.file(), "b.e57");
  ASSERT_EQ(imported.scene.meshes.size(), 2u);
  EXPECT_EQ(imported.scene.meshes[0].positions[0], Vec3f(10, 21, 30));
  EXPECT_EQ(imported.scene.meshes[1].positions[0], Vec3f(7, 8, 9));
  EXPECT_EQ(imported.scene.graph.nodes[imported.scene.graph.roots[0]].name, "Setup 1");
  EXPECT_EQ(imported.scene.graph.nodes[imported.scene.graph.roots[1]].name, "b-2");
}

TEST(E57, ScansFarFromZeroShareAnOriginThatTheMetadataState) {
  TestFile file = fileOf(cartesian(), {{1, 0, 0}, {1.001, 0, 0}});
  file.elements = "<coordinateMetadata type=\"String\">PROJCS[&quot;x&quot;]</coordinateMetadata>";
  file.scans[0].elements = fmt::format(fmt::runtime(quarterTurn), 500000);
  const Imported imported = importBytes(file.file(), "a.e57");
  EXPECT_EQ(metadata(imported, "origin"), "500000 21 30");
  EXPECT_EQ(metadata(imported, "wkt"), "\"PROJCS[\\\"x\\\"]\"");
  const std::vector<Vec3f>& positions = imported.scene.meshes[0].positions;
  EXPECT_NEAR(positions[1].y - positions[0].y, 0.001, 1e-8);
  EXPECT_NEAR(positions[0].x, 0, 1e-8);
}

TEST(E57, ColoursAreFractionsOfTheirLimits) {
  std::vector<TestField> fields = cartesian();
  for (const char* const name : {"colorRed", "colorGreen", "colorBlue"})
    fields.push_back(integer(name, 0, 1023));
  TestFile file = fileOf(fields, {{0, 0, 0, 1023, 0, 300}});
  const Rgba byRange = onlyMesh(file.file(), "a.e57").colors[0];
  EXPECT_EQ(byRange.r, 1);
  EXPECT_EQ(byRange.g, 0);
  EXPECT_NEAR(byRange.b, 300 / 1023.0, 1e-6);
  std::string limits;
  for (const char* const name : {"colorRed", "colorGreen", "colorBlue"})
    limits += fmt::format(R"(<{0}Minimum type="Integer"/><{0}Maximum type="Integer">600</{0}Maximum>)", name);
  file.scans[0].elements = "<colorLimits type=\"Structure\">" + limits + "</colorLimits>";
  const Imported imported = importBytes(file.file(), "a.e57");
  EXPECT_EQ(imported.scene.meshes[0].colors[0], Rgba(1, 0, channelOf(0.5), 1));
  EXPECT_TRUE(hasWarning(imported, "1 colour value was"));
}

TEST(E57, OtherFieldsAreNamedValuesThatAreKeptOnDemand) {
  std::vector<TestField> fields = cartesian();
  fields.push_back(float32("intensity"));
  fields.push_back(integer("rowIndex", 0, 5000));
  fields.push_back(integer("returnCount", 1, 1));
  fields.push_back(text("label"));
  fields.push_back(float64("timeStamp"));
  fields.push_back(integer("cls:classification", 0, 31));
  TestFile file = fileOf(fields, {{0, 0, 0, 0.5, 7, 1, 0, 1000000.5, 6}, {1, 0, 0, NAN, 5000, 1, 0, 1000002, 2}});
  file.scans[0].elements = R"(<intensityLimits type="Structure"><intensityMinimum type="Float"/><intensityMaximum )"
                           R"(type="Float">2</intensityMaximum></intensityLimits>)";
  file.elements = R"(<images2D type="Vector"><vectorChild type="Structure"/></images2D>)";
  const Imported imported = importBytes(file.file(), "a.e57", keepingAll());
  auto values = valuesOf(imported.scene.meshes[0]);
  EXPECT_EQ(values["intensity"], (std::vector<float>{0.5, 0}));
  EXPECT_EQ(values["rowIndex"], (std::vector<float>{7, 5000}));
  EXPECT_EQ(values["returnCount"], (std::vector<float>{1, 1}));
  EXPECT_EQ(values["timeStamp"], (std::vector<float>{0.5, 2}));
  EXPECT_EQ(values["cls:classification"], (std::vector<float>{6, 2}));
  EXPECT_EQ(values.size(), 5u);
  EXPECT_EQ(metadata(imported, "timeStampOrigin"), "1000000");
  EXPECT_EQ(metadata(imported, "intensityLimits"), "0 2");
  EXPECT_TRUE(hasWarning(imported, "'intensity': 1 value is no number within single precision; 0 replaces it."));
  EXPECT_TRUE(hasWarning(imported, "Not carried over from the E57 file: label."));
  EXPECT_TRUE(hasWarning(imported, "1 picture of the E57 file is not carried over."));

  const Imported bare = importBytes(file.file(), "a.e57");
  EXPECT_TRUE(bare.scene.meshes[0].namedAttributes.empty());
  EXPECT_EQ(bare.attributes, imported.attributes);
  EXPECT_TRUE(hasWarning(bare, "E57 file: intensity, rowIndex, returnCount, label, timeStamp, cls:classification."));
}

TEST(E57, InvalidPointsAreLeftOutWithAWarning) {
  std::vector<TestField> fields = cartesian();
  fields.push_back(integer("cartesianInvalidState", 0, 2));
  fields.push_back(integer("intensity", 0, 255));
  TestFile file = fileOf(fields, {{NAN, 0, 0, 2, 1}, {1, 2, 3, 0, 2}, {4, 5, 6, 1, 3}, {-1, -2, -3, 0, 4}});
  const Imported imported = importBytes(file.file(), "a.e57", keepingAll());
  EXPECT_EQ(imported.scene.meshes[0].positions, (std::vector<Vec3f>{{1, 2, 3}, {-1, -2, -3}}));
  EXPECT_EQ(valuesOf(imported.scene.meshes[0])["intensity"], (std::vector<float>{2, 4}));
  EXPECT_TRUE(hasWarning(imported, "2 points are marked as invalid in the E57 file, and left out."));
  file.scans[0].points = {{1, 2, 3, 2, 0}};
  EXPECT_EQ(errorOf(file.file(), "a.e57").message(), "all points are marked as invalid");
  file.scans[0].points = {{NAN, 2, 3, 0, 0}};
  EXPECT_EQ(errorOf(file.file(), "a.e57").message(),
            "a coordinate of point 1 of a scan is not a number or beyond single precision");
}

TEST(E57, DamagedHeadersAreRefusedByOneSentence) {
  const Bytes file = fileOf(cartesian(), {{1, 2, 3}}).file();
  const auto with = [&](std::size_t at, std::uint8_t value) {
    Bytes edited = file;
    edited[at] = value;
    return errorOf(repaired(edited), "a.e57");
  };
  EXPECT_EQ(with(8, 2).message(), "E57 2.0 is not read, only 1.0");
  EXPECT_EQ(with(41, 8).message(), "pages of 2048 bytes are not those of E57, which have 1024");
  EXPECT_EQ(with(16, 1).message(),
            fmt::format("a file of {} bytes does not consist of pages of 1024", file.size() + 1));
  const Error longer = with(18, 1);
  EXPECT_EQ(longer.kind(), ErrorKind::truncated);
  EXPECT_EQ(longer.location(), "a.e57, byte 16");
  EXPECT_EQ(with(26, 1).message().substr(0, 38), "the header's offset of the XML section");
  EXPECT_NE(with(34, 1).message().find("the header promises an XML section of"), std::string::npos);
  EXPECT_EQ(with(48, 3).message(), "a section of type 3 cannot be that of a scan's points, 1");
  EXPECT_NE(with(58, 1).message().find("a section of "), std::string::npos);
  EXPECT_EQ(with(80, 9).message(), "packets of type 9 are unknown");
  EXPECT_EQ(with(84, 4).message(), "a packet has 4 bytestreams, and points have 3 fields");
  EXPECT_EQ(with(83, 9).message(), "a packet of 2332 bytes is not within its section");
  const Error streams = with(86, 200);
  EXPECT_EQ(streams.message(), "the bytestreams of a packet of 28 bytes are longer");
  EXPECT_EQ(streams.location(), "a.e57, byte 86");
}

TEST(E57, DamagedDescriptionsAreRefusedByOneSentence) {
  const TestFile file = fileOf(cartesian(), {{1, 2, 3}});
  const auto with = [&](const std::string& from, const std::string& to) {
    return errorOf(file.file([&](std::string& xml) { xml.replace(xml.find(from), from.size(), to); }), "a.e57");
  };
  EXPECT_EQ(with("cartesianZ", "cartesianW").message(),
            "the points of a scan have neither Cartesian nor spherical coordinates");
  const Error many = with("recordCount=\"1\"", "recordCount=\"1000000000000\"");
  EXPECT_EQ(many.kind(), ErrorKind::truncated);
  EXPECT_EQ(many.message(), "a scan of 1000000000000 points of 192 bits is promised, but the file cannot hold them");
  EXPECT_EQ(with("recordCount=\"1\"", "recordCount=\"2\"").message(),
            "the section of a scan's points ends after 1 of 2");
  EXPECT_EQ(with("recordCount=\"1\"", "recordCount=\"x\"").message(), "'x' of 'points' is not a number");
  EXPECT_EQ(with("fileOffset=\"48\"", "fileOffset=\"1022\"").message(),
            "the offset of a scan's points, 1022, is within a page's checksum");
  EXPECT_EQ(with("e57Root>", "e57root>").kind(), ErrorKind::malformed);
  EXPECT_EQ(with("type=\"Float\"", "type=\"Blob\"").message(),
            "'cartesianX' of a point is of type 'Blob', which is not read");
  EXPECT_EQ(with("type=\"Float\"", "type=\"Integer\" minimum=\"4\" maximum=\"3\"").message(),
            "'cartesianX' ranges from 4 to 3");
  EXPECT_EQ(with("<points ", "<spots ").kind(), ErrorKind::malformed);
  EXPECT_EQ(with("<codecs type=\"Vector\"/>", "<codecs><vectorChild><zip/></vectorChild></codecs>").message(),
            "points are coded by 'zip', which is not read");
  EXPECT_EQ(with("<prototype type=\"Structure\">", "<prototype/><other>").kind(), ErrorKind::malformed);
  TestFile none = file;
  none.scans.clear();
  EXPECT_EQ(errorOf(none.file(), "a.e57").message(), "has no points");
}

TEST(E57, CountsThatNoBytesBackAreRefused) {
  TestFile file =
      fileOf({integer("cartesianX", 0, 0), integer("cartesianY", 0, 0), integer("cartesianZ", 0, 0)}, {{0, 0, 0}});
  EXPECT_EQ(onlyMesh(file.file(), "a.e57").positions, (std::vector<Vec3f>{{0, 0, 0}}));
  const Bytes many = file.file([](std::string& xml) {
    const std::string from = "recordCount=\"1\"";
    xml.replace(xml.find(from), from.size(), "recordCount=\"4000000000\"");
  });
  EXPECT_EQ(errorOf(many, "a.e57").kind(), ErrorKind::truncated);
  file = fileOf(cartesian(), {{1, 2, 3}});
  const Bytes shared = file.file([](std::string& xml) {
    const std::string scan = xml.substr(xml.find("<vectorChild"), xml.find("</data3D>") - xml.find("<vectorChild"));
    for (int n = 0; n < 7; ++n) // each is stated to have as many points as the file can hold
      xml.insert(xml.find("</data3D>"), scan);
    for (std::size_t at = 0; (at = xml.find("recordCount=\"1\"", at)) != xml.npos; at += 15)
      xml.replace(at, 15, "recordCount=\"60\"");
  });
  EXPECT_EQ(errorOf(shared, "a.e57").kind(), ErrorKind::truncated);
}

TEST(E57, EveryPrefixIsRefused) {
  TestFile file = fileOf(cartesian(), {{1, 2, 3}});
  file.scans[0].elements = "<description>" + std::string(1200, 'x') + "</description>";
  const Bytes bytes = file.file();
  for (std::size_t length = 1; length < bytes.size(); length += length < 60 ? 1 : 37)
    EXPECT_NE(errorOf(ByteSpan(bytes).first(length), "a.e57").message(), "") << length;
  EXPECT_EQ(onlyMesh(bytes, "a.e57").positions.size(), 1u);
}

} // namespace

} // namespace imgeo
