// Conversions that several processes share: by files in the work folder, and by MPI.

#include "base/soak_testing.h"
#include "out_of_core.h"

#include <csignal>
#include <cstring>
#include <fmt/format.h>
#include <fstream>

namespace imgeo {
namespace {

using namespace testing;

class Ranks : public OutOfCoreProcess {
protected:
  void SetUp() override {
    OutOfCoreProcess::SetUp();
    ASSERT_EQ(run(command()).code, 0);
    expected_ = takeSite();
  }

  std::string fileOf(const char* kind, int rank) const { return directory_ / fmt::format("{}-{}", kind, rank); }

  pid_t startRank(int rank, int ranks, std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--rank", std::to_string(rank), "--ranks", std::to_string(ranks)});
    return start(command(more), fileOf("out", rank), fileOf("err", rank));
  }
  std::vector<pid_t> startRanks(int ranks, const std::vector<std::string>& more = {}) const {
    std::vector<pid_t> children;
    for (int rank = ranks; rank-- > 0;) // rank 0 is the last to begin
      children.insert(children.begin(), startRank(rank, ranks, more));
    return children;
  }
  Outcome outcomeOf(pid_t child, int rank) const {
    const int code = wait(child);
    return {code, textOf(fileOf("out", rank)), textOf(fileOf("err", rank))};
  }

