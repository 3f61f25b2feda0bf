#include "base/error.h"
#include "base/file.h"
#include "base/testing.h"
#include "imgeo/imgeo.h"
#include "scene/shape_instances.h"
#include "transcode/sample/box_soup.h"
#include "transcode/sample/relief_charts.h"
#include "transcode/sample/relief_surface.h"
#include "transcode/sample/sample_file.h"
#include "transcode/sample/sample_hall.h"

#include <gtest/gtest.h>
#include <map>
#include <set>

namespace imgeo {
namespace {

TEST(SampleHall, HasOneMeshForAllItsSeats) {
  const Scene scene = hallScene(95);
  std::size_t seats = 0;
  for (const ShapeInstance& instance : shapeInstances(scene.graph))
    seats += scene.graph.nodes[instance.node].name == "seat";
  EXPECT_EQ(seats, 95u);
  EXPECT_LT(scene.meshes.size(), 10u);
  for (const Mesh& mesh : scene.meshes) {
    EXPECT_TRUE(isConsistent(mesh)) << mesh.name;
    for (const Vec3f& normal : mesh.normals)
      ASSERT_NEAR(length(Vec3d(normal)), 1, 1e-5) << mesh.name;
    // Front sides of faces are where their normals point.
    for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
      const Vec3d a(mesh.cornerPosition(i)), b(mesh.cornerPosition(i + 1)), c(mesh.cornerPosition(i + 2));
      const Vec3d normal = cross(b - a, c - a);
      if (length(normal) <= 1e-7)
        continue;
      const Vec3d facing = Vec3d(mesh.normals[mesh.corners[i]]) + Vec3d(mesh.normals[mesh.corners[i + 1]]);
      ASSERT_GT(dot(normal, facing), 0) << mesh.name;
    }
  }
}

TEST(SampleHall, BecomesASiteThatStoresEachMeshOnce) {
  const testing::TemporaryDirectory directory;
  const ExportReport sample = writeSampleHall(200, directory / "hall.glb");
  EXPECT_GT(sample.elements.triangles, 500'000u);
  const ConvertReport report = convert(directory / "hall.glb", directory / "site", {});
  EXPECT_LT(report.elements.triangles, 60'000u);
  EXPECT_EQ(report.warnings, std::vector<std::string>{});
  const VerifyReport verified = verify(directory / "site", directory / "hall.glb");
  EXPECT_TRUE(verified.equal) << verified.findings.at(0);
  EXPECT_THROW(writeSampleHall(1, directory / "hall.ply"), Error);
}

TEST(SampleRelief, IsClosedAndHasEveryVertexOnce) {
  for (const std::uint64_t triangles : {12u, 48u, 3072u}) {
    const ReliefSurface surface(triangles);
    EXPECT_EQ(surface.triangleCount(), triangles);
    std::set<std::pair<std::uint64_t, std::uint64_t>> edges;
    std::set<std::uint64_t> vertices;
    for (std::uint64_t i = 0; i < surface.triangleCount(); ++i) {
      const std::array<std::uint64_t, 3> corners = surface.triangle(i);
      const auto at = [&](std::size_t corner) { return Vec3d(surface.vertex(corners[corner])); };
      EXPECT_GT(dot(cross(at(1) - at(0), at(2) - at(0)), at(0)), 0) << "faces inwards";
      for (std::size_t corner = 0; corner < 3; ++corner) {
        EXPECT_TRUE(edges.emplace(corners[corner], corners[(corner + 1) % 3]).second);
        vertices.insert(corners[corner]);
      }
    }
    for (const auto& [from, to] : edges)
      EXPECT_TRUE(edges.contains({to, from}));
    EXPECT_EQ(vertices.size(), surface.vertexCount());
    EXPECT_EQ(*vertices.rbegin() + 1, surface.vertexCount());
  }
}

TEST(SampleRelief, HasDetailOfAllSizes) {
  const ReliefSurface fine(30000);
  double low = 2, high = 0;
  for (std::uint64_t i = 0; i < fine.vertexCount(); ++i) {
    low = std::min(low, length(Vec3d(fine.vertex(i))));
    high = std::max(high, length(Vec3d(fine.vertex(i))));
  }
  EXPECT_GT(low, 0.8);
  EXPECT_LT(high, 1.2);
  EXPECT_GT(high - low, 0.1);
}

TEST(SampleRelief, HasAPointOfTheSurfaceInEachSquare) {
  const ReliefSurface surface(24000);
  std::set<std::array<float, 3>> points;
  for (std::uint64_t i = 0; i < surface.squareCount(); ++i) {
    const Vec3f point = surface.pointInSquare(i);
    EXPECT_NEAR(length(Vec3d(point)), 1, 0.2);
    points.insert({point.x, point.y, point.z});
  }
  EXPECT_EQ(points.size(), surface.squareCount());
}

using Corner = std::array<float, 3>;

Corner cornerAt(const Vec3f& point) {
  return {point.x, point.y, point.z};
}

TEST(SampleReliefInCharts, IsClosedAndHasTheTrianglesOfTheRelief) {
  for (const std::uint64_t charts : {6u, 54u, 600u, 1'000'000u}) {
    const ReliefCharts surface(3072, charts);
    const ReliefSurface whole(3072);
    EXPECT_EQ(surface.chartCount(), std::min<std::uint64_t>(charts, whole.squareCount()));
    std::set<std::pair<Corner, Corner>> edges;
    std::set<std::uint64_t> vertices;
    for (std::uint64_t i = 0; i < surface.triangleCount(); ++i) {
      const std::array<std::uint64_t, 3> corners = surface.triangle(i), same = whole.triangle(i);
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const Vec3f from = surface.vertex(corners[corner]), to = surface.vertex(corners[(corner + 1) % 3]);
        EXPECT_EQ(from, whole.vertex(same[corner]));
        EXPECT_TRUE(edges.emplace(cornerAt(from), cornerAt(to)).second);
        vertices.insert(corners[corner]);
      }
    }
    for (const auto& [from, to] : edges)
      EXPECT_TRUE(edges.contains({to, from}));
    EXPECT_EQ(vertices.size(), surface.vertexCount());
    EXPECT_EQ(*vertices.rbegin() + 1, surface.vertexCount());
  }
}

TEST(SampleReliefInCharts, HasEachChartInACellOfTheAtlas) {
  const ReliefCharts surface(3072, 54);
  std::map<std::pair<int, int>, std::uint64_t> squares; // by cell of 8 x 8
  for (std::uint64_t i = 0; i < surface.triangleCount(); ++i) {
    std::set<std::pair<int, int>> cells;
    for (const std::uint64_t vertex : surface.triangle(i)) {
      const Vec2f at = surface.texCoord(vertex);
      EXPECT_GT(std::min(at.x, at.y), 0);
      EXPECT_LT(std::max(at.x, at.y), 1);
      cells.emplace(static_cast<int>(8 * at.x), static_cast<int>(8 * at.y));
    }
    ASSERT_EQ(cells.size(), 1u);
    ++squares[*cells.begin()];
  }
  EXPECT_EQ(squares.size(), 54u);
  for (const auto& [cell, triangles] : squares)
    EXPECT_NEAR(static_cast<double>(triangles), 3072.0 / 54, 16);
}

TEST(SampleReliefInCharts, IsAPlyFileWithTextureCoordinatesThatEqualsItsSite) {
  const testing::TemporaryDirectory directory;
  const ExportReport report = writeSampleReliefInCharts(3000, 100, true, directory / "relief.ply");
  EXPECT_EQ(report.bytes, std::filesystem::file_size(directory / "relief.ply"));
  ConvertOptions options;
  options.pictures = false;
  const ConvertReport converted = convert(directory / "relief.ply", directory / "site", options);
  EXPECT_EQ(converted.elements.triangles, report.elements.triangles);
  EXPECT_GT(converted.weld.mergedPositions, 0u);
  EXPECT_EQ(converted.warnings, std::vector<std::string>{});
  const VerifyReport verified = verify(directory / "site", directory / "relief.ply");
  EXPECT_TRUE(verified.equal);
}

TEST(SampleReliefInCharts, HasAnImageInWhichNeighbouringChartsContinueEachOther) {
  const ReliefCharts surface(3072, 54);
  const Image atlas = surface.atlas();
  EXPECT_EQ(atlas.width, 2048u);
  const auto colorAt = [&](const Vec2f& texCoord) {
    const auto x = static_cast<std::size_t>(texCoord.x * static_cast<float>(atlas.width));
    const auto y = static_cast<std::size_t>((1 - texCoord.y) * static_cast<float>(atlas.height));
    const std::uint8_t* pixel = &atlas.pixels[3 * (y * atlas.width + x)];
    return Vec3f(pixel[0], pixel[1], pixel[2]);
  };
  std::map<std::array<float, 3>, std::vector<Vec3f>> colors; // by position
  for (std::uint64_t i = 0; i < surface.vertexCount(); ++i) {
    const Vec3f at = surface.vertex(i);
    colors[{at.x, at.y, at.z}].push_back(colorAt(surface.texCoord(i)));
  }
  std::size_t seams = 0, differences = 0; // a pixel is on one side of a contour line or on the other
  for (const auto& [position, each] : colors)
    for (const Vec3f& color : each) {
      seams += each.size() > 1;
      differences += length(Vec3d(color) - Vec3d(each[0])) > 12;
    }
  EXPECT_GT(seams, 500u);
  EXPECT_LT(differences, seams / 10);
}

TEST(BoxSoup, HasBoxesOfManySizesWhoseRoomsDoNotTouch) {
  constexpr std::uint64_t count = 20 * BoxSoup::boxesPerRoom + 7;
  const BoxSoup soup(count, 1), other(count, 2);
  std::vector<Box3d> rooms(count / BoxSoup::boxesPerRoom + 1);
  double smallest = 100, largest = 0;
  std::uint64_t differences = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const Box3d box = soup.box(i);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LT(static_cast<float>(box.min[axis]), static_cast<float>(box.max[axis]));
    }
    smallest = std::min(smallest, length(box.size()));
    largest = std::max(largest, length(box.size()));
    differences += box != other.box(i);
    rooms[i / BoxSoup::boxesPerRoom].add(box.min);
    rooms[i / BoxSoup::boxesPerRoom].add(box.max);
  }
  EXPECT_LT(smallest, 0.05);
  EXPECT_GT(largest, 6);
  EXPECT_GT(differences, count * 9 / 10);
  for (const Box3d& a : rooms)
    for (const Box3d& b : rooms)
      if (&a != &b) {
        bool apart = false;
        for (int axis = 0; axis < 3; ++axis)
          apart = apart || a.max[axis] < b.min[axis] || b.max[axis] < a.min[axis];
        EXPECT_TRUE(apart);
      }
}

