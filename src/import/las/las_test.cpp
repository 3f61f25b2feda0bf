#include "import/testing.h"

#include "base/bytes.h"
#include "import/mesh/point_cloud_testing.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <string>

namespace imgeo {

namespace {

using testing::errorOf;
using testing::hasWarning;
using testing::keepingAll;
using testing::metadata;
using testing::onlyMesh;
using testing::valuesOf;

template <typename T> void put(Bytes& bytes, std::size_t at, T value) {
  Bytes raw;
  appendLittle(raw, value);
  std::ranges::copy(raw, bytes.begin() + static_cast<std::ptrdiff_t>(at));
}

/// A LAS file of `points`, each a record of this format.
struct TestCloud {
  std::uint8_t minor = 2, format = 0;
  std::uint16_t recordBytes = 20;
  Vec3d scale{0.01, 0.01, 0.01}, offset{0, 0, 0};
  Bytes records; ///< variable length records
  std::uint32_t recordCount = 0;
  std::vector<Bytes> points;

  Bytes& addPoint(std::int32_t x, std::int32_t y, std::int32_t z) {
    Bytes& point = points.emplace_back(recordBytes);
    put(point, 0, x), put(point, 4, y), put(point, 8, z);
    return point;
  }

  void addRecord(const std::string& user, std::uint16_t id, const Bytes& content) {
    Bytes header(54);
    std::ranges::copy(user, header.begin() + 2);
    put(header, 18, id), put(header, 20, static_cast<std::uint16_t>(content.size()));
    records.insert(records.end(), header.begin(), header.end());
    records.insert(records.end(), content.begin(), content.end());
    ++recordCount;
  }

