#include "prepare/weld.h"

#include "scene/testing.h"

#include <gtest/gtest.h>
#include <set>
#include <tuple>

namespace imgeo {
namespace {

using testing::randomMesh;

/// The value of a corner: position and attributes, which welding must keep.
auto valueOf(const Mesh& mesh, std::size_t corner) {
  const std::uint32_t wedge = mesh.corners[corner];
  const Vec3f p = mesh.cornerPosition(corner) + Vec3f{}; // -0 becomes 0
  const Vec3f n = (mesh.normals.empty() ? Vec3f{} : mesh.normals[wedge]) + Vec3f{};
  const Vec2f t = mesh.texCoords.empty() ? Vec2f{} : mesh.texCoords[wedge];
  const Rgba c = mesh.colors.empty() ? Rgba{} : mesh.colors[wedge];
  std::vector<float> named;
  for (const NamedAttribute& attribute : mesh.namedAttributes)
    for (std::uint32_t i = 0; i < attribute.components; ++i)
      named.push_back(attribute.values[wedge * attribute.components + i] + 0.0f);
  return std::tuple(p.x, p.y, p.z, n.x, n.y, n.z, t.x + 0.0f, t.y + 0.0f, c.r, c.g, c.b, c.a, named);
}

std::vector<decltype(valueOf(Mesh{}, 0))> valuesOf(const Mesh& mesh) {
  std::vector<decltype(valueOf(mesh, 0))> values;
  for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner)
    values.push_back(valueOf(mesh, corner));
  return values;
}

TEST(Weld, KeepsTheValueOfEveryCorner) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    Mesh mesh = randomMesh(seed);
    const auto before = valuesOf(mesh);
    weld(mesh);
    ASSERT_TRUE(isConsistent(mesh)) << seed;
    EXPECT_TRUE(valuesOf(mesh) == before) << seed;
  }
}

TEST(Weld, LeavesNoEqualAndNoUnusedPositionsOrWedges) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    Mesh mesh = randomMesh(seed);
    const WeldReport report = weld(mesh);
    std::set<std::tuple<float, float, float>> positions;
    for (const Vec3f& p : mesh.positions)
      positions.insert({p.x, p.y, p.z});
    EXPECT_EQ(positions.size(), mesh.positions.size()) << seed;
    const auto values = valuesOf(mesh);
    EXPECT_EQ(std::set(values.begin(), values.end()).size(), mesh.wedgeCount()) << seed;
    EXPECT_EQ(report.mergedPositions + report.unreferencedPositions + mesh.positions.size(),
              randomMesh(seed).positions.size());
  }
}

TEST(Weld, KeepsTheOrderOfFirstUse) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    Mesh mesh = randomMesh(seed);
    weld(mesh);
    std::uint32_t wedges = 0, positions = 0;
    for (const std::uint32_t wedge : mesh.corners) {
      ASSERT_LE(wedge, wedges);
      wedges = std::max(wedges, wedge + 1);
      ASSERT_LE(mesh.wedgePositions[wedge], positions);
      positions = std::max(positions, mesh.wedgePositions[wedge] + 1);
    }
  }
}

TEST(Weld, DoesNothingTheSecondTime) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    Mesh mesh = randomMesh(seed);
    const WeldReport first = weld(mesh);
    const Mesh once = mesh;
    const WeldReport second = weld(mesh);
    EXPECT_EQ(mesh.positions, once.positions);
    EXPECT_EQ(mesh.wedgePositions, once.wedgePositions);
    EXPECT_EQ(mesh.corners, once.corners);
    EXPECT_EQ(mesh.normals, once.normals);
    EXPECT_EQ(second.mergedPositions + second.mergedWedges + second.unreferencedPositions, 0u);
    EXPECT_EQ(second.degenerateElements, first.degenerateElements);
    EXPECT_EQ(second.duplicateElements, first.duplicateElements);
  }
}

