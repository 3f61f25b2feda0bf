#include "base/parallel.h"
#include "base/soak_testing.h"
#include "scene/testing.h"
#include "transcode/site/testing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <set>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

VerifyReport expectRoundTrip(const Mesh& mesh, ConvertOptions options, const std::string& what) {
  const TemporaryDirectory directory;
  options.pictures = false; // they are the slowest step for small meshes, and verify does not see them
  testing::writeMesh(directory / "input.ply", mesh);
  const ConvertReport converted = convert(directory / "input.ply", directory / "site", options);
  const VerifyReport verified = verify(directory / "site", directory / "input.ply");
  EXPECT_TRUE(verified.equal) << what << ": " << fmt::format("{}", fmt::join(verified.findings, " "));
  EXPECT_LE(verified.positionError, verified.positionBound * 1.001 + 1e-12) << what;

  const SiteInfo info = inspect(directory / "site");
  EXPECT_EQ(info.elements, converted.elements) << what;
  EXPECT_EQ(info.vertices, converted.vertices) << what;
  EXPECT_EQ(info.patches, converted.patches) << what;
  EXPECT_EQ(testing::namesIn(directory.path()), (std::vector<std::string>{"input.ply", "site"})) << what;
  return verified;
}

/// The encoding of images that convert chooses, and typed arrays.
constexpr std::array imagesAndArrays{std::optional<Encoding>(), std::optional(Encoding::bg)};

const char* nameOf(std::optional<Encoding> encoding) {
  return encoding ? imgeo::nameOf(*encoding) : "automatic";
}

/// Chooses by `seed` one of the ways to store normals that the options for coordinates allow.
void setNormals(ConvertOptions& options, std::uint32_t seed) {
  using enum NormalEncoding;
  if (options.encoding != Encoding::bg) {
    options.normals = std::array{rgb, octahedral, spherical, palette}[seed % 4];
    if (options.normals == spherical)
      options.normalBits = 8 << (seed / 4 % 2);
    return;
  }
  const bool canBeSpherical = options.positionBits > 8 && options.positionBits <= 16;
  const std::pair<NormalEncoding, std::uint32_t> all[] = {
      {rgb, 8}, {rgb, 16}, {rgb, 32}, {octahedral, 16}, {octahedral, 0}, {spherical, 16}, {spherical, 8}};
  std::tie(options.normals, options.normalBits) = all[seed % (canBeSpherical ? 7 : 6)];
}

/// Converts and verifies those of six meshes with every encoding, primitive and precision for whose third `isChosen`
/// returns true. Each third has one mesh with an index and one without.
void expectRoundTrips(bool (*isChosen)(std::uint32_t third)) {
  std::uint32_t seed = 1;
  for (const std::optional<Encoding> encoding : imagesAndArrays)
    for (const Primitives primitives : {Primitives::triangles, Primitives::strips, Primitives::points})
      for (const std::uint32_t bits : {8u, 12u, 16u, 24u, 32u})
        for (int mesh = 0; mesh < 6; ++mesh, ++seed) {
          if (!isChosen(((seed - 1) / 6 + mesh) % 3))
            continue;
          ConvertOptions options;
          options.encoding = encoding;
          options.primitives = primitives;
          options.indexed = mesh % 2 == 0;
          options.positionBits = bits;
          setNormals(options, seed);
          const std::uint32_t maxBits = encoding == Encoding::bg ? 32 : 24;
          options.texCoordBits = std::array{0u, 8u, 16u, maxBits}[seed / 2 % 4];
          options.colorBits = std::array{0u, 8u, 16u, maxBits}[seed / 3 % 4];
          options.patchVertices = seed % 2 ? 256 : 65535;
          options.effort = static_cast<int>(seed % 4);
          options.keepAttributes.all = seed % 3 > 0;
          if (encoding != Encoding::bg && options.keepAttributes.all)
            options.attributeBits = 8 * (1 + seed % 3);
          const VerifyReport verified = expectRoundTrip(
              testing::randomMesh(seed), options,
              fmt::format("seed {} encoding {} primitives {} indexed {} bits {} patches of {}", seed, nameOf(encoding),
                          int(primitives), options.indexed, bits, options.patchVertices));
          EXPECT_GT(verified.input.sum(), 0u) << seed;
          if (::testing::Test::HasFailure())
            return;
        }
}

