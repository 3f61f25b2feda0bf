#include "containers/compact/patch_coding.h"

#include "base/error.h"
#include "containers/compact/code_normals.h"
#include "containers/compact/patch_samples.h"
#include "containers/stored.h"
#include "containers/unit_vectors.h"

#include <array>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <utility>

namespace imgeo::compact {
namespace {

/// The position and the attributes of a corner: what does not depend on its index.
using CornerValues = std::vector<std::int64_t>;
using ElementValues = std::vector<CornerValues>;

CornerValues cornerValues(const CompactPatch& patch, std::uint32_t wedge) {
  const Vec3u& at = patch.positions[patch.wedgePositions[wedge]];
  CornerValues values{at.x, at.y, at.z};
  for (const Attribute& attribute : patch.attributes)
    if (!attribute.type.isDerived())
      for (std::uint32_t i = 0; i < attribute.type.components; ++i)
        values.push_back(attribute.values[wedge][i]);
  return values;
}

/// The elements of a patch, sorted, so that two patches compare equal if only the orders of their elements and corners
/// differ. The corners of a triangle are rotated to the smallest of their three orders.
std::vector<ElementValues> elementsOf(const CompactPatch& patch) {
  const std::size_t count = cornersPerElement(patch.topology);
  std::vector<ElementValues> elements;
  for (std::size_t first = 0; first < patch.corners.size(); first += count) {
    ElementValues element;
    for (std::size_t i = 0; i < count; ++i)
      element.push_back(cornerValues(patch, patch.corners[first + i]));
    ElementValues smallest = element;
    for (std::size_t turn = 1; turn < count && count == 3; ++turn) {
      std::rotate(element.begin(), element.begin() + 1, element.end());
      smallest = std::min(smallest, element);
    }
    elements.push_back(smallest);
  }
  std::ranges::sort(elements);
  return elements;
}

Bytes bytesOf(const CompactPatch& patch, int effort = 0) {
  return encodePatches({&patch, 1}, effort).bytes;
}

void expectSamePatch(const CompactPatch& back, const CompactPatch& patch) {
  EXPECT_EQ(back.topology, patch.topology);
  EXPECT_EQ(back.positionBits, patch.positionBits);
  EXPECT_EQ(back.positions.size(), patch.positions.size());
  EXPECT_EQ(back.wedgeCount(), patch.wedgeCount());
  ASSERT_EQ(back.attributes.size(), patch.attributes.size());
  for (std::size_t i = 0; i < back.attributes.size(); ++i)
    EXPECT_EQ(back.attributes[i].type, patch.attributes[i].type);
  EXPECT_EQ(elementsOf(back), elementsOf(patch));
}

void expectDecodeEqual(const Bytes& bytes, std::span<const CompactPatch> patches) {
  const std::vector<CompactPatch> back = decodePatches(bytes, "x.png");
  ASSERT_EQ(back.size(), patches.size());
  for (std::size_t i = 0; i < back.size(); ++i)
    expectSamePatch(back[i], patches[i]);
}

void expectDecodeEqual(std::span<const CompactPatch> patches) {
  expectDecodeEqual(encodePatches(patches, 0).bytes, patches);
}

void expectDecodesEqual(const CompactPatch& patch) {
  expectDecodeEqual({&patch, 1});
}

TEST(Compact, DecodesRandomMeshes) {
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    AttributeBits bits{4 + seed % 13, 1 + seed % 16, 1 + seed % 8, static_cast<NormalMode>(seed / 2 % 4)};
    expectDecodesEqual(testing::patchOf(imgeo::testing::randomMesh(seed), 8 + seed % 23, bits));
    if (HasFailure())
      return;
  }
}

TEST(Compact, DecodesManyPatchesOfAFile) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    testing::Random random(seed);
    std::vector<CompactPatch> patches;
    for (std::uint32_t i = 0; i <= seed; ++i) {
      const AttributeBits bits{4 + i % 13, 1 + i % 16, 1 + i % 8, static_cast<NormalMode>(i / 2 % 4)};
      patches.push_back(testing::patchOf(imgeo::testing::randomMesh(random.below(400)), 8 + i % 5, bits));
    }
    expectDecodeEqual(patches);
    if (HasFailure())
      return;
  }
}

