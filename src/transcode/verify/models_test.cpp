// Upper bounds for the sizes of sites of the models of Behr et al. 2012 (section 4.3, Table 1). Skipped if the models
// are missing.

#include "base/testing.h"
#include "imgeo/convert.h"
#include "imgeo/verify.h"

#include <cstdlib>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

namespace fs = std::filesystem;

struct PaperModel {
  std::string file;
  std::uint64_t imageBytes;   ///< SIG PNG, indexed, at the highest effort; the paper needs 1.7 times that
  std::uint64_t stripIndices; ///< the paper's number of indices of strips
};

class PaperModels : public ::testing::TestWithParam<PaperModel> {
protected:
  void SetUp() override {
    const char* shared = std::getenv("IMGEO_SHARED");
    model_ = fs::path(shared ? shared : "../shared") / "models" / GetParam().file;
    if (!fs::exists(model_))
      GTEST_SKIP() << model_ << " is not there";
  }

  /// The bytes of the site's geometry files, all or those of one role.
  std::uint64_t bytesOf(const ConvertOptions& options, const std::string& role = "") {
    std::uint64_t bytes = 0;
    for (const RoleBytes& sum : convert(model_, directory_ / "site", options).roles)
      if (role.empty() ? sum.role == "index" || sum.role == "coord" || sum.role == "normal" : sum.role == role)
        bytes += sum.bytes;
    return bytes;
  }

private:
  testing::TemporaryDirectory directory_;
  fs::path model_;
};

/// Effort 8 takes a fifth of the time of 9, which tries more and is never larger.
TEST_P(PaperModels, AreImagesOfFewBytes) {
  ConvertOptions options;
  options.encoding = Encoding::classic;
  options.effort = 8;
  const std::uint64_t bytes = bytesOf(options);
  EXPECT_GT(bytes, 0u);
  EXPECT_LE(bytes, GetParam().imageBytes);
}

TEST_P(PaperModels, AreStripsOfNoMoreIndicesThanThePapers) {
  ConvertOptions options;
  options.encoding = Encoding::bg;
  options.primitives = Primitives::strips;
  const std::uint64_t indices = bytesOf(options, "index") / 2;
  EXPECT_GT(indices, 0u);
  EXPECT_LE(indices, GetParam().stripIndices);
}

INSTANTIATE_TEST_SUITE_P(OfTable1, PaperModels,
                         ::testing::Values(PaperModel{"stanford-bunny.obj", 245'000, 89'611},
                                           PaperModel{"horse.ply", 345'000, 128'659}),
                         [](const auto& model) {
                           return model.param.file.substr(0, model.param.file.find_first_of("-."));
                         });

} // namespace
} // namespace imgeo