TEST(RoundTrip, EveryEncodingPrimitiveAndPrecisionPreservesMeshes) {
  expectRoundTrips([](std::uint32_t third) { return third == 0; });
}

SOAK_TEST(RoundTrip, EveryEncodingPrimitiveAndPrecisionPreservesFurtherMeshes) {
  expectRoundTrips([](std::uint32_t third) { return third != 0; });
}

TEST(RoundTrip, CompactPreservesEveryMeshAtEveryPrecision) {
  std::uint32_t seed = 900;
  for (const Primitives primitives : {Primitives::triangles, Primitives::points})
    for (const std::uint32_t bits : {8u, 12u, 16u, 24u, 30u})
      for (int mesh = 0; mesh < 6; ++mesh, ++seed) {
        ConvertOptions options;
        options.encoding = Encoding::compact;
        options.primitives = primitives;
        options.positionBits = bits;
        options.normals = seed % 5 == 0 ? NormalEncoding::derived : NormalEncoding::octahedral;
        options.normalBits = 4 + seed % 13;
        options.texCoordBits = 1 + seed % 16;
        options.colorBits = 1 + seed % 8;
        options.patchVertices = seed % 2 ? 256 : 65535;
        options.effort = static_cast<int>(seed % 3);
        options.keepAttributes.all = seed % 4 > 0;
        if (options.keepAttributes.all)
          options.attributeBits = 8 * (1 + seed % 3);
        expectRoundTrip(testing::randomMesh(seed), options, fmt::format("seed {} bits {}", seed, bits));
        if (HasFailure())
          return;
      }
}

/// A mesh of these triangles over random points.
Mesh meshOver(std::uint32_t pointCount, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  testing::Random random(pointCount);
  Mesh mesh;
  for (std::uint32_t i = 0; i < pointCount; ++i)
    mesh.positions.push_back({random.between(0, 1), random.between(0, 1), random.between(0, 1)});
  testing::addPlainWedges(mesh);
  for (const auto& [a, b, c] : triangles)
    testing::addTriangle(mesh, a, b, c);
  return mesh;
}

/// The codec's own tests have the same meshes. Here they are also welded, cut into patches, simplified and verified.
SOAK_TEST(RoundTrip, CompactPreservesMeshesThatAreNotManifold) {
  constexpr std::uint32_t count = 30'000;
  using Triangle = std::array<std::uint32_t, 3>;
  const std::pair<const char*, Triangle (*)(std::uint32_t)> kinds[] = {
      {"a vertex of all triangles",
       [](std::uint32_t i) {
         return Triangle{0, 1 + i, 1 + (i + 1) % count};
       }},
      {"triangles on their own",
       [](std::uint32_t i) {
         return Triangle{3 * i, 3 * i + 1, 3 * i + 2};
       }},
      {"triangles between any vertices",
       [](std::uint32_t i) {
         return Triangle{i, i * 7919 % count, (i * 104'729 + 1) % count};
       }},
      {"an edge of all triangles",
       [](std::uint32_t i) {
         return Triangle{0, 1, 2 + i};
       }},
      {"one triangle",
       [](std::uint32_t i) {
         return Triangle{i % 3, (i + 1) % 3, (i + 2) % 3};
       }},
      {"one triangle, either way around",
       [](std::uint32_t i) {
         return i % 2 ? Triangle{0, 1, 2} : Triangle{1, 0, 2};
       }},
      {"triangles without area",
       [](std::uint32_t i) {
         return Triangle{i, i, (i + 1) % count};
       }},
      {"a strip whose neighbours are of opposite orientation", [](std::uint32_t i) {
         return Triangle{i, i + 1, i + 2};
       }}};
  for (const auto& [what, triangleAt] : kinds) {
    std::vector<Triangle> triangles;
    std::uint32_t pointCount = 0, degenerate = 0; // triangles that repeat a corner are not compared
    for (std::uint32_t i = 0; i < count; ++i) {
      triangles.push_back(triangleAt(i));
      const auto& [a, b, c] = triangles.back();
      degenerate += a == b || b == c || c == a;
      pointCount = std::max({pointCount, a + 1, b + 1, c + 1});
    }
    for (const std::uint32_t patchVertices : {5'000u, 65'535u}) {
      ConvertOptions options;
      options.encoding = Encoding::compact;
      options.patchVertices = patchVertices;
      const VerifyReport verified = expectRoundTrip(meshOver(pointCount, triangles), options, what);
      EXPECT_EQ(verified.input.triangles + degenerate, count) << what;
    }
  }
}

TEST(RoundTrip, MaxErrorChoosesTheSmallestNumberOfBits) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "input.ply", testing::torus(20, 12)); // 2.7 wide
  for (const auto& [error, bits] :
       {std::pair{MaxError{0.01, false}, 8u}, {MaxError{0.001, false}, 12u}, {MaxError{0.01, true}, 14u}})
    for (const Encoding encoding : {Encoding::classic, Encoding::compact}) {
      ConvertOptions options;
      options.encoding = encoding;
      options.maxError = error;
      EXPECT_EQ(convert(directory / "input.ply", directory / "site", options).minPositionBits, bits);
    }
}