TEST(Compact, EncodesPatchesTogetherInFewerBytesThanAlone) {
  std::vector<CompactPatch> patches;
  std::size_t alone = 0;
  for (std::uint32_t i = 0; i < 200; ++i) {
    patches.push_back(testing::patchOf(imgeo::testing::sphere(3 + i % 5, 4 + i % 7), 16));
    alone += bytesOf(patches.back()).size();
  }
  EXPECT_LT(static_cast<double>(encodePatches(patches, 0).bytes.size()), 0.75 * static_cast<double>(alone));
}

/// The largest angle between a normal of a patch and the one that its corner decodes to, in radians. Positions tell
/// which corner it is: they are all different.
double largestNormalError(const CompactPatch& patch, const CompactPatch& decoded) {
  std::map<std::array<std::uint32_t, 3>, std::vector<Vec3f>> byPosition;
  for (std::size_t wedge = 0; wedge < decoded.wedgeCount(); ++wedge) {
    const Vec3u& at = decoded.positions[decoded.wedgePositions[wedge]];
    byPosition[{at.x, at.y, at.z}].push_back(unitNormal(directionOf(decoded.attributes.at(0).values[wedge])));
  }
  double largest = 0;
  for (std::size_t wedge = 0; wedge < patch.wedgeCount(); ++wedge) {
    const Vec3u& at = patch.positions[patch.wedgePositions[wedge]];
    double nearest = 4;
    for (const Vec3f& normal : byPosition.at({at.x, at.y, at.z}))
      nearest = std::min(nearest, angleBetween(normal, patch.attributes.at(0).sourceNormals[wedge]));
    largest = std::max(largest, nearest);
  }
  return largest;
}

TEST(Compact, StoresPredictedNormalsWithinTheBoundInFewerBytes) {
  const Mesh sphere = imgeo::testing::sphere(40, 60);
  for (const std::uint32_t bits : {5u, 8u, 12u}) {
    SCOPED_TRACE(bits);
    const CompactPatch exact = testing::patchOf(sphere, 16, {bits}),
                       tolerant = testing::tolerantPatchOf(sphere, 16, {bits});
    ASSERT_EQ(tolerant.attributes.at(0).sourceNormals.size(), tolerant.wedgeCount());
    const Bytes bytes = bytesOf(tolerant);
    EXPECT_LT(bytes.size(), bytesOf(exact).size());
    const CompactPatch decoded = decodePatches(bytes, "x.png").at(0);
    EXPECT_LE(largestNormalError(tolerant, decoded), octahedronErrorBound(bits));
  }
}

TEST(Compact, KeepsNormalsAtTheBorderOfAPatch) {
  // Half a sphere: its rim is the border.
  Mesh mesh = imgeo::testing::sphere(20, 30);
  std::vector<std::uint32_t> upper;
  for (std::size_t first = 0; first < mesh.corners.size(); first += 3) {
    const auto isUpper = [&](std::size_t i) {
      return mesh.positions[mesh.wedgePositions[mesh.corners[first + i]]].y > -0.01f;
    };
    if (isUpper(0) && isUpper(1) && isUpper(2))
      upper.insert(upper.end(), mesh.corners.begin() + static_cast<std::ptrdiff_t>(first),
                   mesh.corners.begin() + static_cast<std::ptrdiff_t>(first + 3));
  }
  mesh.corners = upper;
  const CompactPatch exact = testing::patchOf(mesh, 16, {8}), tolerant = testing::tolerantPatchOf(mesh, 16, {8});
  const CompactPatch decoded = decodePatches(bytesOf(tolerant), "x.png").at(0);
  std::set<std::vector<std::int64_t>> stored;
  for (std::uint32_t wedge = 0; wedge < decoded.wedgeCount(); ++wedge)
    stored.insert(cornerValues(decoded, wedge));
  const std::uint32_t rim = std::ranges::min(exact.positions, {}, &Vec3u::y).y;
  std::size_t atRim = 0, changed = 0;
  for (std::uint32_t wedge = 0; wedge < exact.wedgeCount(); ++wedge) {
    const bool isStored = stored.contains(cornerValues(exact, wedge));
    const bool isAtRim = exact.positions[exact.wedgePositions[wedge]].y == rim;
    EXPECT_TRUE(isStored || !isAtRim);
    atRim += isAtRim;
    changed += !isStored;
  }
  EXPECT_GE(atRim, 30u);
  EXPECT_GT(changed, 30u);
}

