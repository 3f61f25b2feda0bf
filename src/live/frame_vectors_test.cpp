// Checks vectors/frame-1, which web/src/decode/frame checks as well. NAME.igf is the frame of NAME.json, whose
// "components" are the stored integers, component by component. refused.json holds bytes in base 16 and the kind of
// error. IMGEO_REWRITE_GOLDEN=1 writes all files again; a frame that changes means a new version of the format.
#include "base/error.h"
#include "base/error_testing.h"
#include "base/file.h"
#include "base/testing.h"
#include "live/frame.h"
#include "live/frame_samples.h"

#include <array>
#include <cstdlib>
#include <gtest/gtest.h>
#include <libdeflate.h>
#include <nlohmann/json.hpp>

namespace imgeo::live {
namespace {

using Json = nlohmann::ordered_json;
const std::filesystem::path folder = IMGEO_VECTORS "/frame-1";

constexpr std::array predictionNames{"none", "previous", "linear", "planar"};

Json jsonOf(const Bytes& bytes) {
  const FrameHeader header = readFrameHeader(bytes, "");
  const Frame frame = decodeFrame(bytes, "");
  const FrameLayout& layout = frame.layout;
  Json json{{"number", frame.number},
            {"epoch", frame.epoch},
            {"time", frame.time},
            {"vertices", layout.vertices},
            {"columns", layout.columns},
            {"positionBits", layout.positionBits},
            {"normalBits", layout.normalBits},
            {"colorComponents", layout.colorComponents},
            {"valueComponents", layout.valueComponents},
            {"valueBits", layout.valueBits},
            {"prediction", predictionNames.at(static_cast<std::size_t>(header.prediction))},
            {"components", Json::array()}};
  for (std::uint32_t i = 0; i < componentCount(layout); ++i)
    json["components"].push_back(std::vector(frame.component(i).begin(), frame.component(i).end()));
  return json;
}

std::string verdictOn(const Bytes& bytes) {
  try {
    decodeFrame(bytes, "");
    return "decoded";
  } catch (const Error& error) {
    return imgeo::testing::nameOf(error.kind());
  }
}

void write(const std::string& name, const Json& json) {
  writeFile(folder / name, asBytes(json.dump() + "\n"));
}

Json read(const std::string& name) {
  return Json::parse(asText(readFile(folder / name)));
}

/// Replaces `values.size()` bytes of the header and makes its checksum right.
Bytes withHeader(Bytes bytes, std::size_t offset, const Bytes& values) {
  std::copy(values.begin(), values.end(), bytes.begin() + static_cast<std::ptrdiff_t>(offset));
  Bytes sum;
  appendLittle(sum, libdeflate_crc32(0, bytes.data(), 48));
  std::copy(sum.begin(), sum.end(), bytes.begin() + 48);
  return bytes;
}

/// A frame with another gzip stream.
Bytes withStream(const Bytes& frame, ByteSpan stream) {
  Bytes result(frame.begin(), frame.begin() + frameHeaderBytes);
  result.insert(result.end(), stream.begin(), stream.end());
  Bytes length;
  appendLittle(length, static_cast<std::uint32_t>(stream.size()));
  return withHeader(result, 4, length);
}

/// The gzip stream of a frame twice: two members.
Bytes withTwoMembers(const Bytes& frame) {
  Bytes stream(frame.begin() + frameHeaderBytes, frame.end());
  stream.insert(stream.end(), frame.begin() + frameHeaderBytes, frame.end());
  return withStream(frame, stream);
}

/// A frame whose gzip stream unpacks to `bytes` zeros.
Bytes withZeros(const Bytes& frame, std::size_t bytes) {
  libdeflate_compressor* compressor = libdeflate_alloc_compressor(9);
  const Bytes zeros(bytes);
  Bytes packed(libdeflate_gzip_compress_bound(compressor, bytes));
  packed.resize(libdeflate_gzip_compress(compressor, zeros.data(), bytes, packed.data(), packed.size()));
  libdeflate_free_compressor(compressor);
  return withStream(frame, packed);
}

std::vector<std::pair<std::string, Bytes>> refusedFrames() {
  const Bytes good = encodeFrame(testing::smoothFrame({6, 3}, 1), Prediction::planar);
  const Bytes points = encodeFrame(testing::smoothFrame({6, 0}, 1), Prediction::previous);
  Bytes longer = good, notAFrame = good, badSum = good, badStream = good, badSumOfStream = good;
  longer.push_back(0);
  notAFrame[0] = 'i';
  badSum[48] ^= 1;
  badStream[frameHeaderBytes + 10] = 0xff;
  badSumOfStream[badSumOfStream.size() - 8] ^= 1;
  Bytes version = good;
  version[3] = 2;
  std::vector<std::pair<std::string, Bytes>> frames{
      {"empty", {}},
      {"cut in the header", Bytes(good.begin(), good.begin() + 51)},
      {"only a header", Bytes(good.begin(), good.begin() + frameHeaderBytes)},
      {"cut in the stream", Bytes(good.begin(), good.end() - 1)},
      {"a byte too many", longer},
      {"another signature", notAFrame},
      {"another version", version},
      {"checksum of the header", badSum},
      {"damaged stream", badStream},
      {"checksum of the stream", badSumOfStream},
      {"number above 2^53 - 1", withHeader(good, 8, {0, 0, 0, 0, 0, 0, 0x20, 0})},
      {"epoch after number", withHeader(good, 16, {0xff, 0xff, 0xff, 0xff, 0, 0, 0, 0})},
      {"infinite time", withHeader(good, 24, {0, 0, 0, 0, 0, 0, 0xf0, 0x7f})},
      {"time is no number", withHeader(good, 24, {1, 0, 0, 0, 0, 0, 0xf8, 0x7f})},
      {"no vertices", withHeader(good, 32, {0, 0, 0, 0})},
      {"too many vertices", withHeader(points, 32, {1, 0, 0x40, 0})},
      {"vertices no multiple of columns", withHeader(good, 36, {4, 0, 0, 0})},
      {"more columns than vertices", withHeader(good, 36, {12, 0, 0, 0})},
      {"7 position bits", withHeader(good, 40, {7})},
      {"25 position bits", withHeader(good, 40, {25})},
      {"7 normal bits", withHeader(good, 41, {7})},
      {"17 normal bits", withHeader(good, 41, {17})},
      {"2 color components", withHeader(good, 42, {2})},
      {"5 color components", withHeader(good, 42, {5})},
      {"5 value components", withHeader(good, 43, {5, 8})},
      {"value bits without values", withHeader(good, 44, {8})},
      {"values without bits", withHeader(good, 43, {1, 0})},
      {"values of 25 bits", withHeader(good, 43, {1, 25})},
      {"prediction 4", withHeader(good, 45, {4})},
      {"planar without a grid", withHeader(points, 45, {3})},
      {"byte 46", withHeader(good, 46, {1})},
      {"byte 47", withHeader(good, 47, {1})},
      {"fewer vertices than bytes", withHeader(points, 32, {5})},
      {"more vertices than bytes", withHeader(points, 32, {7})},
      {"too few bytes for the vertices", withHeader(points, 32, {0, 0, 0x40, 0})},
      {"a stream of more bytes than its vertices", withZeros(points, 100'000)},
      {"two members", withTwoMembers(good)},
      {"an empty stream", withHeader(Bytes(points.begin(), points.begin() + frameHeaderBytes), 4, {0, 0, 0, 0})},
  };
  return frames;
}

void rewrite() {
  std::filesystem::create_directories(folder);
  for (const testing::FrameSample& sample : testing::frameSamples()) {
    const Bytes bytes = encodeFrame(sample.frame, sample.prediction);
    writeFile(folder / (sample.name + ".igf"), bytes);
    write(sample.name + ".json", jsonOf(bytes));
  }
  Json refused = Json::array();
  for (const auto& [name, bytes] : refusedFrames())
    refused.push_back({{"name", name}, {"frame", imgeo::testing::base16Of(bytes)}, {"verdict", verdictOn(bytes)}});
  write("refused.json", refused);
}

class FrameVectors : public ::testing::Test {
protected:
  static void SetUpTestSuite() {
    if (std::getenv("IMGEO_REWRITE_GOLDEN") != nullptr)
      rewrite();
  }
};

TEST_F(FrameVectors, AreDecodedExactly) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".igf")
      continue;
    const std::string name = entry.path().stem();
    EXPECT_EQ(jsonOf(readFile(entry.path())), read(name + ".json")) << name;
    ++count;
  }
  EXPECT_EQ(count, testing::frameSamples().size());
}

TEST_F(FrameVectors, EqualWhatTheEncoderWrites) {
  for (const testing::FrameSample& sample : testing::frameSamples())
    EXPECT_EQ(encodeFrame(sample.frame, sample.prediction), readFile(folder / (sample.name + ".igf"))) << sample.name;
}

TEST_F(FrameVectors, OfDamagedFramesAreRefused) {
  const Json refused = read("refused.json");
  EXPECT_GT(refused.size(), 30u);
  for (const Json& entry : refused) {
    const std::string verdict = verdictOn(imgeo::testing::bytesOfBase16(entry.at("frame")));
    EXPECT_NE(verdict, "decoded") << entry;
    EXPECT_EQ(verdict, entry.at("verdict").get<std::string>()) << entry;
  }
}

} // namespace
} // namespace imgeo::live