  Bytes file() const {
    const std::size_t headerBytes = minor >= 4 ? 375 : minor == 3 ? 235 : 227;
    Bytes bytes(headerBytes);
    std::ranges::copy(std::string("LASF"), bytes.begin());
    bytes[24] = 1, bytes[25] = minor;
    put(bytes, 94, static_cast<std::uint16_t>(headerBytes));
    put(bytes, 96, static_cast<std::uint32_t>(headerBytes + records.size()));
    put(bytes, 100, recordCount);
    bytes[104] = format;
    put(bytes, 105, recordBytes);
    if (minor < 4)
      put(bytes, 107, static_cast<std::uint32_t>(points.size()));
    else
      put(bytes, 247, static_cast<std::uint64_t>(points.size()));
    for (int axis = 0; axis < 3; ++axis) {
      put(bytes, 131 + 8 * static_cast<std::size_t>(axis), scale[axis]);
      put(bytes, 155 + 8 * static_cast<std::size_t>(axis), offset[axis]);
    }
    bytes.insert(bytes.end(), records.begin(), records.end());
    for (const Bytes& point : points)
      bytes.insert(bytes.end(), point.begin(), point.end());
    return bytes;
  }
};

constexpr std::uint16_t formatBytes[]{20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

TEST(Las, PointsOfAllFormatsHaveTheirPositionsColoursAndAttributes) {
  constexpr std::size_t colorAt[]{0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};
  for (std::uint8_t format = 0; format <= 10; ++format) {
    SCOPED_TRACE(static_cast<int>(format));
    const bool isLong = format >= 6;
    TestCloud cloud;
    cloud.minor = isLong ? 4 : format >= 4 ? 3 : 2;
    cloud.format = format;
    cloud.recordBytes = formatBytes[format];
    for (int n = 0; n < 3; ++n) {
      Bytes& point = cloud.addPoint(100 * n, 200, -300 * n);
      put(point, 12, static_cast<std::uint16_t>(1000 + n));
      if (isLong) {
        point[14] = static_cast<std::uint8_t>(n + 1 + 16 * 5);
        point[16] = 64;
        point[17] = 9;
        put(point, 18, static_cast<std::int16_t>(-5000));
        put(point, 20, std::uint16_t{77});
        put(point, 22, 1000000.5 + n);
      } else {
        point[14] = static_cast<std::uint8_t>(n + 1 + 8 * 5);
        point[15] = 6 | 0x20; // synthetic
        point[16] = static_cast<std::uint8_t>(-30);
        point[17] = 9;
        put(point, 18, std::uint16_t{77});
        if (format != 0 && format != 2)
          put(point, 20, 1000000.5 + n);
      }
      if (colorAt[format] != 0)
        put(point, colorAt[format] + 2, std::uint16_t{32768});
      if (format == 8 || format == 10)
        put(point, 36, static_cast<std::uint16_t>(500 + n));
    }
    const Bytes file = cloud.file();
    const Mesh mesh = onlyMesh(file, "cloud.las", keepingAll());
    EXPECT_EQ(mesh.topology, Topology::points);
    EXPECT_EQ(mesh.positions, (std::vector<Vec3f>{{0, 2, 0}, {1, 2, -3}, {2, 2, -6}}));
    if (colorAt[format] == 0) {
      EXPECT_TRUE(mesh.colors.empty());
    } else {
      ASSERT_EQ(mesh.colors.size(), 3u);
      EXPECT_NEAR(mesh.colors[2].g, 32768 / 65535.0, 1e-6);
      EXPECT_EQ(mesh.colors[2].r, 0);
    }
    auto values = valuesOf(mesh);
    EXPECT_EQ(values["intensity"], (std::vector<float>{1000, 1001, 1002}));
    EXPECT_EQ(values["returnNumber"], (std::vector<float>{1, 2, 3}));
    EXPECT_EQ(values["numberOfReturns"], (std::vector<float>{5, 5, 5}));
    EXPECT_EQ(values["classification"][0], isLong ? 64 : 6);
    EXPECT_FLOAT_EQ(values["scanAngle"][0], -30);
    EXPECT_EQ(values["userData"][0], 9);
    EXPECT_EQ(values["pointSourceId"][0], 77);
    const bool hasTime = format != 0 && format != 2;
    EXPECT_EQ(values["gpsTime"], hasTime ? (std::vector<float>{0.5, 1.5, 2.5}) : std::vector<float>{});
    const Imported imported = importBytes(file, "cloud.las", keepingAll());
    EXPECT_EQ(metadata(imported, "gpsTimeOrigin"), hasTime ? "1000000" : "");
    EXPECT_EQ(values.contains("nearInfrared"), format == 8 || format == 10);
    EXPECT_EQ(hasWarning(imported, "Waveforms"), format == 4 || format == 5 || format == 9 || format == 10);
    EXPECT_EQ(imported.up, AxisDirection::z);
  }
}

TEST(Las, CoordinatesFarFromZeroKeepTheirStepAroundAnOriginThatTheMetadataState) {
  TestCloud cloud;
  cloud.scale = {0.001, 0.001, 0.001};
  cloud.offset = {500000, 5800000, 0};
  cloud.addPoint(0, 0, 120345);
  cloud.addPoint(1, 20001, 120347);
  const Bytes file = cloud.file();
  const Imported imported = importBytes(file, "utm.las");
  EXPECT_EQ(metadata(imported, "origin"), "500000 5800010 0");
  const std::vector<Vec3f>& positions = imported.scene.meshes[0].positions;
  EXPECT_NEAR(positions[1].x, 0.001, 1e-7);
  EXPECT_NEAR(positions[1].y - positions[0].y, 20.001, 2e-6);
  EXPECT_NEAR(positions[1].z, 120.347, 1e-5);

  cloud.offset = {0, 0, 0};
  const Imported near = importBytes(cloud.file(), "near.las");
  EXPECT_EQ(metadata(near, "origin"), "0 0 0");
  EXPECT_FLOAT_EQ(near.scene.meshes[0].positions[1].y, 20.001f);
}

TEST(Las, WithheldPointsAreLeftOutWithAWarning) {
  for (const bool isLong : {false, true}) {
    TestCloud cloud;
    cloud.minor = isLong ? 4 : 2;
    cloud.format = isLong ? 6 : 1;
    cloud.recordBytes = formatBytes[cloud.format];
    cloud.addPoint(1, 1, 1)[15] = isLong ? 0x04 : 0x80;
    cloud.addPoint(100, 200, 300);
    const Imported imported = importBytes(cloud.file(), "a.las");
    EXPECT_EQ(imported.scene.meshes[0].positions, (std::vector<Vec3f>{{1, 2, 3}}));
    EXPECT_TRUE(hasWarning(imported, "1 point is marked as withheld"));
    cloud.points.pop_back();
    EXPECT_EQ(errorOf(cloud.file(), "a.las").message(), "all points are marked as withheld");
  }
}

TEST(Las, ColoursOfEightBitsAndBlackOnesAreRecognised) {
  TestCloud cloud;
  cloud.format = 2;
  cloud.recordBytes = 26;
  put(cloud.addPoint(0, 0, 0), 20, std::uint16_t{255});
  const Imported bytes = importBytes(cloud.file(), "a.las");
  EXPECT_EQ(bytes.scene.meshes[0].colors[0], Rgba(Rgba8{255, 0, 0, 255}));
  EXPECT_TRUE(hasWarning(bytes, "read as 8 bits"));
  put(cloud.points[0], 20, std::uint16_t{0});
  const Imported black = importBytes(cloud.file(), "a.las");
  EXPECT_TRUE(black.scene.meshes[0].colors.empty());
  EXPECT_TRUE(hasWarning(black, "all black"));
}

Bytes descriptor(std::uint8_t type, const std::string& name, std::uint8_t options = 0, double scale = 0,
                 double offset = 0) {
  Bytes bytes(192);
  bytes[2] = type, bytes[3] = options;
  std::ranges::copy(name, bytes.begin() + 4);
  put(bytes, 112, scale), put(bytes, 136, offset);
  return bytes;
}

TEST(Las, ExtraBytesAreAttributesOfTheirNamesAndScales) {
  TestCloud cloud;
  Bytes descriptors;
  for (const Bytes& entry : {descriptor(3, "Echo Width", 8 | 16, 0.5, 10), descriptor(0, "", 3), descriptor(29, "pull"),
                             descriptor(1, "intensity")})
    descriptors.insert(descriptors.end(), entry.begin(), entry.end());
  cloud.addRecord("LASF_Spec", 4, descriptors);
  cloud.recordBytes = 20 + 2 + 3 + 12 + 1;
  Bytes& point = cloud.addPoint(0, 0, 0);
  put(point, 20, std::uint16_t{7});
  put(point, 25, 1.5f), put(point, 29, -2.5f), put(point, 33, std::nanf(""));
  point[37] = 3;
  const Imported imported = importBytes(cloud.file(), "a.las", keepingAll());
  auto values = valuesOf(imported.scene.meshes[0]);
  EXPECT_EQ(values["Echo_Width"], std::vector<float>{13.5});
  EXPECT_EQ(values["pull"], (std::vector<float>{1.5, -2.5, 0}));
  EXPECT_EQ(values["intensity_2"], std::vector<float>{3});
  EXPECT_TRUE(hasWarning(imported, "'pull': 1 value is no number within single precision; 0 replaces it."));
  EXPECT_EQ(imported.attributes.back(), "intensity_2");

  const Imported bare = importBytes(cloud.file(), "a.las");
  EXPECT_TRUE(bare.scene.meshes[0].namedAttributes.empty());
  EXPECT_TRUE(hasWarning(bare, "Not carried over from the LAS file: Echo_Width, pull, intensity_2."));

  cloud.recordBytes = 30;
  cloud.points = {Bytes(30)};
  EXPECT_EQ(errorOf(cloud.file(), "a.las").message(), "the extra bytes 'pull' do not fit into records of 30 bytes");
}

TEST(Las, ReferenceSystemsAreMetadata) {
  TestCloud cloud;
  Bytes keys;
  for (const int key : {1, 1, 0, 2, 2048, 0, 1, 4258, 3072, 0, 1, 25832})
    appendLittle(keys, static_cast<std::uint16_t>(key));
  cloud.addRecord("LASF_Projection", 34735, keys);
  const std::string wkt = "PROJCS[\"x\"]";
  cloud.addRecord("LASF_Projection", 2112, Bytes(wkt.begin(), wkt.end()));
  cloud.addPoint(0, 0, 0);
  const Imported imported = importBytes(cloud.file(), "a.las");
  EXPECT_EQ(metadata(imported, "crs"), "\"EPSG:25832\"");
  EXPECT_EQ(metadata(imported, "wkt"), "\"PROJCS[\\\"x\\\"]\"");
}

TEST(Las, OtherFilesAreRefusedByOneSentence) {
  TestCloud cloud;
  cloud.addPoint(0, 0, 0);
  const auto edited = [&](const std::function<void(Bytes&)>& edit) {
    Bytes file = cloud.file();
    edit(file);
    return errorOf(file, "a.las");
  };
  const Error laz = edited([](Bytes& file) { file[104] = 0x80; });
  EXPECT_EQ(laz.kind(), ErrorKind::unsupported);
  EXPECT_NE(laz.message().find("is compressed (LAZ), which imgeo does not read; `las2las"), std::string::npos);
  EXPECT_EQ(edited([](Bytes& file) { file[104] = 11; }).message(),
            "points of format 11 are not read, only those of formats 0 to 10");
  EXPECT_EQ(edited([](Bytes& file) { file[25] = 5; }).message(), "LAS 1.5 is not read, only 1.0 to 1.4");
  EXPECT_EQ(edited([](Bytes& file) { put(file, 105, std::uint16_t{19}); }).message(),
            "records of 19 bytes are too short for points of format 0, which take 20");
  const Error more = edited([](Bytes& file) { put(file, 107, std::uint32_t{0xffffffff}); });
  EXPECT_EQ(more.kind(), ErrorKind::truncated);
  EXPECT_EQ(more.message(), "the header promises 4294967295 points of 20 bytes, but only 20 bytes follow");
  EXPECT_EQ(more.location(), "a.las, byte 107");
  EXPECT_EQ(edited([](Bytes& file) { put(file, 107, std::uint32_t{0}); }).message(), "has no points");
  EXPECT_EQ(edited([](Bytes& file) { put(file, 131, 0.0); }).message(),
            "scale and offset of the coordinates are no usable numbers");
  EXPECT_EQ(edited([](Bytes& file) { put(file, 155, std::nan("")); }).location(), "a.las, byte 155");
  EXPECT_EQ(edited([](Bytes& file) { put(file, 100, std::uint32_t{1000}); }).message(),
            "the file ends within variable length record 1 of 1000");
  EXPECT_EQ(edited([](Bytes& file) { put(file, 96, std::uint32_t{90000}); }).message(),
            "the points cannot begin at byte 90000");
}

TEST(Las, EveryPrefixIsRefused) {
  TestCloud cloud;
  cloud.minor = 4;
  cloud.addRecord("LASF_Spec", 4, descriptor(3, "width"));
  cloud.recordBytes = 22;
  cloud.addPoint(0, 0, 0);
  cloud.addPoint(1, 2, 3);
  const Bytes file = cloud.file();
  for (std::size_t length = 4; length < file.size(); ++length)
    EXPECT_NE(errorOf(ByteSpan(file).first(length), "a.las").message(), "") << length;
  EXPECT_EQ(onlyMesh(file, "a.las").positions.size(), 2u);
}

} // namespace

} // namespace imgeo
