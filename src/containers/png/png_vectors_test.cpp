// Checks the files of vectors/png, which web/src/decode/pngVectors.test.ts checks as well: both decoders return the
// same pixels and refuse the same files with the same kind of error. In verdicts.json `crc32` is the checksum of the
// pixels.
#include "base/error.h"
#include "base/error_testing.h"
#include "base/file.h"
#include "containers/png/png.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <libdeflate.h>
#include <nlohmann/json.hpp>

namespace imgeo {
namespace {

using Json = nlohmann::ordered_json;
const std::filesystem::path vectorFolder = IMGEO_VECTORS "/png";

Json verdicts() {
  return Json::parse(asText(readFile(vectorFolder / "verdicts.json")));
}

Bytes pngOf(const std::string& name) {
  return readFile(vectorFolder / (name + ".png"));
}

TEST(PngVectors, DecodeToTheirPixels) {
  for (const Json& expected : verdicts().at("read")) {
    const auto name = expected.at("name").get<std::string>();
    SCOPED_TRACE(name);
    const Image image = decodePng(pngOf(name), name);
    EXPECT_EQ(image.width, expected.at("width"));
    EXPECT_EQ(image.height, expected.at("height"));
    EXPECT_EQ(image.channels, expected.at("channels"));
    EXPECT_EQ(fmt::format("{:08x}", libdeflate_crc32(0, image.pixels.data(), image.pixels.size())),
              expected.at("crc32").get<std::string>());
  }
}

TEST(PngVectors, AreRefusedWithTheStatedError) {
  for (const Json& expected : verdicts().at("refused")) {
    const auto name = expected.at("name").get<std::string>();
    SCOPED_TRACE(name);
    try {
      decodePng(pngOf(name), name);
      ADD_FAILURE() << "was read";
    } catch (const Error& error) {
      EXPECT_EQ(expected.at("kind"), testing::nameOf(error.kind())) << error.what();
    }
  }
}

} // namespace
} // namespace imgeo
