#include "containers/choose_urls.h"

#include "base/error.h"
#include "containers/png/png.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

/// "lost" names no file, "page" a file that is no image.
Bytes fileOf(const std::string& url) {
  if (url == "lost")
    throw Error(ErrorKind::io, url, "there is no such file");
  return url == "page" ? Bytes{'<'} : encodePng({1, 1, 3, Bytes(3)}, 1);
}

GeometryDescription geometryOf(Encoding encoding, std::vector<std::string> urls) {
  GeometryDescription geometry;
  geometry.encoding = encoding;
  const std::string first = urls.front();
  urls.erase(urls.begin());
  PatchDescription patch;
  patch.coord.push_back({first, TexelLocation{}, std::move(urls)});
  geometry.patches.push_back(std::move(patch));
  return geometry;
}

TEST(ChooseUrls, LeavesTheFirstThatIsAnImage) {
  GeometryDescription geometry = geometryOf(Encoding::classic, {"lost", "page", "a", "b"});
  EXPECT_TRUE(chooseUrls(geometry, fileOf).empty());
  EXPECT_EQ(geometry.patches[0].coord[0], (Reference{"a", TexelLocation{}, {}}));
}

TEST(ChooseUrls, LeavesTheFirstFileWhereItIsNoImage) {
  GeometryDescription geometry = geometryOf(Encoding::bg, {"lost", "page", "a"});
  EXPECT_TRUE(chooseUrls(geometry, fileOf).empty());
  EXPECT_EQ(geometry.patches[0].coord[0].url, "page");
}

TEST(ChooseUrls, NamesAllWhereNoneCanBeRead) {
  GeometryDescription geometry = geometryOf(Encoding::classic, {"page", "lost"});
  const std::vector<Error> errors = chooseUrls(geometry, fileOf);
  ASSERT_EQ(errors.size(), 1u);
  const std::string text = errors[0].what();
  EXPECT_EQ(text.find("page: "), 0u) << text;
  EXPECT_NE(text.find("; lost: there is no such file"), std::string::npos) << text;
  EXPECT_EQ(geometry.patches[0].coord[0], (Reference{"page", TexelLocation{}, {}}));
}

TEST(ChooseUrls, ReadsNoFileOfOneUrl) {
  GeometryDescription geometry = geometryOf(Encoding::classic, {"lost"});
  EXPECT_TRUE(chooseUrls(geometry, fileOf).empty());
}

} // namespace
} // namespace imgeo
