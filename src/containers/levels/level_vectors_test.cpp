// Checks the test vectors in vectors/levels-1, which readers in every language share. NAME.png is an index of levels,
// NAME-1.png … its further pages, and NAME.json what they say. edits.json lists edits of payloads and the verdict on
// each: the kind of error, or the FNV-1a sum of all numbers. refused.json holds whole payloads in base 16.
// IMGEO_REWRITE_GOLDEN=1 writes all files again; a file that changes means a new version of the format.
#include "base/error.h"
#include "base/error_testing.h"
#include "base/file.h"
#include "base/testing.h"
#include "containers/compact/payload_image.h"
#include "containers/levels/level_samples.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace imgeo {
namespace {

using Json = nlohmann::ordered_json;
using testing::LevelSample;
const std::filesystem::path levelVectors = IMGEO_VECTORS "/levels-1";

Json levelJsonOf(const LevelIndex& index) {
  Json json{{"positionBits", index.positionBits},
            {"pageGroups", index.pageGroups},
            {"rootCount", index.rootCount},
            {"hasPoints", index.hasPoints},
            {"groups", Json::array()}};
  for (const LevelGroup& group : index.groups) {
    const Vec3<std::uint16_t>& center = group.sphere.center;
    json["groups"].push_back({{"level", group.level},
                              {"center", {center.x, center.y, center.z}},
                              {"radius", group.sphere.radius},
                              {"error", group.errorCode},
                              {"vertices", group.vertices},
                              {"triangles", group.triangles},
                              {"bytes", group.bytes},
                              {"children", group.children}});
    if (index.hasChips)
      json["groups"].back()["chips"] = {group.chipColumns, group.chipRows, group.chipBytes};
  }
  return json;
}

/// FNV-1a over every number of an index, as four little-endian bytes each, in the order of its JSON.
std::uint32_t sumOf(const LevelIndex& index) {
  std::uint32_t hash = 2166136261u;
  const auto add = [&](std::uint32_t number) {
    for (int shift = 0; shift < 32; shift += 8)
      hash = (hash ^ (number >> shift & 255)) * 16777619u;
  };
  add(index.positionBits), add(index.pageGroups), add(index.rootCount), add(index.hasPoints);
  for (const LevelGroup& group : index.groups) {
    const Vec3<std::uint16_t>& center = group.sphere.center;
    for (const std::uint32_t number : {std::uint32_t{group.level}, std::uint32_t{center.x}, std::uint32_t{center.y},
                                       std::uint32_t{center.z}, std::uint32_t{group.sphere.radius},
                                       std::uint32_t{group.errorCode}, group.vertices, group.triangles, group.bytes})
      add(number);
    for (const std::uint32_t child : group.children)
      add(child);
    if (index.hasChips)
      add(group.chipColumns), add(group.chipRows), add(group.chipBytes);
  }
  return hash;
}

Json levelVerdictOn(const std::vector<Bytes>& payloads) {
  try {
    return sumOf(readLevelPayloads(payloads, "levels.png"));
  } catch (const Error& error) {
    return imgeo::testing::nameOf(error.kind());
  }
}

std::vector<Bytes> levelPayloadsOf(const LevelIndex& index) {
  std::vector<Bytes> payloads;
  for (const Bytes& file : writeLevelIndex(index))
    payloads.push_back(compact::payloadOfImage(file, ""));
  return payloads;
}

std::vector<Bytes> editedPayloads(std::vector<Bytes> payloads, const Json& entry) {
  Bytes& payload = payloads.at(entry.at("page"));
  for (const Json& edit : entry.at("edits"))
    payload.at(edit.at(0)) = edit.at(1);
  if (entry.contains("length"))
    payload.resize(entry.at("length"));
  return payloads;
}

Json randomEdits() {
  testing::Random random(7);
  Json entries = Json::array();
  for (const LevelSample& sample : testing::levelSamples()) {
    const std::vector<Bytes> payloads = levelPayloadsOf(sample.index);
    for (int n = 0; n < 250; ++n) {
      const std::uint32_t page = random.below(payloads.size());
      const std::uint32_t size = static_cast<std::uint32_t>(payloads[page].size());
      Json entry{{"name", sample.name}, {"page", page}, {"edits", Json::array()}};
      if (random.oneIn(8))
        entry["length"] = random.below(size);
      else
        entry["edits"].push_back(
            {n < 20 ? std::min<std::uint32_t>(static_cast<std::uint32_t>(n), size - 1) : random.below(size),
             random.oneIn(2) ? random.below(256) : random.below(3)});
      entry["verdict"] = levelVerdictOn(editedPayloads(payloads, entry));
      entries.push_back(std::move(entry));
    }
  }
  return entries;
}

struct RefusedLevels {
  std::string name;
  std::vector<Bytes> payloads;
};

/// Payloads that are refused, each for another reason.
std::vector<RefusedLevels> refusedLevels() {
  const LevelIndex index = testing::levelIndexOf({1, 3, 5}, 16, 4, 6);
  const std::vector<Bytes> payloads = levelPayloadsOf(index);
  std::vector<RefusedLevels> refused{{"no bytes", {{}}}, {"without the last page", {payloads[0], payloads[1]}}};
  const auto edit = [&](const std::string& name, std::size_t byte, std::uint8_t value) {
    refused.push_back({name, payloads});
    refused.back().payloads[0][byte] = value;
  };
  edit("another signature", 2, 'C');
  edit("version 3", 3, 3);
  edit("unknown features", 4, 2);
  refused.push_back({"a page with other features", payloads});
  refused.back().payloads[1][4] = pointsFeature;
  edit("another page", 5, 1);
  edit("no groups", 6, 0);
  edit("no groups a page", 7, 0);
  edit("no roots", 8, 0);
  edit("more roots than groups", 8, 10);
  edit("no position bits", 9, 0);
  edit("25 position bits", 9, 25);
  refused.push_back({"pages in another order", {payloads[0], payloads[2], payloads[1]}});
  const auto change = [&](const std::string& name, auto apply) {
    LevelIndex changed = index;
    apply(changed);
    refused.push_back({name, levelPayloadsOf(changed)});
  };
  change("level 32", [](LevelIndex& to) { to.groups[0].level = 32; });
  change("levels in another order", [](LevelIndex& to) { to.groups[2].level = 0; });
  change("a root that is none", [](LevelIndex& to) { to.rootCount = 2; });
  change("a root with an error", [](LevelIndex& to) { to.groups[0].errorCode = 254; });
  change("a group with the error of a root", [](LevelIndex& to) { to.groups[3].errorCode = 255; });
  change("a child of equal error", [](LevelIndex& to) { to.groups.back().errorCode = to.groups[3].errorCode; });
  change("a child of larger error", [](LevelIndex& to) { to.groups.back().errorCode = 254; });
  change("a child outside", [](LevelIndex& to) { to.groups.back().sphere.radius = 65534; });
  change("a child far away", [](LevelIndex& to) { to.groups[0].sphere.radius = 1; });
  change("an unbounded child", [](LevelIndex& to) { to.groups[2].sphere.radius = unboundedRadiusCode; });
  change("no vertices", [](LevelIndex& to) { to.groups[1].vertices = 0; });
  change("too many vertices", [](LevelIndex& to) { to.groups[1].vertices = maxGroupCount + 1; });
  change("no triangles", [](LevelIndex& to) { to.groups[8].triangles = 0; });
  change("too many triangles", [](LevelIndex& to) { to.groups[8].triangles = maxGroupCount + 1; });
  change("no bytes of a group", [](LevelIndex& to) { to.groups[4].bytes = 0; });
  change("more children than triangles", [](LevelIndex& to) { to.groups[0].triangles = 1; });
  change("more children than points", [](LevelIndex& to) {
    to.hasPoints = true;
    to.groups[0].vertices = 1;
  });
  change("children on level 0", [](LevelIndex& to) { to.groups[4].children = {5}; });
  change("no children above level 0", [](LevelIndex& to) { to.groups[1].children.clear(); });
  change("a child that does not exist", [](LevelIndex& to) { to.groups[3].children.push_back(9); });
  change("a group without parents", [](LevelIndex& to) {
    for (LevelGroup& group : to.groups)
      std::erase(group.children, 6u);
  });
  change("a child two levels below", [](LevelIndex& to) { to.groups[0].children.push_back(4); });
  change("an only group above level 0", [](LevelIndex& to) {
    to.groups.resize(1);
    to.groups[0].level = 1;
  });
  const auto changeChips = [&](const std::string& name, auto apply) {
    change(name, [&](LevelIndex& to) {
      to.hasChips = true;
      for (LevelGroup& group : to.groups)
        group.chipColumns = group.chipRows = group.chipBytes = 4;
      apply(to);
    });
  };
  changeChips("an image without columns", [](LevelIndex& to) { to.groups[1].chipColumns = 0; });
  changeChips("an image of too many rows", [](LevelIndex& to) { to.groups[1].chipRows = maxChipImageEdge + 1; });
  changeChips("an image without bytes", [](LevelIndex& to) { to.groups[1].chipBytes = 0; });
  changeChips("other features on page 1", [](LevelIndex&) {});
  refused.back().payloads[1][4] = 0;
  Bytes header{'I', 'G', 'L', 1, 0, 0};
  const auto withHeader = [&](const std::string& name, const Bytes& rest) {
    refused.push_back({name, {header}});
    refused.back().payloads[0].insert(refused.back().payloads[0].end(), rest.begin(), rest.end());
  };
  withHeader("too many groups", {0x81, 0x80, 0x80, 2, 1, 1, 16});
  withHeader("too many groups a page", {1, 0x81, 0x80, 4, 1, 16});
  withHeader("a number that is too long", {0x81, 0x80, 0x80, 0x80, 1, 1, 1, 16});
  withHeader("a page without bytes", {2, 1, 1, 16, 0});
  return refused;
}

void rewriteLevels() {
  std::filesystem::create_directories(levelVectors);
  const auto write = [](const std::string& name, const Json& json) {
    writeFile(levelVectors / name, asBytes(json.dump() + "\n"));
  };
  for (const LevelSample& sample : testing::levelSamples()) {
    const std::vector<Bytes> files = writeLevelIndex(sample.index);
    for (std::size_t page = 0; page < files.size(); ++page)
      writeFile(levelVectors / levelPageUrl(sample.name + ".png", page), files[page]);
    write(sample.name + ".json", levelJsonOf(sample.index));
  }
  write("edits.json", randomEdits());
  Json refused = Json::array();
  for (const auto& [name, payloads] : refusedLevels()) {
    Json pages = Json::array();
    for (const Bytes& payload : payloads)
      pages.push_back(imgeo::testing::base16Of(payload));
    refused.push_back({{"name", name}, {"pages", pages}, {"verdict", levelVerdictOn(payloads)}});
  }
  write("refused.json", refused);
}

Json levelVector(const std::string& name) {
  return Json::parse(asText(readFile(levelVectors / name)));
}

LevelIndex readVector(const std::string& name) {
  return readLevelIndex(name + ".png", [](const std::string& url) { return readFile(levelVectors / url); });
}

class LevelVectors : public ::testing::Test {
protected:
  static void SetUpTestSuite() {
    if (std::getenv("IMGEO_REWRITE_GOLDEN") != nullptr)
      rewriteLevels();
  }
};

TEST_F(LevelVectors, AreReadExactly) {
  for (const LevelSample& sample : testing::levelSamples()) {
    const LevelIndex index = readVector(sample.name);
    EXPECT_EQ(index, sample.index) << sample.name;
    EXPECT_EQ(levelJsonOf(index), levelVector(sample.name + ".json")) << sample.name;
  }
}

TEST_F(LevelVectors, EqualWhatTheWriterWrites) {
  for (const LevelSample& sample : testing::levelSamples()) {
    const std::vector<Bytes> files = writeLevelIndex(sample.index);
    EXPECT_EQ(files.size(), sample.index.pageCount());
    for (std::size_t page = 0; page < files.size(); ++page)
      EXPECT_EQ(files[page], readFile(levelVectors / levelPageUrl(sample.name + ".png", page))) << sample.name;
  }
}

TEST_F(LevelVectors, GiveTheStatedVerdictAfterEdits) {
  const Json edits = levelVector("edits.json");
  std::size_t accepted = 0;
  for (const Json& entry : edits) {
    std::vector<Bytes> payloads = levelPayloadsOf(readVector(entry.at("name")));
    const Json verdict = levelVerdictOn(editedPayloads(std::move(payloads), entry));
    EXPECT_EQ(verdict, entry.at("verdict")) << entry;
    accepted += verdict.is_number();
  }
  EXPECT_GT(edits.size(), 1000u);
  EXPECT_GT(accepted, edits.size() / 10);
  EXPECT_LT(accepted, edits.size() * 9 / 10);
}

TEST_F(LevelVectors, OfWrongIndexesAreRefused) {
  const Json refused = levelVector("refused.json");
  EXPECT_EQ(refused.size(), refusedLevels().size());
  for (const Json& entry : refused) {
    std::vector<Bytes> payloads;
    for (const Json& page : entry.at("pages"))
      payloads.push_back(imgeo::testing::bytesOfBase16(page));
    const Json verdict = levelVerdictOn(payloads);
    EXPECT_TRUE(verdict.is_string()) << entry.at("name");
    EXPECT_EQ(verdict, entry.at("verdict")) << entry.at("name");
  }
}

} // namespace
} // namespace imgeo