TEST(Weld, MergesEqualBitsOnly) {
  Mesh mesh;
  const float next = std::nextafter(1.0f, 2.0f);
  mesh.positions = {{1, 0, 0}, {1, -0.0f, 0}, {next, 0, 0}, {0, 1, 0}, {7, 7, 7}};
  testing::addPlainWedges(mesh);
  testing::addTriangle(mesh, 0, 2, 3);
  testing::addTriangle(mesh, 3, 1, 2); // the same triangle, rotated, with the merged position
  testing::addTriangle(mesh, 0, 1, 2); // degenerate
  const WeldReport report = weld(mesh);
  EXPECT_EQ(mesh.positions, (std::vector<Vec3f>{{1, 0, 0}, {next, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.corners, (std::vector<std::uint32_t>{0, 1, 2, 2, 0, 1, 0, 0, 1}));
  EXPECT_EQ(report.mergedPositions, 1u);
  EXPECT_EQ(report.mergedWedges, 1u);
  EXPECT_EQ(report.unreferencedPositions, 1u);
  EXPECT_EQ(report.degenerateElements, 1u);
  EXPECT_EQ(report.duplicateElements, 1u);
}

TEST(Weld, KeepsTheWedgesOfACreaseAtOnePosition) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 1}};
  mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}, {1, 0, 0}};
  testing::addPlainWedges(mesh);
  testing::addTriangle(mesh, 0, 1, 2);
  testing::addTriangle(mesh, 3, 2, 4);
  weld(mesh);
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(mesh.wedgeCount(), 5u);
  EXPECT_EQ(mesh.wedgePositions[3], 0u);
}

TEST(Weld, CountsRepeatedElementsWhateverTheirFirstCorner) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    Mesh mesh = randomMesh(seed);
    const WeldReport report = weld(mesh);
    const std::uint32_t count = cornersPerElement(mesh.topology);
    std::set<std::vector<std::uint32_t>> distinct;
    for (std::size_t first = 0; first < mesh.corners.size(); first += count) {
      std::vector<std::uint32_t> corners(&mesh.corners[first], &mesh.corners[first] + count), smallest = corners;
      for (std::uint32_t turn = 1; turn < count; ++turn) {
        std::rotate(corners.begin(), corners.begin() + 1, corners.end());
        smallest = std::min(smallest, corners);
      }
      distinct.insert(smallest);
    }
    EXPECT_EQ(report.duplicateElements, mesh.elementCount() - distinct.size()) << seed;
  }
}

/// The values of each element's corners, rotated so that the smallest comes first.
auto elementsOf(const Mesh& mesh) {
  const std::uint32_t count = cornersPerElement(mesh.topology);
  std::vector<std::vector<decltype(valueOf(mesh, 0))>> elements;
  for (std::size_t element = 0; element < mesh.elementCount(); ++element) {
    auto& corners = elements.emplace_back();
    for (std::uint32_t i = 0; i < count; ++i)
      corners.push_back(valueOf(mesh, element * count + i));
    auto turned = corners;
    for (std::uint32_t i = 0; i < count; ++i) {
      std::rotate(turned.begin(), turned.begin() + 1, turned.end());
      corners = std::min(corners, turned);
    }
  }
  return elements;
}

TEST(Weld, DropsDegenerateAndRepeatedElementsOnRequestAndKeepsTheOrderOfTheRest) {
  std::size_t degenerates = 0, repeats = 0;
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    Mesh kept = randomMesh(seed);
    const WeldReport found = weld(kept);
    degenerates += found.degenerateElements;
    repeats += found.duplicateElements;
    for (const DroppedElements dropped :
         {DroppedElements{true, false}, DroppedElements{false, true}, DroppedElements{true, true}}) {
      auto expected = elementsOf(kept);
      if (dropped.repeated) {
        std::set<decltype(expected)::value_type> seen;
        std::erase_if(expected, [&](const auto& corners) { return !seen.insert(corners).second; });
      }
      if (dropped.degenerate)
        std::erase_if(expected, [&](const auto& corners) {
          std::set<std::tuple<float, float, float>> positions;
          for (const auto& corner : corners)
            positions.insert({std::get<0>(corner), std::get<1>(corner), std::get<2>(corner)});
          return positions.size() < corners.size();
        });
      Mesh mesh = randomMesh(seed);
      const WeldReport report = weld(mesh, dropped);
      ASSERT_TRUE(isConsistent(mesh)) << seed;
      EXPECT_TRUE(elementsOf(mesh) == expected) << seed;
      EXPECT_EQ(report.degenerateElements, found.degenerateElements);
      EXPECT_EQ(report.duplicateElements, found.duplicateElements);
      EXPECT_EQ(report.mergedPositions + report.unreferencedPositions + mesh.positions.size(),
                randomMesh(seed).positions.size());
      const WeldReport again = weld(mesh);
      EXPECT_EQ(again.unreferencedPositions + again.mergedPositions + again.mergedWedges, 0u);
    }
  }
  EXPECT_GT(degenerates, 20u);
  EXPECT_GT(repeats, 20u);
}

} // namespace
} // namespace imgeo
