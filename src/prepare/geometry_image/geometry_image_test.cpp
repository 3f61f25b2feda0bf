#include "prepare/geometry_image/geometry_image.h"

#include "base/narrow.h"
#include "prepare/geometry_image/surface_distance.h"
#include "prepare/normals.h"
#include "prepare/weld.h"
#include "scene/testing.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace imgeo {
namespace {

constexpr std::uint32_t maxEdge = 2048;

/// A sheet of n x n vertices over the unit square with heights, normals and texture coordinates. Its front is +z.
Mesh sheet(std::uint32_t n, double height) {
  Mesh mesh;
  const auto share = [&](std::uint32_t i) { return static_cast<float>(i) / static_cast<float>(n - 1); };
  for (std::uint32_t row = 0; row < n; ++row)
    for (std::uint32_t column = 0; column < n; ++column) {
      const float x = share(column), y = 1 - share(row);
      mesh.positions.push_back({x, y, static_cast<float>(height * std::sin(5 * x) * std::cos(4 * y))});
      mesh.texCoords.push_back({x, y});
    }
  testing::addPlainWedges(mesh);
  for (std::uint32_t row = 0; row + 1 < n; ++row)
    for (std::uint32_t column = 0; column + 1 < n; ++column) {
      const std::uint32_t here = row * n + column;
      testing::addTriangle(mesh, here, here + n, here + 1);
      testing::addTriangle(mesh, here + n, here + n + 1, here + 1);
    }
  computeNormals(mesh, NormalWeighting::area);
  return mesh;
}

/// A box with a normal and texture coordinates for each face, each divided into n x n squares; n is a power of two.
Mesh box(std::uint32_t n) {
  Mesh mesh;
  for (std::uint32_t face = 0; face < 6; ++face) {
    const int axis = static_cast<int>(face / 2);
    const float side = face % 2 == 0 ? -1 : 1;
    for (std::uint32_t row = 0; row <= n; ++row)
      for (std::uint32_t column = 0; column <= n; ++column) {
        const float u = 2 * static_cast<float>(column) / static_cast<float>(n) - 1,
                    v = 2 * static_cast<float>(row) / static_cast<float>(n) - 1;
        Vec3f position, normal;
        position[axis] = side;
        position[(axis + 1) % 3] = u * side;
        position[(axis + 2) % 3] = v;
        normal[axis] = side;
        mesh.positions.push_back(position + Vec3f{});
        mesh.normals.push_back(normal);
        mesh.texCoords.push_back({u, v});
      }
    const std::uint32_t first = face * (n + 1) * (n + 1);
    for (std::uint32_t row = 0; row < n; ++row)
      for (std::uint32_t column = 0; column < n; ++column) {
        const std::uint32_t here = first + row * (n + 1) + column;
        testing::addTriangle(mesh, here, here + 1, here + n + 2);
        testing::addTriangle(mesh, here, here + n + 2, here + n + 1);
      }
  }
  testing::addPlainWedges(mesh);
  weld(mesh);
  return mesh;
}

/// A torus whose texture coordinates have a seam along both of its circles.
Mesh seamedTorus(std::uint32_t around, std::uint32_t across) {
  Mesh mesh;
  for (std::uint32_t i = 0; i <= around; ++i)
    for (std::uint32_t j = 0; j <= across; ++j) {
      const double a = 2 * std::numbers::pi * (i % around) / around, b = 2 * std::numbers::pi * (j % across) / across;
      const double radius = 2 + std::cos(b);
      mesh.positions.push_back(Vec3f(Vec3d{radius * std::cos(a), radius * std::sin(a), std::sin(b)}));
      mesh.normals.push_back(Vec3f(Vec3d{std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b)}));
      mesh.texCoords.push_back(
          {static_cast<float>(i) / static_cast<float>(around), static_cast<float>(j) / static_cast<float>(across)});
    }
  testing::addPlainWedges(mesh);
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const std::uint32_t here = i * (across + 1) + j, next = here + across + 1;
      testing::addTriangle(mesh, here, next, next + 1);
      testing::addTriangle(mesh, here, next + 1, here + 1);
    }
  weld(mesh);
  return mesh;
}

