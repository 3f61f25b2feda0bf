// Checks the test vectors in vectors/compact-1 and compact-2, one folder for each version of the format, which readers
// in every language share. NAME.png holds the patches of
// NAME.json. edits.json lists edits of payloads and the verdict on each: the kind of error, or the FNV-1a sum of the
// decoded numbers. refused.json holds whole payloads in base 16. IMGEO_REWRITE_GOLDEN=1 writes all files again; an
// existing file that changes means a new version of the format.
#include "base/file.h"
#include "base/testing.h"
#include "containers/compact/patch_coding.h"
#include "containers/compact/patch_samples.h"
#include "containers/compact/payload_image.h"
#include "containers/compact/refused_payloads.h"
#include "containers/compact/verdict.h"

#include <cctype>
#include <cstdlib>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace imgeo::compact {
namespace {

using Json = nlohmann::ordered_json;

/// The vectors of a version of the format.
class Folder {
public:
  explicit Folder(Version version)
      : version_(version), path_(IMGEO_VECTORS "/compact-" + std::to_string(static_cast<int>(version))) {}

  Version version() const { return version_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  /// The files of a version, which have its features.
  std::vector<testing::Sample> files() const { return testing::files(version_); }

  void write(const std::string& name, const nlohmann::ordered_json& json) const {
    const std::string text = json.dump() + "\n";
    writeFile(path_ / name, asBytes(text));
  }
  nlohmann::ordered_json read(const std::string& name) const {
    return nlohmann::ordered_json::parse(asText(readFile(path_ / name)));
  }

private:
  Version version_;
  std::filesystem::path path_;
};

Json jsonOf(const CompactPatch& patch) {
  Json json{{"topology", static_cast<int>(patch.topology)},
            {"positionBits", patch.positionBits},
            {"positions", Json::array()},
            {"wedgePositions", Json::array()},
            {"corners", Json::array()},
            {"attributes", Json::array()}};
  if (patch.segmentCount > 0)
    json["partCount"] = patch.segmentCount;
  testing::visitNumbers(patch, [&](const char* name, std::int64_t number) { json[name].push_back(number); });
  for (const Attribute& attribute : patch.attributes) {
    const AttributeType& type = attribute.type;
    Json& entry = json["attributes"].emplace_back();
    entry = {{"kind", static_cast<int>(type.kind)},
             {"components", type.components},
             {"bits", type.bits},
             {"mode", static_cast<int>(type.mode)},
             {"values", Json::array()}};
    for (const Value& value : attribute.values)
      for (std::uint32_t i = 0; i < type.components; ++i)
        entry["values"].push_back(value[i]);
  }
  return json;
}

Json jsonOf(const std::vector<CompactPatch>& patches) {
  Json json = Json::array();
  for (const CompactPatch& patch : patches)
    json.push_back(jsonOf(patch));
  return json;
}

/// The verdict on a payload: a number if it decodes, otherwise the kind of error.
Json verdictOn(const Bytes& payload) {
  const std::string verdict = testing::verdictOn(payload);
  return std::isdigit(static_cast<unsigned char>(verdict.front())) ? Json(std::stoul(verdict)) : Json(verdict);
}

/// A payload after the edits of an entry: "edits" are pairs [byte offset, value]; "length", if given, cuts the payload.
Bytes edited(Bytes payload, const Json& entry) {
  for (const Json& edit : entry.at("edits"))
    payload.at(edit.at(0).get<std::size_t>()) = edit.at(1).get<std::uint8_t>();
  if (entry.contains("length"))
    payload.resize(entry.at("length").get<std::size_t>());
  return payload;
}

/// Entries with changed bytes in the header, with one or two changed bytes anywhere, and with a payload cut anywhere.
Json editsOf(const std::string& name, const Bytes& payload, std::uint32_t seed) {
  Json entries = Json::array();
  const auto add = [&](Json edits, std::optional<std::size_t> length = {}) {
    Json entry{{"file", name}, {"edits", std::move(edits)}};
    if (length)
      entry["length"] = *length;
    entry["verdict"] = verdictOn(edited(payload, entry));
    entries.push_back(entry);
  };
  testing::Random random(seed);
  for (std::size_t at = 0; at < std::min<std::size_t>(payload.size(), 64); ++at)
    for (const int value : {0, 1, 2, 17, 31, 32, 128, 255})
      if (value != payload[at] && random.oneIn(3))
        add({{at, value}});
  for (int i = 0; i < 40; ++i)
    add({{random.below(payload.size()), random.below(256)}});
  for (int i = 0; i < 10; ++i)
    add({{random.below(payload.size()), random.below(256)}, {random.below(payload.size()), random.below(256)}});
  for (int i = 0; i < 10; ++i)
    add(Json::array(), random.below(payload.size()));
  return entries;
}

void rewrite(const Folder& folder) {
  std::filesystem::create_directories(folder.path());
  Json edits = Json::array();
  std::uint32_t seed = 0;
  for (const testing::Sample& sample : folder.files()) {
    const Bytes payload = encodePatches(sample.patches, 0, folder.version()).bytes;
    writeFile(folder / (sample.name + ".png"), imageOfPayload(payload));
    folder.write(sample.name + ".json", jsonOf(decodePatches(payload, "")));
    for (Json& entry : editsOf(sample.name, payload, ++seed))
      edits.push_back(std::move(entry));
  }
  folder.write("edits.json", edits);
  Json refused = Json::array();
  for (const auto& [name, payload] : testing::refusedPayloads(folder.version()))
    refused.push_back(
        {{"name", name}, {"payload", imgeo::testing::base16Of(payload)}, {"verdict", verdictOn(payload)}});
  folder.write("refused.json", refused);
}

class Vectors : public ::testing::TestWithParam<Version> {
protected:
  static void SetUpTestSuite() {
    if (std::getenv("IMGEO_REWRITE_GOLDEN") != nullptr)
      for (const Version version : {Version::one, Version::two})
        rewrite(Folder(version));
  }

