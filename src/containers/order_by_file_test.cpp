#include "containers/order_by_file.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

GeometryDescription packedIn(const char* url) {
  GeometryDescription geometry;
  geometry.patches.emplace_back().data = Reference{url, PatchLocation{}};
  return geometry;
}

GeometryDescription imagesIn(const char* url) {
  GeometryDescription geometry;
  geometry.patches.emplace_back().coord = {Reference{url, TexelLocation{}}};
  return geometry;
}

TEST(OrderByFile, PutsGeometriesOfAFileTogetherAndKeepsTheOrderOfBoth) {
  const std::vector<GeometryDescription> geometries{packedIn("b"), packedIn("a"), packedIn("b"),
                                                    packedIn("c"), packedIn("a"), packedIn("b")};
  EXPECT_EQ(orderByFile(geometries), (std::vector<std::size_t>{0, 2, 5, 1, 4, 3}));
}

TEST(OrderByFile, LeavesGeometriesWithoutFilesWhereTheyAre) {
  const std::vector<GeometryDescription> geometries{{}, imagesIn("a"), {}, packedIn("b"), imagesIn("a")};
  EXPECT_EQ(orderByFile(geometries), (std::vector<std::size_t>{0, 1, 4, 2, 3}));
  EXPECT_TRUE(orderByFile({}).empty());
}

} // namespace
} // namespace imgeo
