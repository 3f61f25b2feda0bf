#include "transcode/out_of_core/file_link.h"

#include "base/error.h"
#include "base/testing.h"

#include <atomic>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

const std::function<void()> nothing = [] {};

constexpr double longSilence = 60; ///< [s] no rank of a busy machine is silent for so long

/// Calls body(link, rank) for each rank, in a thread of its own. An Error that the body does not catch fails the test.
template <typename Body>
void runRanks(const std::filesystem::path& folder, std::uint32_t count, double maxSilenceSeconds, const Body& body) {
  std::vector<std::thread> threads;
  for (std::uint32_t rank = 0; rank < count; ++rank)
    threads.emplace_back([&, rank] {
      RankOptions options;
      options.rank = rank, options.count = count, options.maxSilenceSeconds = maxSilenceSeconds;
      try {
        FileLink link(folder, options, nothing);
        body(link, rank);
      } catch (const Error& error) {
        ADD_FAILURE() << "rank " << rank << ": " << error.what();
      }
    });
  for (std::thread& thread : threads)
    thread.join();
}

TEST(FileLink, LetsNoRankPassABarrierBeforeAllHaveReachedIt) {
  const TemporaryDirectory directory;
  std::atomic<int> reached = 0;
  runRanks(directory.path(), 4, longSilence, [&](FileLink& link, std::uint32_t) {
    for (int barrier = 1; barrier <= 5; ++barrier) {
      ++reached;
      link.barrier(nothing);
      EXPECT_GE(reached, 4 * barrier);
      link.barrier(nothing);
      EXPECT_LE(reached, 4 * barrier);
      link.barrier(nothing);
    }
  });
}

TEST(FileLink, GivesAllRanksOneSessionAndTheTextOfRankZero) {
  const TemporaryDirectory directory;
  std::mutex mutex;
  std::vector<std::string> sessions;
  runRanks(directory.path(), 3, longSilence, [&](FileLink& link, std::uint32_t rank) {
    EXPECT_EQ(link.broadcast(fmt::format("of {}", rank)), "of 0");
    EXPECT_EQ(link.broadcast("again"), "again");
    link.leave(nothing);
    const std::lock_guard lock(mutex);
    sessions.push_back(link.session());
  });
  EXPECT_EQ(sessions, std::vector<std::string>(3, sessions.at(0)));
}

/// The sentence with which a wait of rank 0 ends.
template <typename Body> std::string endOfRankZero(double maxSilenceSeconds, const Body& bodyOfOther) {
  const TemporaryDirectory directory;
  std::string sentence;
  runRanks(directory.path(), 2, maxSilenceSeconds, [&](FileLink& link, std::uint32_t rank) {
    if (rank == 1) {
      bodyOfOther(link);
      return;
    }
    try {
      link.barrier(nothing);
    } catch (const Error& error) {
      sentence = error.what();
    }
  });
  return sentence;
}

TEST(FileLink, EndsTheWaitForARankThatHasFailedOrIsSilent) {
  EXPECT_NE(endOfRankZero(longSilence, [](FileLink& link) { link.fail("a.ply: is cut"); })
                .find("rank 1: has ended: a.ply: is cut"),
            std::string::npos);
  EXPECT_NE(endOfRankZero(0.5, [](FileLink&) {}).find("rank 1 has given no sign of life for 0.5 s"), std::string::npos);
  EXPECT_EQ(endOfRankZero(2,
                          [](FileLink& link) {
                            std::this_thread::sleep_for(std::chrono::seconds(3)); // longer than a rank may be silent
                            link.barrier(nothing);
                          }),
            "");
}

TEST(FileLink, AdmitsNoNameOfAnEarlierSession) {
  const TemporaryDirectory directory;
  writeFile(directory / "session", asBytes("0123 4567"));
  writeFile(directory / "state-0", asBytes("0123 9 9"));
  RankOptions options;
  options.rank = 1, options.count = 2, options.maxSilenceSeconds = 0.1;
  EXPECT_THROW(FileLink(directory.path(), options, nothing), Error);
}

TEST(FileLink, EndsWhereRankZeroHasBegunAnew) {
  const TemporaryDirectory directory;
  std::atomic<bool> isPastBarrier = false; // rank 1, which looks at the session while it waits
  runRanks(directory.path(), 2, longSilence, [&](FileLink& link, std::uint32_t rank) {
    link.requireSession();
    link.barrier(nothing);
    if (rank == 0) {
      pollUntil([&] { return isPastBarrier.load(); }, nothing);
      writeFile(directory / "session", asBytes("other"));
    } else {
      isPastBarrier = true;
      pollUntil([&] { return asText(readFile(directory / "session")) == "other"; }, nothing);
      EXPECT_THROW(link.requireSession(), Error);
    }
  });
}

} // namespace
} // namespace imgeo
