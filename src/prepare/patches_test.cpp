#include "prepare/patches.h"

#include "prepare/weld.h"

#include "base/parallel.h"
#include "scene/testing.h"

#include <gtest/gtest.h>
#include <set>
#include <tuple>

namespace imgeo {
namespace {

/// The values of an element's corners, which division into patches must keep.
template <typename MeshOrPatch>
std::vector<double> elementOf(const MeshOrPatch& source, const std::vector<Vec3u>& positions, std::size_t element) {
  std::vector<double> value;
  const std::size_t count = cornersPerElement(source.topology);
  for (std::size_t corner = element * count; corner < (element + 1) * count; ++corner) {
    const std::uint32_t wedge = source.corners[corner];
    const Vec3u p = positions[source.wedgePositions[wedge]];
    value.insert(value.end(), {double(p.x), double(p.y), double(p.z)});
    if (!source.normals.empty())
      value.insert(value.end(), {source.normals[wedge].x, source.normals[wedge].y, source.normals[wedge].z});
    if (!source.texCoords.empty())
      value.insert(value.end(), {source.texCoords[wedge].x, source.texCoords[wedge].y});
    if (!source.colors.empty())
      value.insert(value.end(), {double(source.colors[wedge].r), double(source.colors[wedge].a)});
  }
  return value;
}

template <typename MeshOrPatch>
void addElements(std::multiset<std::vector<double>>& into, const MeshOrPatch& source,
                 const std::vector<Vec3u>& positions) {
  for (std::size_t element = 0; element < source.elementCount(); ++element)
    into.insert(elementOf(source, positions, element));
}

PatchedMesh cut(const Mesh& mesh, std::uint32_t maxWedges) {
  return cutIntoPatches(mesh, latticeFor(boxOf(mesh), 16), maxWedges);
}

void expectWellFormed(const Patch& patch, std::uint32_t maxWedges) {
  EXPECT_GT(patch.elementCount(), 0u);
  EXPECT_LE(patch.wedgeCount(), maxWedges);
  std::vector<bool> wedges(patch.wedgeCount()), positions(patch.positions.size());
  for (const std::uint32_t wedge : patch.corners)
    wedges.at(wedge) = true;
  for (const std::uint32_t position : patch.wedgePositions)
    positions.at(position) = true;
  EXPECT_EQ(std::count(wedges.begin(), wedges.end(), true), static_cast<std::ptrdiff_t>(patch.wedgeCount()));
  EXPECT_EQ(std::count(positions.begin(), positions.end(), true), static_cast<std::ptrdiff_t>(patch.positions.size()));
}

TEST(Patches, ContainEveryElementOnce) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    Mesh mesh = testing::randomMesh(seed);
    weld(mesh);
    std::multiset<std::vector<double>> expected, found;
    addElements(expected, mesh, quantise(mesh.positions, latticeFor(boxOf(mesh), 16)));
    const std::uint32_t maxWedges = 3 + seed % 50;
    const PatchedMesh result = cut(mesh, maxWedges);
    for (const Patch& patch : result.patches) {
      expectWellFormed(patch, maxWedges);
      addElements(found, patch, patch.positions);
    }
    EXPECT_TRUE(found == expected) << seed;
  }
}

TEST(Patches, MayContainLines) {
  Mesh mesh = testing::grid(20);
  mesh.topology = Topology::lines;
  std::multiset<std::vector<double>> expected, found;
  addElements(expected, mesh, quantise(mesh.positions, latticeFor(boxOf(mesh), 16)));
  for (const Patch& patch : cut(mesh, 40).patches)
    addElements(found, patch, patch.positions);
  EXPECT_TRUE(found == expected);
}

TEST(Patches, TogetherHaveTheLatticePositionsOfTheMesh) {
  const Mesh mesh = testing::torus(60, 60);
  std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> expected, found;
  for (const Vec3u& p : quantise(mesh.positions, latticeFor(boxOf(mesh), 16)))
    expected.insert({p.x, p.y, p.z});
  std::size_t positionCount = 0;
  for (const Patch& patch : cut(mesh, 300).patches)
    for (const Vec3u& p : patch.positions) {
      found.insert({p.x, p.y, p.z});
      ++positionCount;
    }
  EXPECT_TRUE(found == expected);
  EXPECT_GT(positionCount, expected.size());
}

