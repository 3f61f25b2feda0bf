// Converts clouds of points: the material that a source without one gets.

#include "base/file.h"
#include "base/testing.h"
#include "transcode/site/testing.h"

#include <gtest/gtest.h>
#include <string>

namespace imgeo {
namespace {

/// How a cloud is converted: with patches, or with levels of detail in memory or out of core, or for X3DOM.
enum class Way { patches, levels, outOfCore, x3dom };

/// The text of the Material that a cloud of points gets.
std::string materialOf(const std::string& points, Way way) {
  const testing::TemporaryDirectory directory;
  writeFile(directory / "cloud.xyz", asBytes(points));
  ConvertOptions options;
  options.groupTriangles = 256;
  if (way == Way::levels || way == Way::outOfCore)
    options.levels = LevelChoice::always;
  if (way == Way::outOfCore)
    options.workFolder = directory / "work";
  if (way == Way::x3dom)
    options.target = Target::x3dom;
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
  const auto shines = [](const std::string& points, Way way) {
    return materialOf(points, way).find("emissiveColor") != std::string::npos;
  };
  for (const Way way : {Way::patches, Way::levels, Way::outOfCore}) {
    EXPECT_TRUE(shines(plain, way));
    EXPECT_FALSE(shines(withNormals, way));
  }
  EXPECT_TRUE(shines(withNormals, Way::x3dom)); // X3DOM lights triangles alone
}

} // namespace
} // namespace imgeo