  const Folder folder{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(, Vectors, ::testing::Values(Version::one, Version::two),
                         [](const auto& each) { return each.param == Version::one ? "Version1" : "Version2"; });

TEST_P(Vectors, AreDecodedExactly) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    if (entry.path().extension() != ".png")
      continue;
    const std::string name = entry.path().stem();
    const Json expected = folder.read(name + ".json");
    const Bytes payload = payloadOfImage(readFile(entry.path()), name);
    EXPECT_EQ(jsonOf(decodePatches(payload, name)), expected) << name;
    ++count;
  }
  EXPECT_GT(count, 15u);
}

TEST_P(Vectors, EqualWhatTheEncoderWrites) {
  for (const testing::Sample& sample : folder.files())
    EXPECT_EQ(imageOfPayload(encodePatches(sample.patches, 0, folder.version()).bytes),
              readFile(folder / (sample.name + ".png")))
        << sample.name;
}

TEST_P(Vectors, OfInvalidPayloadsAreRefused) {
  const Json refused = folder.read("refused.json");
  EXPECT_GT(refused.size(), 10u);
  for (const Json& entry : refused) {
    const Json verdict = verdictOn(imgeo::testing::bytesOfBase16(entry.at("payload")));
    EXPECT_TRUE(verdict.is_string()) << entry;
    EXPECT_EQ(verdict, entry.at("verdict")) << entry;
  }
}

TEST_P(Vectors, AreRefusedOrDecodedAsStatedAfterEdits) {
  std::map<std::string, Bytes> payloads;
  std::map<std::string, std::size_t> verdicts;
  for (const Json& entry : folder.read("edits.json")) {
    const std::string name = entry.at("file");
    if (!payloads.contains(name))
      payloads[name] = payloadOfImage(readFile(folder / (name + ".png")), name);
    const Json verdict = verdictOn(edited(payloads[name], entry));
    EXPECT_EQ(verdict, entry.at("verdict")) << entry;
    ++verdicts[verdict.is_string() ? verdict.get<std::string>() : "decoded"];
  }
  for (const char* verdict : {"truncated", "malformed", "unsupported", "limit", "decoded"})
    EXPECT_GT(verdicts[verdict], 5u) << verdict;
}

} // namespace
} // namespace imgeo::compact
