#pragma once
// Conversions out of core, for tests that compare them with conversions in memory.

#include "base/error.h"
#include "imgeo/convert.h"
#include "transcode/site/testing.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <vector>

namespace imgeo::testing {

/// Regions so small that two levels are built out of core.
inline ConvertOptions withRegions() {
  ConvertOptions options;
  options.pictures = false;
  options.levels = LevelChoice::always;
  options.groupTriangles = 512;
  options.regionTriangles = 4096;
  return options;
}

inline ConvertOptions outOfCore(const TemporaryDirectory& directory) {
  ConvertOptions options = withRegions();
  options.workFolder = directory / "work";
  return options;
}

/// Expects that a source, of triangles or points, becomes the same files in memory and out of core.
inline void expectSameAsInMemory(
    const TemporaryDirectory& directory, const std::filesystem::path& input,
    ConvertOptions (*change)(ConvertOptions) = [](ConvertOptions options) { return options; }) {
  const ConvertReport small = convert(input, directory / "memory", change(withRegions()));
  const ConvertReport large = convert(input, directory / "site", change(outOfCore(directory)));
  const auto expected = contentsOf(directory / "memory" / "geometry");
  EXPECT_GT(expected.size(), 60u);
  EXPECT_EQ(contentsOf(directory / "site" / "geometry"), expected) << input;
  EXPECT_FALSE(std::filesystem::exists(directory / "work"));
  EXPECT_EQ(large.format, small.format);
  EXPECT_EQ(large.elements, small.elements);
  EXPECT_EQ(large.vertices, small.vertices);
  EXPECT_EQ(large.collapsed, small.collapsed);
  EXPECT_EQ(large.positionError, small.positionError);
  EXPECT_EQ(large.normalErrorDegrees, small.normalErrorDegrees);
  EXPECT_EQ(large.normalsComputed, small.normalsComputed);
  EXPECT_EQ(large.edges.guessedSharp, small.edges.guessedSharp);
  EXPECT_EQ(large.edges.guessedSmooth, small.edges.guessedSmooth);
  EXPECT_EQ(large.edges.flat, small.edges.flat);
  EXPECT_EQ(large.hasColors, small.hasColors);
  EXPECT_EQ(large.sourceBytes, small.sourceBytes);
  const VerifyReport verified = verify(directory / "site", input);
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
}

/// The text of a site's document.
inline std::string documentOf(const std::filesystem::path& site) {
  const Bytes bytes = readFile(site / "scene.x3d");
  return std::string(asText(bytes));
}

/// Ends a conversion at a call of its progress.
struct Ended {};

/// Where conversions are ended: at the second call of each pass (the first of a pass of one call), before which it has
/// done a part of its work, or at calls within all of it.
enum class EndedAt : std::uint8_t { beginnings, manyCalls };

/// The numbers of calls of progress before those at which a conversion is ended.
inline std::vector<int> callsBeforeEnds(const TemporaryDirectory& directory, const std::filesystem::path& input,
                                        EndedAt endedAt) {
  std::vector<std::string> calls;
  convert(input, directory / "site", outOfCore(directory),
          [&](double, const std::string& name) { calls.push_back(name); });
  std::filesystem::remove_all(directory / "site");
  const int count = static_cast<int>(calls.size());
  std::vector<int> allowed;
  if (endedAt == EndedAt::manyCalls) {
    for (int call = 1; call < count; call += call < 12 ? 1 : 4)
      allowed.push_back(call);
    return allowed;
  }
  for (int call = 1; call < count; ++call)
    if (calls[call] != calls[call - 1])
      allowed.push_back(call + 1 < count && calls[call + 1] == calls[call] ? call + 1 : call);
  return allowed;
}

/// Ends conversions out of core in one pass after the other, and expects that each goes on to the files of conversion
/// in memory. `killedFile`: a work file of the first mesh, of which a process that was killed has left a part. Returns
/// the names of the passes.
inline std::set<std::string> expectGoesOnInAnyPass(const TemporaryDirectory& directory,
                                                   const std::filesystem::path& input, const std::string& killedFile,
                                                   EndedAt endedAt = EndedAt::manyCalls) {
  convert(input, directory / "memory", withRegions());
  const auto expected = contentsOf(directory / "memory" / "geometry");
  std::set<std::string> steps;
  for (const int allowed : callsBeforeEnds(directory, input, endedAt)) {
    ConvertOptions options = outOfCore(directory);
    int calls = 0;
    std::string step;
    const Progress endAfter = [&](double, const std::string& name) {
      step = name;
      if (++calls > allowed)
        throw Ended();
    };
    try {
      convert(input, directory / "site", options, endAfter);
    } catch (const Ended&) {
      steps.insert(step);
      EXPECT_FALSE(std::filesystem::exists(directory / "site")) << step;
      if (!std::filesystem::exists(directory / "work")) // it ended before anything was written
        continue;
      std::filesystem::create_directories(directory / "work" / "0");
      writeFile(directory / "work" / "0" / (killedFile + ".part"), asBytes("cut"));
      options.resume = true;
      convert(input, directory / "site", options);
    }
    EXPECT_EQ(contentsOf(directory / "site" / "geometry"), expected) << step;
    std::filesystem::remove_all(directory / "site");
  }
  return steps;
}

/// The sentence with which converting a file ends.
inline std::string refusal(const std::filesystem::path& input, const std::filesystem::path& site,
                           const ConvertOptions& options) {
  try {
    convert(input, site, options);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

} // namespace imgeo::testing