  std::map<std::string, std::string> expected_;
};

/// "has done 7 of 40 tasks": 7 and 40.
std::pair<int, int> tasksIn(const std::string& text) {
  std::pair<int, int> tasks{0, 0};
  if (const std::size_t at = text.find("has done "); at != text.npos)
    sscanf(text.c_str() + at, "has done %d of %d tasks", &tasks.first, &tasks.second);
  return tasks;
}

TEST_F(Ranks, WriteTheBytesOfOneProcess) {
  for (const int count : {2, 4}) {
    const std::vector<pid_t> children = startRanks(count);
    int taken = 0, all = 0;
    for (int rank = 0; rank < count; ++rank) {
      const Outcome outcome = outcomeOf(children[static_cast<std::size_t>(rank)], rank);
      EXPECT_EQ(outcome.code, 0) << rank << ": " << outcome.err;
      const auto [its, ofAll] = tasksIn(outcome.out);
      EXPECT_GT(its, 0) << rank;
      taken += its, all = ofAll;
    }
    EXPECT_EQ(taken, all) << "no task is done twice";
    EXPECT_GT(all, 20);
    EXPECT_TRUE(takeSite() == expected_) << count;
    EXPECT_FALSE(std::filesystem::exists(work_));
  }
}

TEST_F(Ranks, EndWithASentenceWhereOneIsKilledAndGoOnAsAnyNumber) {
  const std::vector<pid_t> children = startRanks(3, {"--silence", "1"});
  ASSERT_TRUE(awaitFile("0/normals-0-1", children[2]));
  kill(children[2], SIGKILL);
  expectSentence(outcomeOf(children[0], 0), 2, "rank 2 has given no sign of life for 1 s");
  expectSentence(outcomeOf(children[1], 1), 2, "rank 0: has ended: ");
  EXPECT_EQ(wait(children[2]), 128 + SIGKILL);
  EXPECT_FALSE(std::filesystem::exists(site_));
  const std::vector<pid_t> again = startRanks(2, {"--resume"});
  for (int rank = 0; rank < 2; ++rank) {
    const Outcome outcome = outcomeOf(again[static_cast<std::size_t>(rank)], rank);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
  EXPECT_TRUE(takeSite() == expected_);
}

TEST_F(Ranks, EndWhereRankZeroIsKilled) {
  const std::vector<pid_t> children = startRanks(2, {"--silence", "1"});
  ASSERT_TRUE(awaitFile("0/normals-0-1", children[0]));
  kill(children[0], SIGKILL);
  EXPECT_EQ(wait(children[0]), 128 + SIGKILL);
  expectSentence(outcomeOf(children[1], 1), 2, "rank 0 has given no sign of life for 1 s");
  ASSERT_EQ(run(command({"--resume"})).code, 0);
  EXPECT_TRUE(takeSite() == expected_);
}

TEST_F(Ranks, EndByTheErrorOfAnother) {
  const pid_t other = startRank(1, 2, {"--effort", "4"}), first = startRank(0, 2, {"--silence", "20"});
  expectSentence(outcomeOf(other, 1), 1, "all ranks with the same options");
  expectSentence(outcomeOf(first, 0), 2, "rank 1: has ended: ");
}

TEST_F(Ranks, WaitForEachOtherOnlySoLong) {
  expectSentence(outcomeOf(startRank(0, 2, {"--silence", "1"}), 0), 2,
                 "rank 1 has given no sign of life for 1 s since rank 0 began");
  expectSentence(outcomeOf(startRank(1, 2, {"--silence", "1"}), 1), 2, "rank 0 has given no sign of life for 1 s");
  std::filesystem::remove_all(work_);
  expectSentence(outcomeOf(startRank(1, 2, {"--silence", "1"}), 1), 2, "is not there after 1 s");
  EXPECT_FALSE(std::filesystem::exists(work_));
  expectSentence(outcomeOf(startRank(2, 2), 2), 1, "2 ranks have the numbers 0 to 1");
}

TEST_F(Ranks, AreEachOneProcess) {
  const pid_t first = startRank(0, 3, {"--silence", "5"});
  ASSERT_TRUE(awaitFile("job.txt", first));
  const pid_t other = startRank(1, 3, {"--silence", "5"});
  ASSERT_TRUE(awaitFile("ranks/join-1", other));
  for (const int rank : {0, 1})
    expectSentence(run(command({"--rank", std::to_string(rank), "--ranks", "3"})), 1, "that has not ended");
  for (const pid_t child : {first, other}) {
    kill(child, SIGTERM);
    EXPECT_EQ(wait(child), 128 + SIGTERM);
  }
}

TEST_F(Ranks, LeaveSmallMeshesToRankZero) {
  sample(input_, 1000);
  const std::vector<pid_t> children = startRanks(2);
  EXPECT_EQ(outcomeOf(children[0], 0).code, 0);
  EXPECT_NE(outcomeOf(children[1], 1).out.find("Rank 0 converts"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(site_));
}

#ifdef IMGEO_MPI_TOOL
/// A LAS 1.2 file of points of format 0.
std::string lasOf(std::uint32_t count) {
  std::string bytes(227, '\0');
  const auto put = [&](std::size_t at, auto value) { std::memcpy(&bytes[at], &value, sizeof(value)); };
  bytes.replace(0, 4, "LASF");
  bytes[24] = 1, bytes[25] = 2;
  put(94, std::uint16_t{227}); // bytes of the header
  put(96, std::uint32_t{227}); // where points begin
  put(105, std::uint16_t{20}); // bytes of a point
  put(107, count);
  for (std::size_t axis = 0; axis < 3; ++axis)
    put(131 + 8 * axis, 0.01); // the scale
  const std::size_t first = bytes.size();
  bytes.resize(first + 20 * std::size_t{count});
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t x = i * 7919 % 30011, y = i * 104729 % 29989;
    const std::uint32_t coordinates[] = {x, y, x * (x % 64) / 512};
    std::memcpy(&bytes[first + 20 * std::size_t{i}], coordinates, sizeof(coordinates));
  }
  return bytes;
}

class MpiRanks : public Ranks {
protected:
  pid_t startMpi(int count, const std::vector<std::string>& more = {}) const {
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    setenv("HWLOC_COMPONENTS", "-gl", 1); // mpirun waits for any X server that does not answer, to ask for its GPU
    std::vector<std::string> words{"--oversubscribe", "--bind-to", "none", "-n", std::to_string(count), IMGEO_MPI_TOOL};
    const std::vector<std::string> command = this->command(more);
    words.insert(words.end(), command.begin(), command.end());
    return startProgram(IMGEO_MPIRUN, words, fileOf("out", 0), fileOf("err", 0));
  }

  /// Converts by 1, 2 and 4 ranks, and expects the files of one process without MPI.
  void expectBytesOfOneProcess() const {
    for (const int count : {1, 2, 4}) {
      const Outcome outcome = outcomeOf(startMpi(count), 0);
      EXPECT_EQ(outcome.code, 0) << outcome.err;
      for (int rank = 1; rank < count; ++rank)
        EXPECT_NE(outcome.out.find(fmt::format("Rank {} of {} has done", rank, count)), std::string::npos)
            << outcome.out;
      EXPECT_TRUE(takeSite() == expected_) << count;
      EXPECT_FALSE(std::filesystem::exists(work_));
    }
  }

  /// The same of another input.
  void expectBytesOfOneProcessOf(const std::string& input) {
    input_ = input;
    ASSERT_EQ(run(command()).code, 0);
    expected_ = takeSite();
    EXPECT_GT(expected_.size(), 60u); // several regions, of several groups each
    expectBytesOfOneProcess();
  }

  /// The processes that a process has started.
  static std::vector<pid_t> childrenOf(pid_t parent) {
    std::ifstream list(fmt::format("/proc/{0}/task/{0}/children", parent));
    std::vector<pid_t> children;
    for (pid_t child = 0; list >> child;)
      children.push_back(child);
    return children;
  }
};

TEST_F(MpiRanks, WriteTheBytesOfOneProcess) {
  expectBytesOfOneProcess();
}

SOAK_TEST_F(MpiRanks, WriteTheBytesOfOneProcessOfACloud) {
  ASSERT_EQ(run({"sample", "relief", "--points", "60000", "-o", directory_ / "cloud.ply"}).code, 0);
  expectBytesOfOneProcessOf(directory_ / "cloud.ply");
}

SOAK_TEST_F(MpiRanks, WriteTheBytesOfOneProcessOfLas) {
  write(directory_ / "scan.las", lasOf(60000));
  expectBytesOfOneProcessOf(directory_ / "scan.las");
}

SOAK_TEST_F(MpiRanks, EndWhereOneIsKilledAndGoOn) {
  const pid_t mpirun = startMpi(3);
  ASSERT_TRUE(awaitFile("0/normals-0-1", mpirun));
  const std::vector<pid_t> ranks = childrenOf(mpirun);
  ASSERT_EQ(ranks.size(), 3u);
  kill(ranks[1], SIGKILL);
  EXPECT_NE(outcomeOf(mpirun, 0).code, 0);
  EXPECT_FALSE(std::filesystem::exists(site_));
  const Outcome outcome = outcomeOf(startMpi(2, {"--resume"}), 0);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(takeSite() == expected_);
}

TEST_F(MpiRanks, SayOnceWhatAllRanksFind) {
  std::filesystem::remove(input_);
  const Outcome outcome = outcomeOf(startMpi(3), 0);
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  const std::size_t first = outcome.err.find("imgeo-mpi: rank 0: " + input_);
  EXPECT_NE(first, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("imgeo-mpi: rank", first + 1), std::string::npos) << outcome.err;
}
#endif

} // namespace
} // namespace imgeo
