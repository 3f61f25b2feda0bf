#include "base/error.h"
#include "sequence/sequence_samples.h"
#include "video/sequence_video.h"
#include "video/vp9.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::SequenceSample;
using testing::sequenceSample;

std::vector<Bytes> packetsOf(const SequenceSample& sample) {
  return encodeVideoFrames(sample.frames, videoSizeOf(sample.index.description.layout, ""), 0);
}

Bytes videoOf(const SequenceSample& sample, const std::vector<Bytes>& packets) {
  return writeWebm(videoSizeOf(sample.index.description.layout, ""), packets, 25);
}
Bytes videoOf(const SequenceSample& sample) {
  return videoOf(sample, packetsOf(sample));
}

std::vector<live::Frame> framesOf(const Bytes& video, const SequenceIndex& index, std::uint32_t first = 0) {
  std::vector<live::Frame> frames;
  decodeVideoFrames(video, index, first, index.frameCount(), "video.webm",
                    [&](const live::Frame& frame) { frames.push_back(frame); });
  return frames;
}

std::string refusalOf(const Bytes& video, const SequenceIndex& index) {
  try {
    framesOf(video, index);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(SequenceVideo, KeepsEveryBitOfFramesOfEveryLayout) {
  for (const SequenceSample& sample : testing::sequenceSamples()) {
    const Bytes video = videoOf(sample);
    EXPECT_EQ(framesOf(video, sample.index), sample.frames) << sample.name;
    EXPECT_EQ(videoOf(sample), video) << sample.name;
  }
}

TEST(SequenceVideo, BeginsAtAnyFrame) {
  const SequenceSample first = sequenceSample("s", {200, 20}, 6, 90);
  std::vector<Bytes> packets = packetsOf(first);
  for (const Bytes& packet : packetsOf(first)) // as if a second file of frames followed
    packets.push_back(packet);
  EXPECT_EQ(isKeyPacket(packets[6]), true);
  EXPECT_EQ(isKeyPacket(packets[7]), false);
  const Bytes video = videoOf(first, {packets.begin(), packets.begin() + 6});
  for (std::uint32_t from = 0; from < 6; ++from) {
    const std::vector<live::Frame> frames = framesOf(video, first.index, from);
    ASSERT_EQ(frames.size(), 6 - from);
    EXPECT_EQ(frames[0], first.frames[from]);
  }
  EXPECT_EQ(readWebm(videoOf(first, packets), "").packets.size(), 12u);
}

TEST(SequenceVideo, StatesTimesOfItsRate) {
  const SequenceSample sample = sequenceSample("s", {12, 4}, 3, 1);
  const Bytes video = videoOf(sample);
  const WebmVideo read = readWebm(video, "");
  ASSERT_EQ(read.packets.size(), 3u);
  EXPECT_NEAR(read.packets[2].time, 0.08, 1e-9);
}

TEST(SequenceVideo, ThatIsNotLosslessIsRefused) {
  const SequenceSample sample = sequenceSample("s", {400, 20}, 3, 50);
  const VideoSize size = videoSizeOf(sample.index.description.layout, "");
  std::vector<Bytes> packets = packetsOf(sample);
  Vp9Encoder encoder(size, 6);
  for (std::size_t i = 0; i < packets.size(); ++i) {
    Bytes pixels = videoImageOf(sample.frames[i], size);
    pixels[i == 1 ? 17 : 0] ^= i == 1; // the smallest error of one channel of one pixel
    packets[i] = encoder.encode(pixels);
  }
  EXPECT_EQ(refusalOf(videoOf(sample, packets), sample.index),
            "video.webm: the pixels of frame 1 are not those that were recorded: the video is not lossless");
}

TEST(SequenceVideo, ThatIsWrongIsRefused) {
  const SequenceSample sample = sequenceSample("s", {400, 20}, 3, 50);
  const std::vector<Bytes> packets = packetsOf(sample);
  const Bytes video = videoOf(sample);
  EXPECT_EQ(refusalOf(video, sample.index), "");
  EXPECT_EQ(refusalOf({}, sample.index), "video.webm: is no WebM video");
  EXPECT_EQ(refusalOf(sample.bytes, sample.index), "video.webm: is no WebM video");
  EXPECT_EQ(refusalOf({video.begin(), video.end() - 1}, sample.index), "video.webm: is cut");
  EXPECT_EQ(refusalOf({video.begin(), video.begin() + 300}, sample.index), "video.webm: is cut");
  EXPECT_EQ(refusalOf(videoOf(sample, {packets.begin(), packets.end() - 1}), sample.index),
            "video.webm: has 2 images; its index states 3 frames");
  EXPECT_EQ(refusalOf(videoOf(sample, {packets[0], packets[2], packets[1]}), sample.index).substr(0, 12),
            "video.webm: ");
  EXPECT_EQ(refusalOf(videoOf(sample, {packets[0], {0xa4, 1, 2, 3}, packets[1]}), sample.index),
            "video.webm: image 1 cannot be decoded");
  EXPECT_EQ(refusalOf(videoOf(sample, {packets[0], {0x80}, packets[1]}), sample.index),
            "video.webm: has no VP9 of profile 1, which has RGB, in image 1");
  SequenceIndex other = sample.index;
  other.description.layout.columns = 40;
  EXPECT_EQ(refusalOf(video, other), "video.webm: has images of 20 x 41 pixels; those of its frames have 40 x 21");
  EXPECT_EQ(refusalOf(writeWebm({21, 41}, packets, 25), sample.index),
            "video.webm: has images of 21 x 41 pixels; those of its frames have 20 x 41");
  const SequenceSample larger = sequenceSample("l", {800, 20}, 1, 0);
  EXPECT_EQ(refusalOf(videoOf(sample, {packetsOf(larger)[0], packets[1], packets[2]}), sample.index),
            "video.webm: image 0 has another size than its file states");
}

TEST(SequenceVideo, OfFramesThatAreTooLargeIsRefused) {
  EXPECT_THROW(videoSizeOf({20000, 20000}, ""), Error);
  EXPECT_THROW(videoSizeOf({1 << 22, 0, 24, 16, 4, 4, 24}, ""), Error);
  EXPECT_EQ(videoSizeOf({3, 0}, ""), (VideoSize{8, 3}));
}

} // namespace
} // namespace imgeo