TEST(Patches, AreWellFilledAndTight) {
  const Mesh mesh = testing::grid(255); // 65,536 wedges: one too many for one patch of 65,535
  for (const std::uint32_t maxWedges : {65535u, 24000u, 10000u, 3000u}) {
    const PatchedMesh result = cut(mesh, maxWedges);
    EXPECT_LE(result.patches.size(), (mesh.wedgeCount() / maxWedges + 1) * 5 / 4 + 1) << maxWedges;
    Box3d whole;
    for (const Patch& patch : result.patches) {
      const Box3d box = boxOf(patch, result.lattice);
      whole.add(box.min);
      whole.add(box.max);
      // A patch's share of the area matches its share of the elements.
      const double area = box.size().x * box.size().y;
      EXPECT_LT(area, 1.3 * static_cast<double>(patch.elementCount()) / static_cast<double>(mesh.elementCount()));
    }
    EXPECT_EQ(whole, result.box);
  }
}

TEST(Patches, AreMadeEvenIfAllCentroidsAreEqual) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 3000;
    for (int corner = 0; corner < 3; ++corner) {
      const double a = angle + corner * 2 * std::numbers::pi / 3;
      mesh.positions.push_back({static_cast<float>(std::round(1e4 * std::cos(a))), 0, static_cast<float>(corner)});
      mesh.corners.push_back(3 * i + static_cast<std::uint32_t>(corner));
    }
  }
  testing::addPlainWedges(mesh);
  for (const Patch& patch : cut(mesh, 100).patches)
    expectWellFormed(patch, 100);

  Mesh duplicates;
  duplicates.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  testing::addPlainWedges(duplicates);
  for (int i = 0; i < 1'400'000; ++i)
    testing::addTriangle(duplicates, 0, 1, 2);
  const PatchedMesh result = cut(duplicates, 65535);
  EXPECT_EQ(result.patches.size(), 2u);
  for (const Patch& patch : result.patches)
    EXPECT_LE(patch.corners.size(), maxPatchCorners);
}

TEST(Patches, AreMadeEvenIfAllTrianglesShareOneVertex) {
  Mesh mesh;
  mesh.positions.push_back({0, 0, 1});
  const std::uint32_t rim = 100000;
  for (std::uint32_t i = 0; i < rim; ++i) {
    const double angle = 2 * std::numbers::pi * i / rim;
    mesh.positions.push_back(Vec3f(Vec3d{std::cos(angle), std::sin(angle), 0}));
    testing::addTriangle(mesh, 0, 1 + i, 1 + (i + 1) % rim);
  }
  testing::addPlainWedges(mesh);
  const PatchedMesh result = cut(mesh, 20000);
  EXPECT_LE(result.patches.size(), 7u);
  std::size_t elements = 0;
  for (const Patch& patch : result.patches) {
    expectWellFormed(patch, 20000);
    elements += patch.elementCount();
  }
  EXPECT_EQ(elements, rim);
}

TEST(Patches, AreNoneForAnEmptyMesh) {
  EXPECT_TRUE(cut(Mesh{}, 100).patches.empty());
  EXPECT_TRUE(cut(Mesh{}, 100).box.empty());
}

TEST(Patches, DoNotDependOnThreads) {
  const Mesh mesh = testing::torus(200, 200);
  limitThreads(1);
  const PatchedMesh one = cut(mesh, 3000);
  limitThreads(0);
  const PatchedMesh many = cut(mesh, 3000);
  ASSERT_EQ(one.patches.size(), many.patches.size());
  for (std::size_t i = 0; i < one.patches.size(); ++i) {
    EXPECT_EQ(one.patches[i].positions, many.patches[i].positions);
    EXPECT_EQ(one.patches[i].corners, many.patches[i].corners);
    EXPECT_EQ(one.patches[i].texCoords, many.patches[i].texCoords);
  }
}

} // namespace
} // namespace imgeo
