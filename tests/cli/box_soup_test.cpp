// Conversions of soups of unconnected boxes out of core: levels of whole boxes up to one root, with errors that verify
// measures.

#include "base/soak_testing.h"
#include "out_of_core.h"

#include <nlohmann/json.hpp>

namespace imgeo {
namespace {

using namespace testing;

class BoxSoupProcess : public OutOfCoreProcess {
protected:
  void SetUp() override {}

  void sampleBoxes(int count) const {
    ASSERT_EQ(run({"sample", "boxes", "--count", std::to_string(count), "-o", input_}).code, 0);
  }

  /// Expects a root of whole boxes, about a quarter of the triangles on each level, and a site equal to its input.
  void expectSite(std::size_t triangles) const {
    const Outcome info = run({"info", site_, "--json"});
    ASSERT_EQ(info.code, 0) << info.err;
    const nlohmann::json levels = nlohmann::json::parse(info.out).at("geometries").at(0).at("levels");
    ASSERT_GE(levels.size(), 3u);
    EXPECT_EQ(levels.front().at("triangles"), triangles);
    EXPECT_EQ(levels.back().at("groups"), 1) << levels;
    EXPECT_EQ(levels.back().at("triangles").get<std::size_t>() % 12, 0u) << levels;
    for (std::size_t i = 1; i < levels.size(); ++i)
      EXPECT_LT(levels[i].at("triangles").get<double>(), 0.3 * levels[i - 1].at("triangles").get<double>()) << levels;
    const Outcome verified = run({"verify", site_, input_});
    EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
  }
};

TEST_F(BoxSoupProcess, WritesLevelsOfWholeBoxes) {
  sampleBoxes(4000);
  ASSERT_EQ(run(command()).code, 0);
  expectSite(48000);
}

SOAK_TEST_F(BoxSoupProcess, WritesLevelsOfAMillionBoxesWithinAGigabyte) {
  sampleBoxes(1'000'000);
  const Outcome outcome = run({"convert", input_, "-o", site_, "--work", work_, "--memory", "1G", "--no-pictures"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expectSite(12'000'000);
}

} // namespace
} // namespace imgeo