SOAK_TEST(RoundTrip, EveryElementTypeAndLayoutPreservesEveryMesh) {
  using enum NormalEncoding;
  struct Case {
    std::optional<ElementType> type;
    std::vector<std::uint32_t> bits; ///< 0: the type's own
    std::vector<NormalEncoding> normals;
  };
  const Case cases[] = {{ElementType::uint8, {0, 8}, {rgb, octahedral}},
                        {ElementType::int8, {0}, {rgb, octahedral}},
                        {ElementType::uint16, {0, 8, 13}, {rgb, octahedral, spherical}},
                        {ElementType::int16, {0, 8, 13, 15}, {rgb, octahedral, spherical}},
                        {ElementType::float32, {0, 8, 14, 24}, {rgb, octahedral}},
                        {std::nullopt, {0, 11, 20, 32}, {rgb, octahedral}}};
  std::uint32_t seed = 500;
  for (const Case& one : cases)
    for (const std::uint32_t bits : one.bits)
      for (const NormalEncoding normals : one.normals)
        for (const Layout layout : {Layout::separate, Layout::interleaved}) {
          ConvertOptions options;
          options.encoding = Encoding::bg;
          options.coordType = one.type;
          options.positionBits = bits;
          options.normals = normals;
          options.layout = layout;
          options.indexed = ++seed % 3 != 0;
          options.patchVertices = seed % 2 ? 256 : 65535;
          expectRoundTrip(testing::randomMesh(seed), options,
                          fmt::format("seed {} type {} bits {} normals {} layout {}", seed,
                                      one.type ? nameOf(*one.type) : "auto", bits, nameOf(normals), int(layout)));
        }
}

TEST(RoundTrip, Float32KeepsTheNumbersOfTheSource) {
  const TemporaryDirectory directory;
  const Mesh mesh = testing::torus(40, 20);
  testing::writeMesh(directory / "input.ply", mesh);
  ConvertOptions options;
  options.encoding = Encoding::bg;
  options.coordType = ElementType::float32;
  options.indexed = false;
  convert(directory / "input.ply", directory / "site", options);
  const SiteDocument site = openDocument(directory / "site");
  const Bytes floats = readFile(directory / "site" / site.scene.geometries[0].patches[0].coord[0].url);
  ASSERT_EQ(floats.size(), mesh.corners.size() * 12);
  const auto key = [](Vec3f p) { return std::tuple(p.x, p.y, p.z); };
  std::set<std::tuple<float, float, float>> source;
  for (const Vec3f& position : mesh.positions)
    source.insert(key(position));
  std::size_t own = 0, near = 0;
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    const auto at = [&](std::size_t axis) { return loadLittle<float>(&floats[12 * i + 4 * axis]); };
    own += source.contains(key({at(0), at(1), at(2)}));
    near += std::min({std::abs(at(0)), std::abs(at(1)), std::abs(at(2))}) < boxOf(mesh).longestEdge() / 128;
  }
  EXPECT_GE(own + near, mesh.corners.size()) << "all but those near zero, where floats are finer than the lattice";
  EXPECT_GT(own, mesh.corners.size() / 2);
}

