#pragma once
// Runs other programs for comparison, and writes the mesh that all of them read.

#include "base/file.h"
#include "export/export.h"
#include "transcode/source/preparation.h"

#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

extern char** environ;

namespace imgeo {

struct Run {
  double seconds = 0;
  double processorSeconds = 0;
  std::uint64_t peakBytes = 0;
};

/// Runs a program and waits for it; a failure ends the benchmark. This process
/// stays small, since a child's peak memory begins with that of its parent.
inline Run runOnce(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words)
    arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  const auto start = std::chrono::steady_clock::now();
  pid_t child = 0;
  int status = -1;
  struct rusage usage {};
  if (posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ) == 0)
    wait4(child, &status, 0, &usage);
  posix_spawn_file_actions_destroy(&actions);
  if (status != 0) {
    fmt::print(stderr, "failed: {}\n", fmt::join(words, " "));
    std::exit(1);
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const auto inSeconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
  };
  return {seconds.count(), inSeconds(usage.ru_utime) + inSeconds(usage.ru_stime),
          static_cast<std::uint64_t>(usage.ru_maxrss) * 1024};
}

/// Writes a model, welded and with the normals that `imgeo convert` computes, in a child process.
inline void writePrepared(const std::string& model, const std::filesystem::path& file, MeshFormat format) {
  const pid_t child = fork();
  if (child == 0) {
    std::uint64_t bytes = 0;
    Scene scene = importInput(model, {}, bytes).scene;
    prepareScene(scene, {}, model);
    writeFile(file, exportScene(scene, format));
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (status != 0)
    std::exit(1);
}

/// The main function of a benchmark: calls measure(models, folder) with the models of the command line and an empty
/// temporary folder, which is removed afterwards.
template <typename Measure>
int runInFolder(int count, char** words, const std::string& program, const Measure& measure) {
  if (count < 2) {
    fmt::print(stderr, "usage: build/bench/{} MODEL...\n", program);
    return 1;
  }
  std::string pattern = (std::filesystem::temp_directory_path() / "imgeo-bench-XXXXXX").string();
  const std::filesystem::path folder = mkdtemp(pattern.data());
  measure(std::vector<std::string>(words + 1, words + count), folder);
  std::filesystem::remove_all(folder);
  return 0;
}

} // namespace imgeo
