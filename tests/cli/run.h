#pragma once
// Runs the built tool as a user's shell would.

#include "base/testing.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace imgeo::testing {

inline std::string textOf(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

inline void write(const std::string& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

inline std::vector<std::string> namesIn(const std::filesystem::path& directory) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(directory))
    names.push_back(entry.path().filename());
  std::ranges::sort(names);
  return names;
}

/// A square of 2 n^2 triangles, slightly waved, as ASCII PLY without normals.
inline std::string gridPly(int n) {
  std::ostringstream ply;
  ply << "ply\nformat ascii 1.0\nelement vertex " << (n + 1) * (n + 1)
      << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << 2 * n * n
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x)
      ply << x << ' ' << y << ' ' << (x * y % 7) * 0.25 << '\n';
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
      ply << "3 " << a << ' ' << b << ' ' << d << "\n3 " << a << ' ' << d << ' ' << c << '\n';
    }
  return ply.str();
}

struct Outcome {
  int code = -1; ///< exit code; 128 + signal if a signal ended the tool
  std::string out, err;
};

/// Starts a program, which is looked for in the PATH, with its output in the files `out` and `err`, and `input` as
/// standard input. The new process calls `prepare` before. Returns its process id.
inline pid_t startProgram(
    const std::string& program, const std::vector<std::string>& words, const std::string& out, const std::string& err,
    const std::string& input = "/dev/null", void (*prepare)() = [] {}) {
  const pid_t child = fork();
  if (child != 0)
    return child;
  dup2(open(input.c_str(), O_RDONLY), 0);
  dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
  dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
  std::vector<char*> arguments{const_cast<char*>(program.c_str())};
  for (const std::string& word : words)
    arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  prepare();
  execvp(program.c_str(), arguments.data());
  _exit(127);
}

/// The same for the tool.
inline pid_t start(
    const std::vector<std::string>& words, const std::string& out, const std::string& err,
    const std::string& input = "/dev/null", void (*prepare)() = [] {}) {
  return startProgram(IMGEO_TOOL, words, out, err, input, prepare);
}

/// Waits for a process and returns its exit code, or 128 + signal if a signal ended it.
inline int wait(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

inline Outcome run(const std::vector<std::string>& words, const std::string& input = "/dev/null") {
  const TemporaryDirectory directory;
  Outcome outcome;
  outcome.code = wait(start(words, directory / "out", directory / "err", input));
  outcome.out = textOf(directory / "out");
  outcome.err = textOf(directory / "err");
  return outcome;
}

} // namespace imgeo::testing
