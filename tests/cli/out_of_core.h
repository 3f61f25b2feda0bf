#pragma once
// Conversions out of core by processes.

#include "run.h"

#include <csignal>
#include <gtest/gtest.h>
#include <map>
#include <thread>

namespace imgeo::testing {

class OutOfCoreProcess : public ::testing::Test {
protected:
  void SetUp() override { sample(input_, 40000); }

  static void sample(const std::string& file, int triangles) {
    ASSERT_EQ(run({"sample", "relief", "--triangles", std::to_string(triangles), "-o", file}).code, 0);
  }

  /// Regions so small that two levels are built out of core.
  std::vector<std::string> command(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"convert",
                                   input_,
                                   "-o",
                                   site_,
                                   "--work",
                                   work_,
                                   "--levels",
                                   "always",
                                   "--group-triangles",
                                   "512",
                                   "--region-triangles",
                                   "4096",
                                   "--no-pictures",
                                   "--threads",
                                   "1"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  /// Starts a conversion and returns when its work folder has the file. Returns 0 if it has ended before.
  pid_t startUntil(const std::string& workFile, const std::vector<std::string>& more = {}) {
    std::filesystem::remove_all(work_);
    const pid_t child = start(command(more), directory_ / "out", directory_ / "err");
    return awaitFile(workFile, child) ? child : 0;
  }

  /// Returns when the work folder has the file: true, or when the process has ended: false.
  bool awaitFile(const std::string& workFile, pid_t child) const {
    while (!std::filesystem::exists(work_ + "/" + workFile)) {
      if (waitpid(child, nullptr, WNOHANG) != 0)
        return false;
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
    return true;
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

  /// Kills conversions when their work folder has one of these files, and expects that each goes on to these bytes.
  void expectGoesOnWhereKilled(const std::vector<std::string>& workFiles,
                               const std::map<std::string, std::string>& expected) {
    write(directory_ / "out", ""), write(directory_ / "err", "");
    const std::vector<std::string> left = namesIn(directory_.path());
    for (const std::string& file : workFiles) {
      const pid_t child = startUntil(file);
      ASSERT_NE(child, 0) << "the conversion ended before " << file;
      kill(child, SIGKILL);
      ASSERT_EQ(wait(child), 128 + SIGKILL);
      EXPECT_FALSE(std::filesystem::exists(site_)) << file;
      const Outcome resumed = run(command({"--resume"}));
      ASSERT_EQ(resumed.code, 0) << file << ": " << resumed.err;
      EXPECT_TRUE(takeSite() == expected) << file;
      EXPECT_EQ(namesIn(directory_.path()), left) << file;
    }
  }

  static void expectSentence(const Outcome& outcome, int code, const std::string& words) {
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << "expected: " << words << "\nprinted: " << outcome.err;
  }

  TemporaryDirectory directory_;
  std::string input_ = directory_ / "relief.ply", site_ = directory_ / "site", work_ = directory_ / "work";
};

} // namespace imgeo::testing