/// The triangles of grids as a mesh: two for each cell, divided from its lower left to its upper right vertex, without
/// those whose corners are not at three points.
Mesh meshOf(std::span<const GeometryImage> images) {
  Mesh mesh;
  for (const GeometryImage& image : images) {
    const auto first = narrow<std::uint32_t>(mesh.positions.size());
    append(mesh, mesh.wedgePositions.size(), image, image.positions.size());
    for (const Vec3f& position : image.positions) {
      mesh.wedgePositions.push_back(narrow<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(position);
    }
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      const Vec3f &p = image.positions[a], &q = image.positions[b], &r = image.positions[c];
      if (p != q && q != r && r != p)
        mesh.corners.insert(mesh.corners.end(), {first + a, first + b, first + c});
    };
    for (std::uint32_t row = 0; row + 1 < image.rows; ++row)
      for (std::uint32_t column = 0; column + 1 < image.columns; ++column) {
        const std::uint32_t here = row * image.columns + column, below = here + image.columns;
        add(here, below, here + 1);
        add(below, below + 1, here + 1);
      }
  }
  return mesh;
}

Mesh welded(std::span<const GeometryImage> images) {
  Mesh mesh = meshOf(images);
  weld(mesh);
  return mesh;
}

/// The number of edges that have a triangle on one side alone.
std::size_t openEdges(const Mesh& mesh) {
  std::vector<std::uint32_t> corners;
  for (const std::uint32_t wedge : mesh.corners)
    corners.push_back(mesh.wedgePositions[wedge]);
  return static_cast<std::size_t>(std::ranges::count(oppositeHalfEdges(corners), noHalfEdge));
}

double volumeOf(const Mesh& mesh) {
  double volume = 0;
  for (std::size_t c = 0; c < mesh.corners.size(); c += 3)
    volume += dot(Vec3d(mesh.cornerPosition(c)),
                  cross(Vec3d(mesh.cornerPosition(c + 1)), Vec3d(mesh.cornerPosition(c + 2)))) /
              6;
  return volume;
}

double diagonalOf(const Mesh& mesh) {
  return length(boxOf(mesh).size());
}

TEST(Charts, FollowTheSeamsOfTextureCoordinatesAndCreases) {
  EXPECT_EQ(chartsOf(sheet(9, 0.2)).size(), 1u);
  EXPECT_EQ(chartsOf(box(4)).size(), 6u);
  Mesh onlyNormals = box(4);
  onlyNormals.texCoords.clear();
  EXPECT_EQ(chartsOf(onlyNormals).size(), 6u);
  onlyNormals.normals.clear();
  EXPECT_EQ(chartsOf(onlyNormals).size(), 1u);
  const std::vector<Chart> torus = chartsOf(seamedTorus(12, 8));
  ASSERT_EQ(torus.size(), 1u);
  EXPECT_TRUE(isDisk(torus[0])); // the seams open it
}

TEST(Charts, AreDividedIntoConnectedHalvesWithAllTriangles) {
  const Mesh mesh = testing::sphere(12, 20);
  const Chart whole = chartsOf(mesh).at(0);
  EXPECT_FALSE(isDisk(whole));
  const auto [a, b] = divide(mesh, whole);
  EXPECT_TRUE(isDisk(a));
  EXPECT_TRUE(isDisk(b));
  std::set<std::uint32_t> triangles(a.triangles.begin(), a.triangles.end());
  triangles.insert(b.triangles.begin(), b.triangles.end());
  EXPECT_EQ(triangles.size(), mesh.elementCount());
  EXPECT_EQ(boundaryOf(a).size(), boundaryOf(b).size());
  EXPECT_NEAR(static_cast<double>(a.triangleCount()), static_cast<double>(b.triangleCount()),
              0.2 * static_cast<double>(mesh.elementCount()));
}

TEST(DiskEmbedding, KeepsTheOrientationOfEveryTriangle) {
  const Mesh mesh = testing::sphere(10, 16);
  for (const Chart& chart : divide(mesh, chartsOf(mesh).at(0))) {
    const DiskMesh disk = diskMeshOf(mesh, chart);
    std::vector<Vec2d> border;
    for (std::size_t i = 0; i < disk.boundary.size(); ++i)
      border.push_back(borderPoint(4.0 * static_cast<double>(i) / static_cast<double>(disk.boundary.size()), {1, 1}));
    const DiskEmbedding embedding = embed(disk, border);
    EXPECT_LT(embedding.stretch, 1.6);
    for (std::size_t c = 0; c < disk.corners.size(); c += 3) {
      const Vec2d p = embedding.points[disk.corners[c]], q = embedding.points[disk.corners[c + 1]],
                  r = embedding.points[disk.corners[c + 2]];
      // Rows run downwards: counterclockwise triangles have negative areas there.
      EXPECT_LT((q.x - p.x) * (r.y - p.y) - (r.x - p.x) * (q.y - p.y), 0);
    }
  }
}

