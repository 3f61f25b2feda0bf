#include "base/error.h"
#include "sequence/sequence_samples.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::sequenceSample;
using testing::SequenceSample;
using testing::sequenceSamples;

std::vector<live::Frame> decoded(const SequenceSample& sample, const Bytes& bytes, std::uint32_t end = UINT32_MAX) {
  std::vector<live::Frame> frames;
  decodeSequenceFile(
      bytes, sample.index, 0, "frames.igf", [&](const live::Frame& frame) { frames.push_back(frame); }, end);
  return frames;
}

std::string refusalOf(const std::string& json) {
  try {
    readSequenceIndex(json, "index.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string refusalOf(const SequenceSample& sample, const Bytes& bytes) {
  try {
    decoded(sample, bytes);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  return text.replace(text.find(what), what.size(), with);
}

TEST(Sequence, KeepsAllFramesExactly) {
  for (const SequenceSample& sample : sequenceSamples())
    EXPECT_EQ(decoded(sample, sample.bytes), sample.frames) << sample.name;
}

TEST(Sequence, StoresDifferencesWhereTheyAreShorter) {
  const SequenceSample moving = sequenceSample("moving", {400, 0}, 6, 5);
  std::size_t alone = 0;
  for (const live::Frame& frame : moving.frames)
    alone += encodeFrame(frame).size();
  EXPECT_LT(moving.bytes.size(), alone * 3 / 4);

  SequenceSample noise = sequenceSample("noise", {400, 0}, 1, 0);
  noise.frames = {live::testing::noiseFrame({400, 0}, 1), live::testing::noiseFrame({400, 0}, 2)};
  EXPECT_LE(encodeSequenceFile(noise.frames, 1).size(),
            encodeFrame(noise.frames[0]).size() + encodeFrame(noise.frames[1]).size());
}

TEST(Sequence, IsReadUpToAFrame) {
  const SequenceSample sample = sequenceSample("sample", {35, 7}, 4, 3);
  EXPECT_EQ(decoded(sample, sample.bytes, 2), std::vector(sample.frames.begin(), sample.frames.begin() + 2));
}

TEST(Sequence, ThatIsDamagedIsRefusedWithTheNumberOfTheFrame) {
  const SequenceSample sample = sequenceSample("sample", {35, 7}, 3, 3);
  Bytes cut = sample.bytes, longer = sample.bytes, changed = sample.bytes;
  cut.pop_back();
  longer.push_back(0);
  changed.back() ^= 1;
  EXPECT_EQ(refusalOf(sample, cut).substr(0, 39), "frames.igf, frame 2: the frame is cut: ");
  EXPECT_EQ(refusalOf(sample, longer), "frames.igf: bytes follow the last frame");
  EXPECT_EQ(refusalOf(sample, changed), "frames.igf, frame 2: the frame's compressed bytes are damaged");
  EXPECT_EQ(refusalOf(sample, {}), "frames.igf, frame 0: the file ends before the frame");
  SequenceSample other = sample;
  other.index.description.layout.columns = 5;
  EXPECT_EQ(refusalOf(other, sample.bytes), "frames.igf, frame 0: has other vertices or attributes than the sequence");
  const Bytes difference = encodeDifference(sample.frames[1], sample.frames[0], live::Prediction::none, 1);
  EXPECT_EQ(refusalOf(sample, difference), "frames.igf, frame 0: is a difference to a frame that is not there");
  EXPECT_THROW(live::decodeFrame(difference, "a stream"), Error);
}

TEST(SequenceIndex, IsWrittenAndReadAgain) {
  for (SequenceSample& sample : sequenceSamples()) {
    sample.index.files.push_back({"b-2.igf", 25, 12345});
    EXPECT_EQ(readSequenceIndex(writeSequenceIndex(sample.index), ""), sample.index) << sample.name;
  }
}

TEST(SequenceIndex, FindsTheFileOfAFrame) {
  SequenceIndex index;
  index.files = {{"a", 30, 1}, {"b", 30, 1}, {"c", 5, 1}};
  EXPECT_EQ(index.frameCount(), 65u);
  EXPECT_EQ(index.fileOf(29), 0u);
  EXPECT_EQ(index.fileOf(30), 1u);
  EXPECT_EQ(index.fileOf(64), 2u);
  EXPECT_EQ(index.firstFrameOf(2), 60u);
}

TEST(SequenceIndex, ThatIsWrongIsRefused) {
  const std::string good = writeSequenceIndex(sequenceSample("s", {35, 7}, 3, 3).index);
  EXPECT_EQ(refusalOf(good), "");
  EXPECT_EQ(refusalOf("[1]"), "index.json: is no index of a sequence: it is no JSON object");
  EXPECT_EQ(refusalOf("{}"), "index.json: is no index of a sequence: it states no \"version\"");
  EXPECT_EQ(refusalOf(replaced(good, "\"version\": 1", "\"version\": 2")),
            "index.json: is a sequence of another version; only 1 is read");
  EXPECT_EQ(refusalOf(replaced(good, "\"rate\": 25", "\"rate\": 0")),
            "index.json: the sequence states no \"rate\" above 0");
  EXPECT_EQ(refusalOf(replaced(good, "s.igf", "../s.igf")),
            "index.json: a \"url\" of the sequence is no name of a file beside its index");
  EXPECT_EQ(refusalOf(replaced(good, "\"frames\": 3", "\"frames\": 0")),
            "index.json: a file of the sequence states no \"frames\"");
  EXPECT_EQ(refusalOf(replaced(good, "\"frames\": 3", "\"frames\": 1025")),
            "index.json: a file of the sequence has more than 1024 frames");
  EXPECT_EQ(refusalOf(replaced(good, "\"files\"", "\"file\"")), "index.json: the sequence has no files");
}

} // namespace
} // namespace imgeo