TEST(Compact, KeepsNormalsThatAreRoundedAlready) {
  CompactPatch patch = testing::patchOf(imgeo::testing::sphere(20, 30), 16, {8});
  Mesh rounded = imgeo::testing::sphere(20, 30);
  weld(rounded);
  ASSERT_EQ(patch.wedgeCount(), rounded.wedgeCount());
  for (std::size_t wedge = 0; wedge < rounded.wedgeCount(); ++wedge)
    rounded.normals[wedge] = unitNormal(directionOf(patch.attributes.at(0).values[wedge]));
  const CompactPatch again = testing::tolerantPatchOf(rounded, 16, {8});
  EXPECT_TRUE(again.attributes.at(0).sourceNormals.empty());
  expectDecodesEqual(again);
}

TEST(Compact, KeepsTheNormalsOfWedgesThatRoundToOneValue) {
  // Pairs of wedges at one vertex: their normals differ by less than rounding, on either side of the prediction.
  Mesh mesh = imgeo::testing::sphere(20, 30);
  mesh.texCoords.clear();
  const std::size_t count = mesh.wedgeCount();
  imgeo::testing::Random random(1);
  for (std::size_t wedge = 0; wedge < count; ++wedge) {
    mesh.wedgePositions.push_back(mesh.wedgePositions[wedge]);
    const auto turned = [&](const Vec3f& normal) { return unitNormal(Vec3d(normal) + Vec3d(random.point()) * 0.015); };
    mesh.normals.push_back(turned(mesh.normals[wedge]));
    mesh.normals[wedge] = turned(mesh.normals[wedge]);
  }
  for (std::uint32_t& corner : mesh.corners)
    if (random.oneIn(2))
      corner += static_cast<std::uint32_t>(count);
  const CompactPatch patch = testing::tolerantPatchOf(mesh, 16, {8});
  EXPECT_LE(largestNormalError(patch, decodePatches(bytesOf(patch), "x.png").at(0)), octahedronErrorBound(8));
}

/// An isosurface: each vertex is on an edge of a grid, between two of its points along one axis.
Mesh isosurface(std::uint32_t columns, std::uint32_t rows, double step) {
  Mesh mesh;
  testing::Random random(columns);
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column)
      mesh.positions.push_back({static_cast<float>(column * step), static_cast<float>(row * step),
                                static_cast<float>(step * (3 + random.below(1000) / 1000.0))});
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i)
    mesh.wedgePositions.push_back(i);
  for (std::uint32_t row = 0; row + 1 < rows; ++row)
    for (std::uint32_t column = 0; column + 1 < columns; ++column) {
      const std::uint32_t at = row * columns + column;
      imgeo::testing::addTriangle(mesh, at, at + 1, at + columns);
      imgeo::testing::addTriangle(mesh, at + 1, at + columns + 1, at + columns);
    }
  return mesh;
}

TEST(Compact, PredictsFromTheGridOfTheWholeMeshWhereAPatchHasTooFewLinesToFindIt) {
  // Three columns are fewer lines than a grid is found by.
  CompactPatch patch = testing::patchOf(isosurface(3, 60, 0.137), 16);
  const CompactPatch alone = patch;
  ASSERT_FALSE(findVertexGrid(patch.positions) && isWorthwhile(*findVertexGrid(patch.positions), patch.positions));
  const double step = 65535.0 / 59 * 65536;
  patch.grid = VertexGrid{{0, 0, 0},
                          {static_cast<std::uint32_t>(step + 0.5), static_cast<std::uint32_t>(step + 0.5), UINT32_MAX}};
  EXPECT_LT(bytesOf(patch).size(), bytesOf(alone).size());
  expectDecodesEqual(patch);

  patch.grid->step = {1 << 20, 1 << 20, 1 << 20}; // the grid of another mesh
  EXPECT_EQ(bytesOf(patch), bytesOf(alone));
}