TEST(BoxSoup, IsAPlyFileOfClosedBoxesThatEqualsItsSite) {
  const testing::TemporaryDirectory directory;
  const ExportReport report = writeSampleBoxes(500, 1, false, directory / "boxes.ply");
  EXPECT_EQ(report.elements.triangles, 6000u);
  EXPECT_EQ(report.vertices, 4000u);
  EXPECT_EQ(report.bytes, std::filesystem::file_size(directory / "boxes.ply"));
  ConvertOptions options;
  options.pictures = false;
  const ConvertReport converted = convert(directory / "boxes.ply", directory / "site", options);
  EXPECT_EQ(converted.elements.triangles, 6000u);
  EXPECT_EQ(converted.weld.mergedPositions, 0u);
  EXPECT_TRUE(verify(directory / "site", directory / "boxes.ply").equal);
  writeSampleBoxes(500, 1, true, directory / "shuffled.ply");
  EXPECT_EQ(std::filesystem::file_size(directory / "shuffled.ply"), report.bytes);
  EXPECT_NE(readFile(directory / "shuffled.ply"), readFile(directory / "boxes.ply"));
  EXPECT_THROW(writeSampleBoxes(500, 1, false, directory / "boxes.glb"), Error);
}

TEST(SampleCloud, HasTheSamePointsInAnotherOrder) {
  const testing::TemporaryDirectory directory;
  const ExportReport report = writeSampleCloud(600, false, directory / "cloud.ply");
  EXPECT_EQ(report.elements.points, 600u);
  EXPECT_EQ(report.bytes, std::filesystem::file_size(directory / "cloud.ply"));
  writeSampleCloud(600, true, directory / "shuffled.ply");
  const auto records = [&](const char* name) {
    const std::string text(asText(readFile(directory / name)));
    std::multiset<std::string> all;
    for (std::size_t at = text.find("end_header\n") + 11; at < text.size(); at += 18)
      all.insert(text.substr(at, 18));
    return all;
  };
  EXPECT_EQ(records("cloud.ply"), records("shuffled.ply"));
  EXPECT_EQ(records("cloud.ply").size(), 600u);
  EXPECT_THROW(writeSampleCloud(600, false, directory / "cloud.glb"), Error);
}

TEST(SampleRelief, IsScatteredByABijection) {
  for (const std::uint64_t count : {1u, 2u, 17u, 1000u, 4096u}) {
    const Scattering scattering(count, 3);
    std::set<std::uint64_t> values;
    for (std::uint64_t i = 0; i < count; ++i) {
      EXPECT_EQ(scattering.inverse(scattering.of(i)), i);
      values.insert(scattering.of(i));
    }
    EXPECT_EQ(values.size(), count);
    EXPECT_LT(*values.rbegin(), count);
  }
}

} // namespace
} // namespace imgeo
