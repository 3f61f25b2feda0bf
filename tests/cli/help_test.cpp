// Compares the texts made from the flag table with golden files, so that a change to them
// is seen in review. IMGEO_REWRITE_GOLDEN=1 rewrites them.

#include "run.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

using namespace testing;

void expectGolden(const std::string& name, const std::vector<std::string>& words) {
  const Outcome outcome = run(words);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string file = std::string(IMGEO_GOLDENS) + "/" + name;
  if (std::getenv("IMGEO_REWRITE_GOLDEN"))
    write(file, outcome.out);
  EXPECT_EQ(outcome.out, textOf(file)) << file;
}

TEST(Help, EqualsItsReviewedGoldens) {
  expectGolden("help.txt", {"--help"});
  for (const std::string command :
       {"convert", "info", "verify", "export", "transform", "sample", "serve", "publish", "completion", "manual"})
    expectGolden("help-" + command + ".txt", {command, "--help"});
}

TEST(Help, CompletionsAndManualEqualTheirReviewedGoldens) {
  for (const std::string shell : {"bash", "zsh", "fish"})
    expectGolden("completion." + shell, {"completion", shell});
  expectGolden("imgeo.1", {"manual"});
}

TEST(Help, EveryLineFitsATerminal) {
  for (const std::string command :
       {"convert", "info", "verify", "export", "transform", "sample", "serve", "publish", "completion", "manual"}) {
    std::istringstream lines(run({command, "--help"}).out);
    bool examples = false;
    for (std::string line; std::getline(lines, line);) {
      examples |= line == "Examples:"; // those are copied whole
      EXPECT_TRUE(examples || line.size() <= 80) << line;
    }
  }
}

TEST(Help, BashCompletesOptionsAndChoices) {
  const TemporaryDirectory directory;
  write(directory / "imgeo.bash", run({"completion", "bash"}).out);
  const auto complete = [&](const std::string& words, int at) {
    write(directory / "ask.bash", ". " + (directory / "imgeo.bash").string() + "\nCOMP_WORDS=(" + words +
                                      ")\nCOMP_CWORD=" + std::to_string(at) + "\n_imgeo\necho \"${COMPREPLY[@]}\" >" +
                                      (directory / "reply").string() + "\n");
    EXPECT_EQ(std::system(("bash " + (directory / "ask.bash").string()).c_str()), 0);
    return textOf(directory / "reply");
  };
  EXPECT_EQ(complete("imgeo co", 1), "convert completion\n");
  EXPECT_EQ(complete("imgeo convert --cont", 2), "--container\n");
  EXPECT_EQ(complete("imgeo convert --inp", 2), "--input\n");
  EXPECT_EQ(complete("imgeo convert --container ''", 3), "sig bg\n");
  EXPECT_EQ(complete("imgeo completion z", 2), "zsh\n");
}

TEST(Help, VersionIsOneLine) {
  const Outcome outcome = run({"--version"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(outcome.out.starts_with("imgeo ")) << outcome.out;
}

} // namespace
} // namespace imgeo