TEST(Compact, TakesNoMoreBytesAtHighEffortAndDecodesEqual) {
  std::size_t bytesWithLowEffort = 0, bytesWithHighEffort = 0;
  for (const testing::Sample& sample : testing::files()) {
    SCOPED_TRACE(sample.name);
    std::size_t before = encodePatches(sample.patches, 5).bytes.size();
    bytesWithLowEffort += before;
    for (const int effort : {7, 8, 9}) {
      const Bytes bytes = encodePatches(sample.patches, effort).bytes;
      EXPECT_LE(bytes.size(), before) << effort;
      before = bytes.size();
      const std::vector<CompactPatch> back = decodePatches(bytes, "x.png");
      ASSERT_EQ(back.size(), sample.patches.size());
      for (std::size_t i = 0; i < back.size(); ++i)
        if (back[i].segmentCount == 0) { // positions of bases are rounded
          EXPECT_EQ(elementsOf(back[i]), elementsOf(sample.patches[i])) << effort;
        }
    }
    bytesWithHighEffort += before;
  }
  EXPECT_LT(bytesWithHighEffort, bytesWithLowEffort);
}

TEST(Compact, ListsTheAttributesOfPatchesWithoutDecodingThem) {
  for (const testing::Sample& sample : testing::files()) {
    const auto types = attributesOfPatches(encodePatches(sample.patches, 0).bytes, "x.png");
    ASSERT_EQ(types.size(), sample.patches.size());
    for (std::size_t i = 0; i < types.size(); ++i) {
      ASSERT_EQ(types[i].size(), sample.patches[i].attributes.size());
      for (std::size_t a = 0; a < types[i].size(); ++a)
        EXPECT_EQ(types[i][a], sample.patches[i].attributes[a].type);
    }
  }
}

/// A patch of triangles over `vertexCount` random points, all of which they use.
CompactPatch patchOver(std::uint32_t vertexCount, std::vector<std::uint32_t> corners) {
  testing::Random random(vertexCount);
  CompactPatch patch;
  for (std::uint32_t i = 0; i < vertexCount; ++i) {
    patch.positions.push_back({random.bits() >> 16, random.bits() >> 16, random.bits() >> 16});
    patch.wedgePositions.push_back(i);
  }
  patch.corners = std::move(corners);
  return patch;
}

struct Hostile {
  const char* name;
  CompactPatch patch;
  double maxBytesPerTriangle; ///< positions and connectivity
};

