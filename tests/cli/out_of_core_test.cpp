// Conversions out of core as processes that are killed, lose their work folder, or have little memory.

#include "out_of_core.h"

#include <csignal>
#include <sys/resource.h>

namespace imgeo {
namespace {

using namespace testing;

TEST_F(OutOfCoreProcess, GoesOnWithTheSameBytesWhereverItWasKilled) {
  ASSERT_EQ(run(command()).code, 0);
  const auto expected = takeSite();
  EXPECT_GT(expected.size(), 60u);
  expectGoesOnWhereKilled({"0/survey-done", "0/scatter-0-done", "0/normals-0-3", "0/groups-0-5", "0/groups-1-0"},
                          expected);
}

TEST_F(OutOfCoreProcess, EndsWithASentenceWhereTheWorkFolderIsLost) {
  const pid_t child = startUntil("0/groups-0-2");
  ASSERT_NE(child, 0);
  std::filesystem::rename(work_, directory_ / "elsewhere");
  expectSentence({wait(child), "", textOf(directory_ / "err")}, 2, work_);
  expectSentence(run(command({"--resume"})), 1, "no work folder of an earlier run");
  EXPECT_FALSE(std::filesystem::exists(site_));
  EXPECT_FALSE(std::filesystem::exists(work_));
}

TEST_F(OutOfCoreProcess, EndsWithASentenceWhereAnotherRunUsesTheWorkFolder) {
  const pid_t child = startUntil("0/survey-done");
  ASSERT_NE(child, 0);
  kill(child, SIGSTOP);
  expectSentence(run(command({"--resume"})), 1, "a run that has not ended");
  kill(child, SIGCONT);
  EXPECT_EQ(wait(child), 0) << textOf(directory_ / "err");
}

/// The memory that a process may write: heap, stacks and private mappings.
constexpr rlim_t maxDataBytes = 128u << 20;

/// Writes a PLY file again, with further values behind each vertex, so many that the file is several times as large as
/// maxDataBytes.
void widen(const std::string& file) {
  constexpr std::size_t properties = 450;
  const std::string ply = textOf(file), zeros(8 * properties, '\0');
  std::size_t body = ply.find("end_header\n") + 11;
  std::string header = ply.substr(0, body), lines;
  const std::size_t vertices = std::stoul(header.substr(header.find("element vertex ") + 15));
  for (std::size_t i = 0; i < properties; ++i)
    lines += "property double value" + std::to_string(i) + "\n";
  header.insert(header.find("element face"), lines);
  std::ofstream out(file, std::ios::binary);
  out << header;
  for (std::size_t vertex = 0; vertex < vertices; ++vertex, body += 12)
    out << std::string_view(ply).substr(body, 12) << zeros;
  out << std::string_view(ply).substr(body);
}

TEST_F(OutOfCoreProcess, TakesLessMemoryThanItsSourceHasBytes) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer takes more";
#endif
  sample(input_, 200000);
  ASSERT_EQ(run(command()).code, 0);
  const auto expected = takeSite();
  widen(input_);
  ASSERT_GT(std::filesystem::file_size(input_), 5 * maxDataBytes / 2);
  const pid_t child = start(command(), directory_ / "out", directory_ / "err", "/dev/null", [] {
    const rlimit limit{maxDataBytes, maxDataBytes};
    setrlimit(RLIMIT_DATA, &limit);
  });
  ASSERT_EQ(wait(child), 0) << textOf(directory_ / "err");
  const auto files = takeSite();
  EXPECT_EQ(files.size(), expected.size());
  for (const auto& [name, text] : expected)
    EXPECT_TRUE(!name.starts_with("/geometry/") || (files.contains(name) && files.at(name) == text)) << name;
}

} // namespace
} // namespace imgeo
