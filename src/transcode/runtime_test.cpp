#include "transcode/runtime.h"

#include "base/file.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

TEST(Runtime, TheToolCarriesTheBundleByteForByte) {
  const Bytes bundle = readFile(IMGEO_RUNTIME_MODULE);
  EXPECT_FALSE(bundle.empty());
  EXPECT_EQ(runtimeModule(), asText(bundle));
}

} // namespace
} // namespace imgeo
