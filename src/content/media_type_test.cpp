#include "content/media_type.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

TEST(MediaType, TheExtensionDecidesIgnoringCase) {
  EXPECT_EQ(mediaTypeOf("index.html").name, "text/html; charset=utf-8");
  EXPECT_EQ(mediaTypeOf("imgeo.0123.JS").name, "text/javascript; charset=utf-8");
  EXPECT_EQ(mediaTypeOf("scene.x3d").name, "model/x3d+xml");
  EXPECT_EQ(mediaTypeOf("a.b.png").name, "image/png");
}

TEST(MediaType, UnknownExtensionsAreOctetStreams) {
  for (const char* name : {"", "README", "a.unknown", "html", "a.", "."})
    EXPECT_EQ(mediaTypeOf(name).name, "application/octet-stream") << name;
}

TEST(MediaType, TextAndTypedArraysAreCompressibleAndImagesAreNot) {
  EXPECT_TRUE(mediaTypeOf("a.html").isCompressible);
  EXPECT_TRUE(mediaTypeOf("a.x3d").isCompressible);
  EXPECT_TRUE(mediaTypeOf("a.bin").isCompressible);
  EXPECT_FALSE(mediaTypeOf("a.png").isCompressible);
}

} // namespace
} // namespace imgeo
