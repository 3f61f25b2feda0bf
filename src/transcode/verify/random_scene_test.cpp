// Converts documents with all nodes of X3D, and random scenes of them, and verifies the sites. IMGEO_RANDOM_SCENES sets
// the number of random scenes (`make soak` takes more), IMGEO_RANDOM_SEED the seed of the first.

#include "import/x3d/testing.h"

#include "base/error.h"
#include "base/file.h"
#include "base/testing.h"
#include "transcode/site/testing.h"

#include <cstdlib>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <random>

namespace imgeo::testing {
namespace {

using namespace x3d::testing;
using x3d::NodeRow;
using x3d::nodeTable;

void expectVerified(const std::string& text, DocumentEncoding encoding, const ConvertOptions& options) {
  const TemporaryDirectory directory;
  const std::filesystem::path input = directory / fileNameOf(encoding);
  writeFile(input, asBytes(text));
  try {
    convert(input, directory / "site", options);
    const VerifyReport report = verify(directory / "site", input);
    EXPECT_TRUE(report.equal) << fmt::format("{}", fmt::join(report.findings, "\n")) << "\n" << text;
  } catch (const Error& error) {
    ADD_FAILURE() << error.what() << "\n" << text;
  }
}

bool isNode(const NodeRow& row) {
  return row.component != "statement" && row.component != "imgeo";
}

TEST(RandomScene, EveryNodeOfTheTableIsConvertedAndVerifiedInEveryEncoding) {
  for (const DocumentEncoding encoding : encodings) {
    std::vector<NodeSample> nodes;
    for (const NodeRow& row : nodeTable())
      if (isNode(row))
        nodes.push_back(sampleOf(row));
    expectVerified(documentOf(nodes, encoding), encoding, {});
  }
}

class SceneGenerator {
public:
  explicit SceneGenerator(std::uint32_t seed) : random_(seed) {
    for (const NodeRow& row : nodeTable())
      if (isNode(row))
        rows_.push_back(&row);
  }

  std::size_t below(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }

  std::vector<NodeSample> scene() {
    std::vector<NodeSample> nodes;
    for (std::size_t count = 1 + below(8); count > 0; --count)
      nodes.push_back(node(0));
    return nodes;
  }

private:
  std::string randomNumber() { return fmt::format("{}", static_cast<double>(below(400)) / 100 - 2); }

  std::string randomNumbers(std::size_t count) {
    std::string text = randomNumber();
    while (--count > 0)
      text += " " + randomNumber();
    return text;
  }

  NodeSample node(std::size_t depth) {
    if (!names_.empty() && below(6) == 0) {
      const auto& [name, element] = names_[below(names_.size())];
      return {element, "children", "", name, {}, {}};
    }
    NodeSample made = depth < 5 && below(2) == 0 ? group(depth) : below(2) == 0 ? shape() : sampleOf(*any());
    if (made.field == "children" && below(3) == 0) {
      made.def = fmt::format("N{}", ++nameCount_);
      names_.emplace_back(made.def, made.name); // after its children, which must not contain it
    }
    return made;
  }

  const NodeRow* any() { return rows_[below(rows_.size())]; }

  NodeSample group(std::size_t depth) {
    using enum FieldSample::Type;
    static constexpr std::array kinds{"Group",     "Transform", "Switch",     "LOD",         "Anchor",
                                      "Collision", "Billboard", "CADPart",    "CADAssembly", "HAnimSite",
                                      "CADLayer",  "Unknown",   "StaticGroup"};
    NodeSample made{kinds[below(kinds.size())], "children", "", "", {}, {}};
    if (made.name == "Transform" || made.name == "CADPart" || made.name == "HAnimSite")
      made.fields = {{"translation", FieldSample::Type::numbers, randomNumbers(3)},
                     {"rotation", FieldSample::Type::numbers, randomNumbers(4)},
                     {"unknownField", string, "x"}};
    if (made.name == "Switch")
      made.fields = {{"whichChoice", FieldSample::Type::number, fmt::format("{}", below(3))}};
    for (std::size_t count = below(4); count > 0; --count)
      made.children.push_back(node(depth + 1));
    return made;
  }

  /// A shape of faces, lines or points with a material, short enough for the document or not.
  NodeSample shape() {
    using enum FieldSample::Type;
    static constexpr std::array kinds{"TriangleSet", "IndexedFaceSet", "LineSet", "IndexedLineSet", "PointSet"};
    static constexpr std::array materials{"Material", "PhysicalMaterial", "UnlitMaterial", "TwoSidedMaterial",
                                          "CommonSurfaceShader"};
    const std::size_t points = 3 * (1 + below(below(2) == 0 ? 3 : 100));
    NodeSample geometry{kinds[below(kinds.size())], "geometry", "", "", {}, {}};
    std::string index;
    for (std::size_t i = 0; i < points; ++i)
      index += fmt::format("{}{}", i == 0 ? "" : " ", i % 3 == 2 ? fmt::format("{} -1", i) : fmt::format("{}", i));
    if (geometry.name.starts_with("Indexed"))
      geometry.fields = {{"coordIndex", FieldSample::Type::numbers, index}};
    if (geometry.name == "LineSet")
      geometry.fields = {{"vertexCount", FieldSample::Type::numbers, fmt::format("{}", points)}};
    geometry.children = {
        {"Coordinate", "coord", "", "", {{"point", FieldSample::Type::numbers, randomNumbers(3 * points)}}, {}}};
    const std::string material = materials[below(materials.size())];
    const std::string field = x3d::testing::defaultFieldOf(material);
    NodeSample appearance{"Appearance", "appearance", "", "", {}, {{material, field, "", "", {}, {}}}};
    NodeSample made{"Shape", "children", "", "", {}, {geometry}};
    if (below(4) > 0)
      made.children.insert(made.children.begin(), appearance);
    return made;
  }

  std::mt19937 random_;
  std::vector<const NodeRow*> rows_;
  std::vector<std::pair<std::string, std::string>> names_; ///< DEF and element of nodes that are complete
  std::size_t nameCount_ = 0;
};

std::uint32_t numberFrom(const char* variable, std::uint32_t fallback) {
  const char* const text = std::getenv(variable);
  return text ? static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10)) : fallback;
}

TEST(RandomScene, IsConvertedAndVerified) {
  const std::uint32_t first = numberFrom("IMGEO_RANDOM_SEED", 1), count = numberFrom("IMGEO_RANDOM_SCENES", 40);
  for (std::uint32_t seed = first; seed < first + count; ++seed) {
    SCOPED_TRACE(fmt::format("IMGEO_RANDOM_SEED={}", seed));
    SceneGenerator generator(seed);
    const DocumentEncoding encoding = encodings[generator.below(encodings.size())];
    ConvertOptions options;
    if (generator.below(2) == 0)
      options.encoding = static_cast<imgeo::Encoding>(generator.below(3));
    expectVerified(documentOf(generator.scene(), encoding), encoding, options);
  }
}

} // namespace
} // namespace imgeo::testing
