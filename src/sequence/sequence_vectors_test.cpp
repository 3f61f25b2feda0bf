// Checks vectors/sequence-1, which web/src/decode/sequence checks as well. NAME.index.json is an index, NAME.igf its
// only file, whose frames' stored integers NAME.json has, frame by frame and component by component. refused.json holds
// indexes and files in base 16 and the kind of error. IMGEO_REWRITE_GOLDEN=1 writes all files again; a file that
// changes means a new version of the format.
#include "base/error.h"
#include "base/error_testing.h"
#include "base/file.h"
#include "base/testing.h"
#include "sequence/sequence_samples.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace imgeo {
namespace {

using Json = nlohmann::ordered_json;
using testing::SequenceSample;
const std::filesystem::path folder = IMGEO_VECTORS "/sequence-1";

Json integersOf(const SequenceIndex& index, const Bytes& bytes) {
  Json frames = Json::array();
  decodeSequenceFile(bytes, index, 0, "", [&](const live::Frame& frame) {
    Json components = Json::array();
    for (std::uint32_t i = 0; i < componentCount(frame.layout); ++i)
      components.push_back(std::vector(frame.component(i).begin(), frame.component(i).end()));
    frames.push_back(std::move(components));
  });
  return frames;
}

std::string verdictOn(const std::string& index, const Bytes& file) {
  try {
    decodeSequenceFile(file, readSequenceIndex(index, ""), 0, "", [](const live::Frame&) {});
    return "decoded";
  } catch (const Error& error) {
    return imgeo::testing::nameOf(error.kind());
  }
}

std::string withText(std::string text, const std::string& what, const std::string& with) {
  return text.replace(text.find(what), what.size(), with);
}

struct RefusedSequence {
  std::string name, index;
  Bytes file;
};

std::vector<RefusedSequence> refusedSequences() {
  const SequenceSample sample = testing::sequenceSample("grid", {12, 4}, 3, 50);
  const std::string index = writeSequenceIndex(sample.index);
  const Bytes& file = sample.bytes;
  const Bytes cut(file.begin(), file.end() - 1), inHeader(file.begin(), file.begin() + 30);
  Bytes longer = file, damaged = file, version = file;
  longer.push_back(0);
  damaged.back() ^= 1;
  version[3] = 2;
  std::vector<live::Frame> swapped{sample.frames[1], sample.frames[0], sample.frames[2]};
  std::vector<live::Frame> epoch = sample.frames;
  epoch[1].epoch = 1;
  return {
      {"empty file", index, {}},
      {"cut in a frame", index, cut},
      {"cut in a header", index, inHeader},
      {"bytes after the last frame", index, longer},
      {"damaged frame", index, damaged},
      {"frames of another version", index, version},
      {"begins with a difference", index,
       encodeDifference(sample.frames[1], sample.frames[0], live::Prediction::none, 1)},
      {"frames in another order", index, encodeSequenceFile(swapped, 1)},
      {"frames of another epoch", index, encodeSequenceFile(epoch, 1)},
      {"fewer frames than stated", withText(index, "\"frames\": 3", "\"frames\": 4"), file},
      {"more frames than stated", withText(index, "\"frames\": 3", "\"frames\": 2"), file},
      {"another layout", withText(index, "\"columns\": 4", "\"columns\": 3"), file},
      {"no JSON", "{", file},
      {"a list", "[]", file},
      {"no version", withText(index, "version", "revision"), file},
      {"version 2", withText(index, "\"version\": 1", "\"version\": 2"), file},
      {"no rate", withText(index, "\"rate\": 25", "\"rate\": 0"), file},
      {"a rate above 1000", withText(index, "\"rate\": 25", "\"rate\": 1001"), file},
      {"no files", withText(index, "files", "file"), file},
      {"no vertices", withText(index, "\"vertices\": 12", "\"vertices\": 0"), file},
      {"too many frames in a file", withText(index, "\"frames\": 3", "\"frames\": 1025"), file},
      {"no bytes", withText(index, "\"bytes\"", "\"size\""), file},
      {"a file elsewhere", withText(index, "grid.igf", "../grid.igf"), file},
      {"a file at another host", withText(index, "grid.igf", "//a/grid.igf"), file},
  };
}

void rewrite() {
  std::filesystem::create_directories(folder);
  const auto write = [](const std::string& name, const std::string& text) { writeFile(folder / name, asBytes(text)); };
  for (const SequenceSample& sample : testing::sequenceSamples()) {
    write(sample.name + ".index.json", writeSequenceIndex(sample.index));
    writeFile(folder / (sample.name + ".igf"), sample.bytes);
    write(sample.name + ".json", integersOf(sample.index, sample.bytes).dump() + "\n");
  }
  Json refused = Json::array();
  for (const auto& [name, index, file] : refusedSequences())
    refused.push_back({{"name", name},
                       {"index", index},
                       {"file", imgeo::testing::base16Of(file)},
                       {"verdict", verdictOn(index, file)}});
  write("refused.json", refused.dump() + "\n");
}

std::string textOf(const std::string& name) {
  return std::string(asText(readFile(folder / name)));
}

class SequenceVectors : public ::testing::Test {
protected:
  static void SetUpTestSuite() {
    if (std::getenv("IMGEO_REWRITE_GOLDEN") != nullptr)
      rewrite();
  }
};

TEST_F(SequenceVectors, AreDecodedExactly) {
  for (const SequenceSample& sample : testing::sequenceSamples()) {
    const SequenceIndex index = readSequenceIndex(textOf(sample.name + ".index.json"), sample.name);
    EXPECT_EQ(integersOf(index, readFile(folder / (sample.name + ".igf"))), Json::parse(textOf(sample.name + ".json")))
        << sample.name;
  }
}

TEST_F(SequenceVectors, EqualWhatTheEncoderWrites) {
  for (const SequenceSample& sample : testing::sequenceSamples()) {
    EXPECT_EQ(sample.bytes, readFile(folder / (sample.name + ".igf"))) << sample.name;
    EXPECT_EQ(writeSequenceIndex(sample.index), textOf(sample.name + ".index.json")) << sample.name;
  }
}

TEST_F(SequenceVectors, OfDamagedSequencesAreRefused) {
  const Json refused = Json::parse(textOf("refused.json"));
  EXPECT_GT(refused.size(), 20u);
  for (const Json& entry : refused) {
    const std::string verdict = verdictOn(entry.at("index"), imgeo::testing::bytesOfBase16(entry.at("file")));
    EXPECT_NE(verdict, "decoded") << entry;
    EXPECT_EQ(verdict, entry.at("verdict").get<std::string>()) << entry;
  }
}

} // namespace
} // namespace imgeo