TEST(DiskEmbedding, OfAFlatSheetIsTheSheet) {
  Mesh mesh = sheet(9, 0);
  mesh.texCoords.clear();
  const std::vector<ParametrisedChart> charts = parametrise(mesh);
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_FALSE(charts[0].keepsTexCoords);
  EXPECT_NEAR(charts[0].embedding.stretch, 1, 1e-6);
  EXPECT_NEAR(charts[0].aspect, 1, 1e-6);
}

TEST(GeometryImage, OfAGridOfTheSameSizeHasItsVertices) {
  const Mesh mesh = sheet(17, 0.3);
  const std::vector<ParametrisedChart> charts = parametrise(mesh);
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_TRUE(charts[0].keepsTexCoords);
  const std::vector<GeometryImage> images = geometryImages(mesh, charts, 17, maxEdge);
  ASSERT_EQ(images.size(), 1u);
  ASSERT_EQ(images[0].columns, 17u);
  ASSERT_EQ(images[0].rows, 17u);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_LT(length(Vec3d(images[0].positions[i]) - Vec3d(mesh.positions[i])), 1e-6) << i;
    EXPECT_NEAR(images[0].texCoords[i].x, mesh.texCoords[i].x, 1e-6);
    EXPECT_NEAR(images[0].texCoords[i].y, mesh.texCoords[i].y, 1e-6);
  }
  EXPECT_LT(distanceBetween(mesh, welded(images)).largest, 1e-6);
}

TEST(GeometryImage, OfABoxIsTheBoxOnEveryGrid) {
  const Mesh mesh = box(4);
  const std::vector<ParametrisedChart> charts = parametrise(mesh);
  for (const std::uint32_t grid : {8u, 20u, 47u}) {
    const Mesh sampled = welded(geometryImages(mesh, charts, grid, maxEdge));
    EXPECT_LT(distanceBetween(mesh, sampled).largest, 1e-6) << grid;
    EXPECT_EQ(openEdges(sampled), 0u) << grid;
    EXPECT_NEAR(volumeOf(sampled), 8, 1e-5) << grid;
  }
}

TEST(GeometryImage, OfAClosedSurfaceIsClosed) {
  const std::vector<Mesh> meshes{testing::sphere(12, 20), testing::sphere(3, 5), seamedTorus(24, 12),
                                 seamedTorus(7, 5)};
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const std::vector<ParametrisedChart> charts = parametrise(meshes[i]);
    double before = 1;
    for (const std::uint32_t grid : {16u, 50u}) {
      const std::vector<GeometryImage> images = geometryImages(meshes[i], charts, grid, maxEdge);
      const Mesh sampled = welded(images);
      EXPECT_EQ(openEdges(sampled), 0u) << i << " " << grid;
      const double largest = distanceBetween(meshes[i], sampled).largest / diagonalOf(meshes[i]);
      EXPECT_LT(largest, before) << i << " " << grid;
      before = largest;
      for (const GeometryImage& image : images)
        for (const Vec3f& normal : image.normals)
          ASSERT_NEAR(length(normal), 1, 1e-5);
    }
    const Mesh fine = welded(geometryImages(meshes[i], charts, 50, maxEdge));
    EXPECT_NEAR(volumeOf(fine), volumeOf(meshes[i]), 0.01 * volumeOf(meshes[i])) << i;
  }
}

