#pragma once
// Comparisons out of core, for tests that expect what comparison in memory finds.

#include "imgeo/convert.h"
#include "imgeo/verify.h"
#include "import/ply/testing.h"
#include "transcode/site/testing.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <utility>

namespace imgeo::testing {

inline constexpr std::uint64_t minVerifyingMemory = std::uint64_t{1} << 28;

inline ConvertOptions smallGroups() {
  ConvertOptions options;
  options.pictures = false;
  options.levels = LevelChoice::always;
  options.groupTriangles = 1024;
  return options;
}

/// Compares in both ways. Returns the report of that out of core.
inline VerifyReport verifyBoth(const TemporaryDirectory& directory, const std::filesystem::path& site,
                               const std::filesystem::path& input) {
  const VerifyReport inMemory = verify(site, input);
  const std::filesystem::path work = directory / "work";
  const VerifyReport large = verify(site, input, {.memoryBytes = minVerifyingMemory, .workFolder = work});
  EXPECT_FALSE(std::filesystem::exists(work));
  EXPECT_EQ(large.equal, inMemory.equal);
  EXPECT_EQ(large.findings, inMemory.findings);
  for (const auto& [a, b] : {std::pair(large.input, inMemory.input),
                             {large.site, inMemory.site},
                             {large.missing, inMemory.missing},
                             {large.extra, inMemory.extra}})
    EXPECT_TRUE(a.triangles == b.triangles && a.points == b.points) << a.points << ' ' << b.points;
  EXPECT_EQ(large.positionError, inMemory.positionError);
  EXPECT_EQ(large.positionBound, inMemory.positionBound);
  EXPECT_EQ(large.normalErrorDegrees, inMemory.normalErrorDegrees);
  EXPECT_EQ(large.normalBoundDegrees, inMemory.normalBoundDegrees);
  EXPECT_EQ(large.attributeError, inMemory.attributeError);
  EXPECT_EQ(large.comparedMaterials, inMemory.comparedMaterials);
  return large;
}

/// What is found, in both ways, where the source of the folder's site is another mesh.
inline std::string findingsFor(const TemporaryDirectory& directory, const Mesh& other) {
  writeMesh(directory / "other.ply", other);
  const VerifyReport report = verifyBoth(directory, directory / "site", directory / "other.ply");
  EXPECT_FALSE(report.equal);
  return ::testing::PrintToString(report.findings);
}

/// Converts a source and expects that its site equals it, in both ways.
inline void expectEqualInBothWays(const TemporaryDirectory& directory, const std::filesystem::path& input,
                                  const ConvertOptions& options = smallGroups()) {
  convert(input, directory / "site", options);
  const VerifyReport report = verifyBoth(directory, directory / "site", input);
  EXPECT_TRUE(report.equal) << input << ::testing::PrintToString(report.findings);
  EXPECT_GT(report.site.sum(), 10000u);
}

} // namespace imgeo::testing
