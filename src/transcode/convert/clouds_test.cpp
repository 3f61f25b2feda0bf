// Converts clouds of points: the material that a source without one gets.

#include "base/file.h"
#include "base/testing.h"
#include "transcode/site/testing.h"

#include <gtest/gtest.h>
#include <string>

namespace imgeo {
namespace {

/// The text of the Material that a cloud of points gets, in memory or with levels of detail, and out of core.
std::string materialOf(const std::string& points, bool hasLevels, bool isOutOfCore) {
  const testing::TemporaryDirectory directory;
  writeFile(directory / "cloud.xyz", asBytes(points));
  ConvertOptions options;
  options.groupTriangles = 256;
  if (hasLevels)
    options.levels = LevelChoice::always;
  if (isOutOfCore)
    options.workFolder = directory / "work";
  convert(directory / "cloud.xyz", directory / "site", options);
  EXPECT_TRUE(verify(directory / "site", directory / "cloud.xyz").equal);
  const Bytes bytes = readFile(directory / "site" / "scene.x3d");
  const std::string document(asText(bytes));
  const std::size_t from = document.find("<Material");
  return document.substr(from, document.find('>', from) - from);
}

TEST(Clouds, WithoutNormalsShineAndOthersAreLit) {
  std::string plain, withNormals;
  for (int n = 0; n < 600; ++n) {
    const std::string point = std::to_string(7 * n % 29) + " " + std::to_string(n / 29) + " " + std::to_string(n % 7);
    plain += point + "\n";
    withNormals += point + " 0 0 1\n";
  }
  for (const auto& [hasLevels, isOutOfCore] :
       {std::pair(false, false), std::pair(true, false), std::pair(true, true)}) {
    EXPECT_NE(materialOf(plain, hasLevels, isOutOfCore).find("emissiveColor"), std::string::npos);
    EXPECT_EQ(materialOf(withNormals, hasLevels, isOutOfCore).find("emissiveColor"), std::string::npos);
  }
}

} // namespace
} // namespace imgeo
