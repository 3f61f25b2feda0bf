// Conversions out of core as processes that are killed, lose their work folder, or have little memory.

#include "run.h"

#include <csignal>
#include <gtest/gtest.h>
#include <map>
#include <sys/resource.h>
#include <thread>

namespace imgeo {
namespace {

using namespace testing;

class OutOfCoreProcess : public ::testing::Test {
protected:
  void SetUp() override { sample(input_, 40000); }

  static void sample(const std::string& file, int triangles) {
    ASSERT_EQ(run({"sample", "relief", "--triangles", std::to_string(triangles), "-o", file}).code, 0);
  }

  /// Regions so small that two levels are built out of core.
  std::vector<std::string> command(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"convert", input_,  "-o",       site_,  "--work",    work_, "--levels",
                                   "always",  "--group-triangles", "512",  "--region-triangles", "4096",
                                   "--no-pictures",     "--threads", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  /// Starts a conversion and returns when its work folder has the file. Returns 0 if it has ended before.
  pid_t startUntil(const std::string& workFile, const std::vector<std::string>& more = {}) {
    std::filesystem::remove_all(work_);
    const pid_t child = start(command(more), directory_ / "out", directory_ / "err");
    while (!std::filesystem::exists(work_ + "/" + workFile)) {
      if (waitpid(child, nullptr, WNOHANG) != 0)
        return 0;
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    return child;
  }

  /// The files of the site, and removes it.
  std::map<std::string, std::string> takeSite() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(site_))
      if (entry.is_regular_file())
        files[entry.path().string().substr(site_.size())] = textOf(entry.path());
    std::filesystem::remove_all(site_);
    return files;
  }

  static void expectSentence(const Outcome& outcome, int code, const std::string& words) {
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << "expected: " << words << "\nprinted: " << outcome.err;
  }

  TemporaryDirectory directory_;
  std::string input_ = directory_ / "relief.ply", site_ = directory_ / "site", work_ = directory_ / "work";
};

TEST_F(OutOfCoreProcess, GoesOnWithTheSameBytesWhereverItWasKilled) {
  ASSERT_EQ(run(command()).code, 0);
  const auto expected = takeSite();
  EXPECT_GT(expected.size(), 60u);
  for (const char* file : {"survey-done", "scatter-0-done", "normals-0-3", "groups-0-5", "groups-1-0"}) {
    const pid_t child = startUntil(file);
    ASSERT_NE(child, 0) << "the conversion ended before " << file;
    kill(child, SIGKILL);
    ASSERT_EQ(wait(child), 128 + SIGKILL);
    EXPECT_FALSE(std::filesystem::exists(site_)) << file;
    const Outcome resumed = run(command({"--resume"}));
    ASSERT_EQ(resumed.code, 0) << file << ": " << resumed.err;
    EXPECT_TRUE(takeSite() == expected) << file;
    EXPECT_EQ(namesIn(directory_.path()), (std::vector<std::string>{"err", "out", "relief.ply"})) << file;
  }
}

TEST_F(OutOfCoreProcess, EndsWithASentenceWhereTheWorkFolderIsLost) {
  const pid_t child = startUntil("groups-0-2");
  ASSERT_NE(child, 0);
  std::filesystem::rename(work_, directory_ / "elsewhere");
  expectSentence({wait(child), "", textOf(directory_ / "err")}, 2, work_);
  expectSentence(run(command({"--resume"})), 1, "no work folder of an earlier run");
  EXPECT_FALSE(std::filesystem::exists(site_));
  EXPECT_FALSE(std::filesystem::exists(work_));
}

TEST_F(OutOfCoreProcess, EndsWithASentenceWhereAnotherRunUsesTheWorkFolder) {
  const pid_t child = startUntil("survey-done");
  ASSERT_NE(child, 0);
  kill(child, SIGSTOP);
  expectSentence(run(command({"--resume"})), 1, "a run that has not ended");
  kill(child, SIGCONT);
  EXPECT_EQ(wait(child), 0) << textOf(directory_ / "err");
}

/// The memory that a process may write: heap, stacks and private mappings.
constexpr rlim_t dataBytes = 128u << 20;

/// A PLY file whose vertices have further values in front, so many that it is several times as large as dataBytes.
std::string widened(const std::string& ply) {
  constexpr std::size_t properties = 200, each = 8;
  std::size_t body = ply.find("end_header\n") + 11;
  std::string header = ply.substr(0, body);
  const std::size_t vertices = std::stoul(header.substr(header.find("element vertex ") + 15));
  std::string lines;
  for (std::size_t i = 0; i < properties; ++i)
    lines += "property double value" + std::to_string(i) + "\n";
  header.insert(header.find("element face"), lines);
  std::string wide;
  wide.reserve(header.size() + vertices * (12 + properties * each) + ply.size());
  wide += header;
  for (std::size_t vertex = 0; vertex < vertices; ++vertex, body += 12)
    wide.append(ply, body, 12).append(properties * each, '\0');
  return wide.append(ply, body);
}

TEST_F(OutOfCoreProcess, TakesLessMemoryThanItsSourceHasBytes) {
  sample(input_, 400000);
  ASSERT_EQ(run(command()).code, 0);
  const auto expected = takeSite();
  write(input_, widened(textOf(input_)));
  ASSERT_GT(std::filesystem::file_size(input_), 5 * dataBytes / 2);
  const pid_t child = start(command(), directory_ / "out", directory_ / "err", "/dev/null", [] {
    const rlimit limit{dataBytes, dataBytes};
    setrlimit(RLIMIT_DATA, &limit);
  });
  ASSERT_EQ(wait(child), 0) << textOf(directory_ / "err");
  const auto files = takeSite();
  EXPECT_EQ(files.size(), expected.size());
  for (const auto& [name, text] : expected)
    if (name.starts_with("/geometry/"))
      EXPECT_TRUE(files.contains(name) && files.at(name) == text) << name;
}

} // namespace
} // namespace imgeo
