// Comparisons out of core as processes that are ended by signals or have little memory.

#include "base/soak_testing.h"
#include "out_of_core.h"

#include <csignal>
#include <sys/resource.h>

namespace imgeo {
namespace {

using namespace testing;

class VerifyOutOfCoreProcess : public OutOfCoreProcess {
protected:
  /// Converts a sample of triangles or points.
  void convertSample(const std::string& kind, int count) {
    ASSERT_EQ(run({"sample", "relief", kind, std::to_string(count), "-o", input_}).code, 0);
    ASSERT_EQ(run({"convert", input_, "-o", site_, "--levels", "always", "--no-pictures"}).code, 0);
    work_ = directory_ / ".site.imgeo-verify"; // where it is unless stated
    siteFiles_ = filesOfSite();
  }

  std::map<std::string, std::string> filesOfSite() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(site_))
      if (entry.is_regular_file())
        files[entry.path().string()] = textOf(entry.path());
    return files;
  }

  std::vector<std::string> verifyCommand() const {
    return {"verify", site_, input_, "--work", work_, "--memory", "256M"};
  }

  /// Starts a comparison and ends it by a signal when its work folder has a file.
  void endBy(int signal, const std::string& workFile) {
    std::filesystem::remove(work_ + "/" + workFile); // of a comparison that was killed
    const pid_t child = start(verifyCommand(), directory_ / "out", directory_ / "err", "/dev/null", [] {
      setpriority(PRIO_PROCESS, 0, 19); // on a busy machine this test is awake before the comparison ends
    });
    ASSERT_TRUE(awaitFile(workFile, child)) << "the comparison ended before " << workFile;
    kill(child, signal);
    EXPECT_EQ(wait(child), 128 + signal) << textOf(directory_ / "err");
    EXPECT_EQ(textOf(directory_ / "out"), "");
    EXPECT_TRUE(filesOfSite() == siteFiles_) << workFile;
  }

  void expectOnlySiteAndSource() const {
    EXPECT_EQ(namesIn(directory_.path()), (std::vector<std::string>{"err", "out", "relief.ply", "site"}));
  }

  /// Ends comparisons by SIGTERM, SIGKILL, and SIGTERM in the folder that SIGKILL left. `workFiles`: other than
  /// job.txt, by which a folder is known as ours.
  void expectLeavesNothingWhereEnded(const std::vector<std::string>& workFiles) {
    for (const std::string& file : workFiles) {
      endBy(SIGTERM, file);
      EXPECT_EQ(textOf(directory_ / "err"), "imgeo: interrupted; nothing has changed\n");
      expectOnlySiteAndSource();
      endBy(SIGKILL, file);
      EXPECT_TRUE(std::filesystem::exists(work_));
      endBy(SIGTERM, file);
      expectOnlySiteAndSource();
      endBy(SIGKILL, file);
      const Outcome again = run(verifyCommand());
      EXPECT_EQ(again.code, 0) << again.out << again.err;
      expectOnlySiteAndSource();
    }
  }

  std::map<std::string, std::string> siteFiles_;
};

SOAK_TEST_F(VerifyOutOfCoreProcess, LeavesNothingOfMeshesWhereverASignalEndsIt) {
  convertSample("--triangles", 300000);
  expectLeavesNothingWhereEnded({"0/scatter-0-0", "0/normals-0-0", "0/scatter-1-0"});
}

SOAK_TEST_F(VerifyOutOfCoreProcess, LeavesNothingOfACloudWhereASignalEndsIt) {
  convertSample("--points", 100000);
  expectLeavesNothingWhereEnded({"0/scatter-1-0"});
}

SOAK_TEST_F(VerifyOutOfCoreProcess, LeavesNothingOfCloudsWhereverASignalEndsIt) {
  convertSample("--points", 300000);
  expectLeavesNothingWhereEnded({"0/scatter-0-0", "0/scatter-1-0"});
}

SOAK_TEST_F(VerifyOutOfCoreProcess, TakesLessMemoryThanComparisonOfACloudInMemory) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer takes more";
#endif
  convertSample("--points", 1000000);
  constexpr rlim_t dataBytes = 240u << 20; // in memory more than 300 MB
  for (const bool isLarge : {false, true}) {
    std::vector<std::string> words = verifyCommand();
    if (!isLarge)
      words.erase(words.begin() + 3, words.begin() + 7);
    const pid_t child = start(words, directory_ / "out", directory_ / "err", "/dev/null", [] {
      const rlimit limit{dataBytes, dataBytes};
      setrlimit(RLIMIT_DATA, &limit);
    });
    EXPECT_EQ(wait(child) == 0, isLarge) << textOf(directory_ / "err");
  }
}

} // namespace
} // namespace imgeo
