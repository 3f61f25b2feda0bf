// Models far from zero, in memory and piece by piece.

#include "import/mesh/far_origin.h"

#include "base/file.h"
#include "base/testing.h"
#include "import/chunks/chunked_source.h"
#include "import/import.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <random>

namespace imgeo {
namespace {

constexpr std::uint32_t surveyTriangles = 500;

/// Corners of separate triangles of a survey, three each.
std::vector<Vec3d> surveyedCorners(const Vec3d& corner, double extent, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> offset(0, extent);
  std::vector<Vec3d> corners;
  for (std::uint32_t i = 0; i < 3 * surveyTriangles; ++i)
    corners.push_back(corner + Vec3d{offset(random), offset(random), offset(random)});
  return corners;
}

std::string surveyHeader(const char* format, const char* type) {
  return fmt::format("ply\nformat {} 1.0\nelement vertex {}\nproperty {} x\nproperty {} y\nproperty {} z\n"
                     "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                     format, 3 * surveyTriangles, type, type, type, surveyTriangles);
}

Bytes textPly(const std::vector<Vec3d>& corners, const char* type) {
  std::string text = surveyHeader("ascii", type);
  for (const Vec3d& p : corners)
    text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  for (std::uint32_t i = 0; i < corners.size(); i += 3)
    text += fmt::format("3 {} {} {}\n", i, i + 1, i + 2);
  return Bytes(asBytes(text).begin(), asBytes(text).end());
}

template <typename T> Bytes binaryPly(const std::vector<Vec3d>& corners) {
  const std::string text = surveyHeader("binary_little_endian", sizeof(T) == 8 ? "double" : "float");
  Bytes file(asBytes(text).begin(), asBytes(text).end());
  for (const Vec3d& p : corners)
    for (int axis = 0; axis < 3; ++axis)
      appendLittle(file, static_cast<T>(p[axis]));
  for (std::uint32_t i = 0; i < corners.size(); i += 3) {
    file.push_back(3);
    for (std::uint32_t k = 0; k < 3; ++k)
      appendLittle(file, i + k);
  }
  return file;
}

Bytes surveyObj(const std::vector<Vec3d>& corners) {
  std::string text;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    text += fmt::format("v {} {} {}\n", corners[i].x, corners[i].y, corners[i].z);
    if (i % 3 == 2)
      text += "f -3 -2 -1\n";
  }
  return Bytes(asBytes(text).begin(), asBytes(text).end());
}

Bytes surveyStl(const std::vector<Vec3d>& corners) {
  std::string text = "solid survey\n";
  for (std::size_t i = 0; i < corners.size(); ++i) {
    text += i % 3 == 0 ? "facet normal 0 0 1\nouter loop\n" : "";
    text += fmt::format("vertex {} {} {}\n", corners[i].x, corners[i].y, corners[i].z);
    text += i % 3 == 2 ? "endloop\nendfacet\n" : "";
  }
  text += "endsolid survey\n";
  return Bytes(asBytes(text).begin(), asBytes(text).end());
}

struct SurveyFile {
  std::string name;
  Bytes bytes;
};

/// The files that have all digits.
std::vector<SurveyFile> surveyFiles(const std::vector<Vec3d>& corners) {
  return {{"double.ply", textPly(corners, "double")},
          {"float.ply", textPly(corners, "float")},
          {"binary.ply", binaryPly<double>(corners)},
          {"a.obj", surveyObj(corners)},
          {"a.stl", surveyStl(corners)}};
}

std::vector<Vec3f> positionsOfCorners(const Mesh& mesh) {
  std::vector<Vec3f> corners;
  for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner)
    corners.push_back(mesh.cornerPosition(corner));
  return corners;
}

TEST(FarOrigin, IsTheWholeUnitsOfFarAxesOfTheFirstVertex) {
  EXPECT_EQ(farOriginOf({450000.7, -5400000.2, 310.8}), (Vec3d{450000, -5400001, 0}));
  EXPECT_EQ(farOriginOf({65535.9, 65536, -65536}), (Vec3d{0, 65536, -65536}));
  EXPECT_EQ(farOriginOf({0x1p40, 1e15, NAN}), (Vec3d{0, 0, 0}));
}

TEST(FarOrigin, KeepsPositionsWithinHalfAStepOfSinglePrecisionOverTheExtent) {
  const double extents[] = {0.5, 40, 3000, 50000};
  unsigned seed = 0;
  for (const double extent : extents)
    for (const Vec3d& corner : {Vec3d{450000.123, 5400000.456, 310.789}, Vec3d{-70000.5, 1e9, -2e6}}) {
      const std::vector<Vec3d> exact = surveyedCorners(corner, extent, ++seed);
      for (const SurveyFile& file : surveyFiles(exact)) {
        const Imported imported = importBytes(file.bytes, file.name);
        const Vec3d origin = imported.origin;
        EXPECT_EQ(origin, farOriginOf(exact[0])) << file.name;
        const std::vector<Vec3f> corners = positionsOfCorners(imported.scene.meshes.at(0));
        ASSERT_EQ(corners.size(), exact.size()) << file.name;
        for (int axis = 0; axis < 3; ++axis) {
          // 24 bits of what is left on the axis, and what doubles round.
          const double left = origin[axis] == 0 ? std::abs(corner[axis]) + extent : extent + 1;
          for (std::size_t i = 0; i < corners.size(); ++i)
            ASSERT_NEAR(static_cast<double>(corners[i][axis]) + origin[axis], exact[i][axis],
                        left * 0x1p-24 + std::abs(exact[i][axis]) * 0x1p-52)
                << file.name << " " << extent;
        }
      }
    }
}

TEST(FarOrigin, IsTheSamePieceByPiece) {
  const testing::TemporaryDirectory directory;
  for (const SurveyFile& file : surveyFiles(surveyedCorners({450000.123, 5400000.456, 310.789}, 200, 1))) {
    if (file.name == "a.stl")
      continue; // text of STL is read whole
    writeFile(directory / file.name, file.bytes);
    const Imported whole = importFile(directory / file.name);
    const auto source = ChunkedSource::open(directory / file.name, directory / "scratch", 50);
    std::vector<Vec3f> pieces;
    EXPECT_GT(source->mesh(0).chunkCount(), 5u);
    for (std::size_t chunk = 0; chunk < source->mesh(0).chunkCount(); ++chunk) {
      const Imported piece = source->mesh(0).read(chunk, {});
      for (const Vec3f& corner : positionsOfCorners(piece.scene.meshes.at(0)))
        pieces.push_back(corner);
    }
    EXPECT_EQ(pieces, positionsOfCorners(whole.scene.meshes.at(0))) << file.name;
    const Imported scene = source->readScene({0}, {});
    EXPECT_EQ(scene.scene.graph.nodes, whole.scene.graph.nodes) << file.name;
    EXPECT_NE(scene.origin.x, 0) << file.name;
  }
}

TEST(FarOrigin, IsThatOfTheOptionsWhereTheyStateOne) {
  const std::vector<Vec3d> corners = surveyedCorners({450000.5, 5400000.5, 310}, 10, 1);
  ImportOptions options;
  options.origin = Vec3d{449000, 5400000, 300};
  std::vector<SurveyFile> files = surveyFiles(corners);
  files.push_back({"single.ply", binaryPly<float>(corners)});
  for (const SurveyFile& file : files) {
    const Imported imported = importBytes(file.bytes, file.name, options);
    EXPECT_EQ(imported.origin, *options.origin) << file.name;
    EXPECT_NEAR(imported.scene.meshes.at(0).positions[0].x, corners[0].x - 449000, 0.02) << file.name;
  }
}

TEST(FarOrigin, IsZeroForBinaryFilesOfSinglePrecisionAndModelsNearZero) {
  const std::vector<Vec3d> far = surveyedCorners({450000.5, 5400000.5, 310}, 10, 1),
                           near = surveyedCorners({4000, -5000, 3}, 10, 1);
  std::vector<SurveyFile> files = surveyFiles(near);
  files.push_back({"single.ply", binaryPly<float>(far)});
  for (const SurveyFile& file : files) {
    const Imported imported = importBytes(file.bytes, file.name);
    EXPECT_EQ(imported.scene.graph.nodes.size(), 1u) << file.name; // without metadata
    const Vec3d& first = file.name == "single.ply" ? far[0] : near[0];
    EXPECT_EQ(imported.scene.meshes.at(0).positions[0], Vec3f(first)) << file.name;
  }
}

} // namespace
} // namespace imgeo
