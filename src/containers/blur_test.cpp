// Compares the filter with vectors/blur.json, which web/src/decode/classic/blur.test.ts writes and reads.
#include "containers/blur.h"

#include "base/file.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace imgeo {
namespace {

TEST(Blur, IsThatOfTheVectors) {
  const auto vectors =
      nlohmann::ordered_json::parse(asText(readFile(std::filesystem::path(IMGEO_VECTORS) / "blur.json")));
  ASSERT_GE(vectors.size(), 7u);
  for (const auto& vector : vectors) {
    SCOPED_TRACE(vector.at("name").get<std::string>());
    const auto points = vector.at("points").get<std::vector<double>>(),
               expected = vector.at("blurred").get<std::vector<double>>();
    ASSERT_EQ(points.size(), expected.size());
    PointImage image;
    image.columns = vector.at("columns").get<std::uint32_t>();
    image.isClosed = vector.at("isClosed").get<bool>();
    for (std::size_t i = 0; i < points.size(); i += 3)
      image.points.push_back({points[i], points[i + 1], points[i + 2]});
    const std::vector<Vec3d> actual = blurred(image, vector.at("radius").get<double>());
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(actual[i / 3][static_cast<int>(i % 3)], expected[i], 1e-10) << "number " << i;
  }
}

} // namespace
} // namespace imgeo