std::vector<Hostile> hostilePatches() {
  std::vector<Hostile> patches;
  std::vector<std::uint32_t> corners;
  const auto add = [&](const char* name, std::uint32_t vertexCount, double maxBytesPerTriangle) {
    patches.push_back({name, patchOver(vertexCount, std::exchange(corners, {})), maxBytesPerTriangle});
  };
  const auto addTriangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    corners.insert(corners.end(), {a, b, c});
  };
  testing::Random random(1);
  for (std::uint32_t i = 0; i < 60'000; ++i)
    addTriangle(0, 1 + i, 1 + (i + 1) % 60'000);
  add("a vertex of 60,000 triangles", 60'001, 6.4);
  for (std::uint32_t i = 0; i < 100'000; ++i)
    addTriangle(3 * i, 3 * i + 1, 3 * i + 2);
  add("100,000 triangles on their own", 300'000, 19);
  for (std::uint32_t i = 0; i < 15'000; ++i)
    for (const auto& [a, b, c] : {std::array{0u, 1u, 2u}, {0u, 2u, 3u}, {0u, 3u, 1u}, {1u, 3u, 2u}})
      addTriangle(4 * i + a, 4 * i + b, 4 * i + c);
  add("15,000 tetrahedra", 60'000, 6.4);
  for (std::uint32_t i = 0; i < 60'000; ++i)
    addTriangle(i % 50'000, random.below(50'000), random.below(50'000));
  add("triangles between any vertices", 50'000, 9.8);
  for (std::uint32_t edge = 0; edge < 2'000; ++edge)
    for (std::uint32_t i = 0; i < 20; ++i)
      addTriangle(22 * edge, 22 * edge + 1, 22 * edge + 2 + i);
  add("20 triangles at every edge", 44'000, 8.2);
  for (std::uint32_t i = 0; i < 60'000; ++i)
    addTriangle(0, 1, 2 + i % 30'000);
  add("60,000 triangles at one edge", 30'002, 7.5);
  for (std::uint32_t i = 0; i < 40'000; ++i)
    addTriangle(i % 3, (i + 1) % 3, (i + 2) % 3);
  add("one triangle, 40,000 times", 3, 0.75);
  for (std::uint32_t i = 0; i < 40'000; ++i)
    addTriangle(i, i, (i + 1) % 40'000);
  add("triangles without area", 40'000, 6.4);
  for (std::uint32_t y = 0; y < 150; ++y)
    for (std::uint32_t x = 0; x < 150; ++x) {
      const std::uint32_t at = y * 151 + x;
      addTriangle(at, at + 1, at + 152);
      addTriangle(at, at + 151, at + 152); // the other way around
    }
  add("neighbours of opposite orientation", 151 * 151, 5.1);
  return patches;
}

TEST(Compact, DecodesTrianglesThatFormNoSurface) {
  for (const Hostile& hostile : hostilePatches()) {
    SCOPED_TRACE(hostile.name);
    const Bytes encoded = bytesOf(hostile.patch);
    expectDecodeEqual(encoded, {&hostile.patch, 1});
    const double bytes = static_cast<double>(encoded.size());
    EXPECT_LT(bytes / static_cast<double>(hostile.patch.elementCount()), hostile.maxBytesPerTriangle);
    // A list of 16-bit coordinates and 16-bit indices.
    const auto plain = 6.0 * static_cast<double>(hostile.patch.positions.size() + hostile.patch.elementCount());
    EXPECT_LT(bytes, plain);
  }
}

/// The bits of an uncompressed list of the values of a patch, with indices of 16 bits.
double plainBitsOf(const CompactPatch& patch) {
  std::size_t bits = 3 * patch.positionBits * patch.positions.size();
  if (patch.topology != Topology::points)
    bits += 16 * patch.corners.size();
  for (const Attribute& attribute : patch.attributes) // two numbers are enough for a point of the octahedron
    bits += patch.wedgeCount() * attribute.type.bits *
            (attribute.type.kind == AttributeKind::normal ? 2 : attribute.type.components);
  return static_cast<double>(bits);
}

TEST(Compact, TakesHardlyMoreBytesForNoiseThanAPlainList) {
  using enum AttributeKind;
  const AttributeType noise[] = {{normal, 3, 8, NormalMode::area},
                                 {texCoord, 2, 12, NormalMode::area},
                                 {color, 3, 8, NormalMode::area},
                                 {other, 1, 24, NormalMode::area}};
  for (const Topology topology : {Topology::points, Topology::lines, Topology::triangles})
    for (const std::uint32_t bits : {8u, 16u, 30u})
      for (const std::size_t attributes : {std::size_t{0}, std::size(noise)}) {
        CompactPatch patch = testing::tangle(topology, 20'000, 20'000, 20'000, bits);
        for (std::size_t i = 0; i < attributes; ++i)
          testing::addRandom(patch, noise[i], static_cast<std::uint32_t>(i));
        const double ratio = 8 * static_cast<double>(bytesOf(patch).size()) / plainBitsOf(patch);
        EXPECT_LT(ratio, topology == Topology::points ? 1.11 : 0.97)
            << static_cast<int>(topology) << " of " << bits << " bits, " << attributes;
        if (bits == 16)
          expectDecodesEqual(patch);
      }
  // Points are sorted before they are encoded, which saves bytes even for noise.
  const CompactPatch cloud = testing::patchOf(imgeo::testing::pointCloud(20'000, 1), 16);
  EXPECT_LT(8 * static_cast<double>(bytesOf(cloud).size()) / plainBitsOf(cloud), 0.95);
}

TEST(Compact, EncodesTheSameBytesEveryTime) {
  const CompactPatch patch = testing::patchOf(imgeo::testing::randomMesh(7), 16);
  EXPECT_EQ(bytesOf(patch, 5), bytesOf(patch, 5));
}

TEST(Compact, TakesNoMoreBytesAtTheHighestEffortThanAtTheLowest) {
  for (const testing::Sample& sample : testing::files())
    EXPECT_LE(encodePatches(sample.patches, 9).bytes.size(), encodePatches(sample.patches, 0).bytes.size())
        << sample.name;
}

TEST(Compact, IsRefusedIfItIsCutAnywhere) {
  const Bytes bytes = bytesOf(testing::samples()[3].firstPatch());
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_THROW(decodePatches(ByteSpan(bytes).first(length), "x.png"), Error) << length;
}

} // namespace
} // namespace imgeo::compact