SOAK_TEST(RoundTrip, PatchesWith32BitIndicesPreserveTheMesh) {
  for (const std::optional<Encoding> encoding : imagesAndArrays)
    for (const Mesh& mesh : {testing::torus(400, 170), testing::polylines(30'000, 7)}) {
      ASSERT_GT(mesh.wedgeCount(), 65'535u);
      ConvertOptions options;
      options.encoding = encoding;
      options.patchVertices = 4'194'304;
      options.effort = 0;
      expectRoundTrip(mesh, options, fmt::format("encoding {}", nameOf(encoding)));
    }
}

TEST(RoundTrip, VerifyRepeatsEveryNormalWeighting) {
  for (const NormalWeighting weighting : {NormalWeighting::area, NormalWeighting::angle, NormalWeighting::uniform}) {
    ConvertOptions options;
    options.normalWeighting = weighting;
    expectRoundTrip(testing::nonManifold(), options, fmt::format("weighting {}", int(weighting)));
  }
}

TEST(RoundTrip, VerifyRepeatsTheCreaseAngle) {
  for (const std::optional<Encoding> encoding : imagesAndArrays) {
    ConvertOptions options;
    options.encoding = encoding;
    options.creaseDegrees = 30;
    expectRoundTrip(testing::nonManifold(), options, fmt::format("encoding {}", nameOf(encoding)));
    Mesh torus = testing::torus(12, 8);
    torus.normals.clear();
    expectRoundTrip(torus, options, fmt::format("torus, encoding {}", nameOf(encoding)));
  }
}

TEST(RoundTrip, MeshesWithoutExtentAreConverted) {
  for (const std::optional<Encoding> encoding : imagesAndArrays) {
    Mesh flat = testing::grid(3);
    for (Vec3f& position : flat.positions)
      position.y = 7;
    Mesh point = testing::pointCloud(1, 3);
    Mesh collapsed = testing::grid(1);
    for (Vec3f& position : collapsed.positions)
      position = {1e6f, -1e6f, 3};
    ConvertOptions options;
    options.encoding = encoding;
    expectRoundTrip(flat, options, "flat");
    expectRoundTrip(point, options, "one point");
    expectRoundTrip(collapsed, options, "all at one position");
  }
}

SOAK_TEST(RoundTrip, SitesDoNotDependOnTheNumberOfThreads) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "input.ply", testing::torus(120, 60));
  ConvertOptions options;
  options.patchVertices = 500;
  const auto expectSame = [&](const std::string& what) {
    convert(directory / "input.ply", directory / "all", options);
    for (const std::size_t threads : {1u, 2u, 3u}) {
      limitThreads(threads);
      convert(directory / "input.ply", directory / "few", options);
      limitThreads(0);
      EXPECT_EQ(testing::contentsOf(directory / "all"), testing::contentsOf(directory / "few"))
          << what << " on " << threads;
    }
  };
  expectSame("automatic");
  options.encoding = Encoding::bg;
  expectSame("bg");
  options.encoding = Encoding::compact;
  expectSame("compact");
}

TEST(RoundTrip, ExceptionsFromProgressLeaveTheOldSite) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "input.ply", testing::sphere(40, 40));
  ConvertOptions options;
  options.patchVertices = 256;
  convert(directory / "input.ply", directory / "site", options);
  const auto before = testing::contentsOf(directory / "site");
  options.encoding = Encoding::bg;
  struct Enough {};
  double last = -1;
  const auto stopAt = [&](double share) {
    return [&, share](double done, const std::string&) {
      last = done;
      if (done >= share)
        throw Enough{};
    };
  };
  for (const double share : {0.0, 0.2, 0.5, 0.9, 1.0}) {
    EXPECT_THROW(convert(directory / "input.ply", directory / "site", options, stopAt(share)), Enough);
    EXPECT_GE(last, share);
    EXPECT_EQ(testing::contentsOf(directory / "site"), before);
    EXPECT_EQ(testing::namesIn(directory.path()), (std::vector<std::string>{"input.ply", "site"}));
  }
}

} // namespace
} // namespace imgeo
