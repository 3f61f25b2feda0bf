// Conversions of point clouds out of core as processes that are killed, share the work, or have little memory.

#include "base/soak_testing.h"
#include "out_of_core.h"

#include <csignal>
#include <sys/resource.h>

namespace imgeo {
namespace {

using namespace testing;

class CloudOutOfCoreProcess : public OutOfCoreProcess {
protected:
  void SetUp() override {
    sampleCloud(60000);
    ASSERT_EQ(run(command()).code, 0);
    expected_ = takeSite();
    EXPECT_GT(expected_.size(), 60u);
  }

  void sampleCloud(int points) const {
    ASSERT_EQ(run({"sample", "relief", "--points", std::to_string(points), "-o", input_}).code, 0);
  }

  std::map<std::string, std::string> expected_;
};

SOAK_TEST_F(CloudOutOfCoreProcess, GoesOnWithTheSameBytesWhereverItWasKilled) {
  expectGoesOnWhereKilled({"0/survey-done", "0/scatter-0-done", "0/region-0-3", "0/top-done", "0/distances-0-2"},
                          expected_);
}

TEST_F(CloudOutOfCoreProcess, WritesTheSameBytesOnSeveralRanks) {
  std::vector<pid_t> children;
  for (const char* rank : {"2", "1", "0"})
    children.push_back(start(command({"--rank", rank, "--ranks", "3"}), directory_ / "out",
                             directory_ / (std::string("err-") + rank)));
  for (const pid_t child : children)
    EXPECT_EQ(wait(child), 0) << textOf(directory_ / "err-0");
  EXPECT_TRUE(takeSite() == expected_);
  EXPECT_FALSE(std::filesystem::exists(work_));
}

SOAK_TEST_F(CloudOutOfCoreProcess, TakesLessMemoryThanInMemory) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer takes more";
#endif
  sampleCloud(1000000);
  constexpr rlim_t dataBytes = 80u << 20; // in memory some 100 MB
  const pid_t child = start(command(), directory_ / "out", directory_ / "err", "/dev/null", [] {
    const rlimit limit{dataBytes, dataBytes};
    setrlimit(RLIMIT_DATA, &limit);
  });
  EXPECT_EQ(wait(child), 0) << textOf(directory_ / "err");
}

} // namespace
} // namespace imgeo