TEST(GeometryImage, InterpolatesAttributesInTheTriangles) {
  Mesh mesh = sheet(6, 0);
  mesh.namedAttributes.push_back({"x", 1, {}});
  for (const Vec3f& position : mesh.positions) {
    mesh.namedAttributes[0].values.push_back(position.x);
    const auto level = static_cast<std::uint8_t>(std::lround(position.y * 255));
    mesh.colors.push_back(Rgba8{level, level, level, 255});
  }
  for (const GeometryImage& image : geometryImages(mesh, parametrise(mesh), 23, maxEdge))
    for (std::size_t i = 0; i < image.positions.size(); ++i) {
      const Vec3f position = image.positions[i];
      EXPECT_NEAR(image.texCoords[i].x, position.x, 1e-6);
      EXPECT_NEAR(image.texCoords[i].y, position.y, 1e-6);
      EXPECT_NEAR(image.namedAttributes[0].values[i], position.x, 1e-6);
      EXPECT_NEAR(image.colors[i].g, position.y, 0.5 / 255 + 1e-6);
    }
}

TEST(GeometryImage, OfRandomTrianglesIsFiniteAndInTheirBox) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    Mesh mesh = testing::randomMesh(seed);
    if (mesh.topology != Topology::triangles)
      continue;
    weld(mesh);
    const std::vector<ParametrisedChart> charts = parametrise(mesh);
    const Box3d box = boxOf(mesh);
    for (const GeometryImage& image : geometryImages(mesh, charts, 24, maxEdge)) {
      EXPECT_TRUE(isConsistent(image, std::size_t{image.columns} * image.rows)) << seed;
      for (const Vec3f& position : image.positions)
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_GE(position[axis], box.min[axis] - 1e-5) << seed;
          EXPECT_LE(position[axis], box.max[axis] + 1e-5) << seed;
        }
    }
  }
}

TEST(GeometryImage, OfAPocketThatOpensAtOneEdgeIsThePocket) {
  // Two triangles back to back: a crease at one edge, and normals that are continuous at the vertex opposite to it.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.wedgePositions = {0, 1, 2, 0, 1};
  mesh.normals = {{0, 0, 1}, {0, 0, 1}, {1, 0, 0}, {0, 0, -1}, {0, 0, -1}};
  testing::addTriangle(mesh, 0, 1, 2);
  testing::addTriangle(mesh, 4, 3, 2);
  ASSERT_EQ(chartsOf(mesh).size(), 1u);
  const std::vector<GeometryImage> images = geometryImages(mesh, parametrise(mesh), 16, maxEdge);
  EXPECT_LT(distanceBetween(mesh, welded(images)).largest, 1e-6);
}

TEST(GeometryImage, HasEqualBytesOnEveryRun) {
  const Mesh mesh = testing::sphere(9, 14);
  const auto sample = [&] { return geometryImages(mesh, parametrise(mesh), 40, maxEdge); };
  const std::vector<GeometryImage> one = sample(), other = sample();
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    EXPECT_TRUE(one[i].positions == other[i].positions && one[i].normals == other[i].normals);
}

TEST(SurfaceDistance, OfParallelSheetsIsTheirDistance) {
  const Mesh mesh = sheet(5, 0);
  Mesh moved = mesh;
  for (Vec3f& position : moved.positions)
    position.z += 0.25f;
  const SurfaceDistance distance = distanceBetween(mesh, moved);
  EXPECT_NEAR(distance.largest, 0.25, 1e-7);
  EXPECT_NEAR(distance.mean, 0.25, 1e-7);
  EXPECT_EQ(distanceBetween(mesh, mesh).largest, 0);
}

TEST(SurfaceDistance, SeesAMissingPieceFromEitherSide) {
  const Mesh mesh = sheet(11, 0);
  Mesh half = mesh;
  half.corners.resize(half.corners.size() / 2);
  for (const SurfaceDistance& distance : {distanceBetween(mesh, half), distanceBetween(half, mesh)}) {
    EXPECT_NEAR(distance.largest, 0.5, 1e-6);
    EXPECT_NEAR(distance.mean, 0.125, 1e-2);
  }
}

TEST(SurfaceDistance, FromDegenerateTrianglesIsThatFromTheirEdges) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  testing::addPlainWedges(mesh);
  testing::addTriangle(mesh, 0, 1, 2);
  Mesh point;
  point.positions = {{1.5f, 2, 0}, {1.5f, 2, 0.5f}, {1.5f, 2, 1}};
  testing::addPlainWedges(point);
  testing::addTriangle(point, 0, 1, 2);
  EXPECT_NEAR(distanceBetween(mesh, point).largest, std::hypot(1.5, 2.0), 1e-6);
}

} // namespace
} // namespace imgeo
