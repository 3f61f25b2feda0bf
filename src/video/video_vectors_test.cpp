// Checks vectors/video-1, which web/src/decode/video checks as well. NAME.webm is the video of a sequence of
// vectors/sequence-1; NAME.rgb has the pixels of its images, which the runtime gets of the browser. videos.json has
// what its file states. files.json holds files in base 16 and what becomes of them. IMGEO_REWRITE_GOLDEN=1 writes all
// files again: other packets mean another version of libvpx, anything else a new version of the format.
#include "base/error.h"
#include "base/error_testing.h"
#include "base/file.h"
#include "base/testing.h"
#include "sequence/sequence_samples.h"
#include "video/sequence_video.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <libdeflate.h>
#include <nlohmann/json.hpp>

namespace imgeo {
namespace {

using Json = nlohmann::ordered_json;
using testing::SequenceSample;
const std::filesystem::path folder = IMGEO_VECTORS "/video-1";

Bytes encodedVideoOf(const SequenceSample& sample) {
  const VideoSize size = videoSizeOf(sample.index.description.layout, "");
  return writeWebm(size, encodeVideoFrames(sample.frames, size, 5), sample.index.description.rate);
}

Bytes pixelsOf(const SequenceSample& sample) {
  Bytes pixels;
  for (const live::Frame& frame : sample.frames) {
    const Bytes image = videoImageOf(frame, videoSizeOf(frame.layout, ""));
    pixels.insert(pixels.end(), image.begin(), image.end());
  }
  return pixels;
}

Json describe(const Bytes& file) {
  const WebmVideo video = readWebm(file, "");
  Json packets = Json::array();
  for (const VideoPacket& packet : video.packets)
    packets.push_back({{"bytes", packet.bytes.size()},
                       {"crc32", libdeflate_crc32(0, packet.bytes.data(), packet.bytes.size())},
                       {"isKey", packet.isKey}});
  return {{"width", video.size.width}, {"height", video.size.height}, {"packets", packets}};
}

std::string verdictOn(const Bytes& file) {
  try {
    readWebm(file, "");
    return "read";
  } catch (const Error& error) {
    return imgeo::testing::nameOf(error.kind());
  }
}

/// A file with the bytes of `what` replaced by those of `with`.
Bytes replaced(Bytes file, std::string_view what, std::string_view with) {
  const std::size_t at = asText(file).find(what);
  EXPECT_NE(at, std::string_view::npos);
  for (std::size_t i = 0; i < with.size(); ++i)
    file.at(at + i) = static_cast<std::uint8_t>(with[i]);
  return file;
}

std::vector<std::pair<std::string, Bytes>> files() {
  const Bytes video = encodedVideoOf(testing::sequenceSample("grid", {12, 4}, 2, 50));
  const std::string_view text = asText(video);
  const std::size_t cluster = text.find("\x1f\x43\xb6\x75"), block = text.find("\xa3", cluster);
  Bytes lacing = video, track = video, endless = video, unknownSize = video;
  lacing.at(block + 8) |= 2;
  track.at(block + 5) = 0x82; // no other block of the track: the second image remains
  for (std::size_t i = 1; i < 4; ++i)
    endless.at(cluster + 4 + i - 1) = 0xff;
  endless.at(cluster + 4) = 0x1f;
  endless.at(cluster + 7) = 0xff;
  unknownSize.at(block + 1) = 0x1f;
  for (std::size_t i = 2; i < 5; ++i)
    unknownSize.at(block + i) = 0xff;
  return {
      {"a video", video},
      {"a cluster without a size", endless},
      {"an empty file", {}},
      {"no EBML", replaced(video, "\x1a\x45\xdf\xa3", "RIFF")},
      {"cut at the end", {video.begin(), video.end() - 1}},
      {"cut in its head", {video.begin(), video.begin() + 60}},
      {"another codec", replaced(video, "V_VP9", "V_VP8")},
      {"no track", replaced(video, "\xae", "\xec")},
      {"a track of sound", replaced(video, std::string_view("\x83\x10\0\0\x08\0\0\0\0\0\0\0\x01", 13),
                                    std::string_view("\x83\x10\0\0\x08\0\0\0\0\0\0\0\x02", 13))},
      {"several images in a block", lacing},
      {"an image of another track", track},
      {"a block without a size", unknownSize},
      {"images without a size", replaced(video, std::string_view("\xb0\x10\0\0\x08\0\0\0\0\0\0\0\x08", 13),
                                         std::string_view("\xb0\x10\0\0\x08\0\0\0\0\0\0\0\0", 13))},
      {"images that are too wide", replaced(video, std::string_view("\xb0\x10\0\0\x08\0\0\0\0\0\0\0\x08", 13),
                                            std::string_view("\xb0\x10\0\0\x08\0\0\0\0\0\0\x41\x08", 13))},
  };
}

void rewrite() {
  std::filesystem::create_directories(folder);
  Json videos;
  for (const SequenceSample& sample : testing::sequenceSamples()) {
    const Bytes file = encodedVideoOf(sample);
    writeFile(folder / (sample.name + ".webm"), file);
    writeFile(folder / (sample.name + ".rgb"), pixelsOf(sample));
    videos[sample.name] = describe(file);
  }
  writeFile(folder / "videos.json", asBytes(videos.dump(1) + "\n"));
  Json all = Json::array();
  for (const auto& [name, file] : files())
    all.push_back({{"name", name}, {"file", imgeo::testing::base16Of(file)}, {"verdict", verdictOn(file)}});
  writeFile(folder / "files.json", asBytes(all.dump() + "\n"));
}

class VideoVectors : public ::testing::Test {
protected:
  static void SetUpTestSuite() {
    if (std::getenv("IMGEO_REWRITE_GOLDEN") != nullptr)
      rewrite();
  }
};

TEST_F(VideoVectors, AreTheFramesOfTheSequences) {
  const Json videos = Json::parse(asText(readFile(folder / "videos.json")));
  for (const SequenceSample& sample : testing::sequenceSamples()) {
    SCOPED_TRACE(sample.name);
    const Bytes file = readFile(folder / (sample.name + ".webm"));
    EXPECT_EQ(describe(file), videos.at(sample.name));
    EXPECT_EQ(pixelsOf(sample), readFile(folder / (sample.name + ".rgb")));
    std::size_t same = 0;
    decodeVideoFrames(file, sample.index, 0, sample.index.frameCount(), "",
                      [&](const live::Frame& frame) { same += frame == sample.frames.at(frame.number); });
    EXPECT_EQ(same, sample.frames.size());
  }
}

TEST_F(VideoVectors, AreReadOrRefusedAsTheRuntimeDoes) {
  const Json all = Json::parse(asText(readFile(folder / "files.json")));
  for (const Json& each : all)
    EXPECT_EQ(verdictOn(imgeo::testing::bytesOfBase16(each.at("file"))), each.at("verdict").get<std::string>())
        << each.at("name");
}

} // namespace
} // namespace imgeo
