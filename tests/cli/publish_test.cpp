// Tests what `imgeo publish` reads: frames of floats and PLY frames, and what it says of frames that are damaged.

#include "run.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

using namespace testing;

std::string framePly(int vertices) {
  std::string ply = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices) +
                    "\nproperty float x\nproperty float y\nproperty float z\nproperty float heat\nend_header\n";
  for (int i = 0; i < vertices; ++i)
    ply += std::to_string(0.1 * i) + " 0 0 " + std::to_string(i % 2) + "\n";
  return ply;
}

class Publish : public ::testing::Test {
protected:
  Outcome publish(const std::string& frames, const std::vector<std::string>& options = {}) {
    const std::string file = directory_ / "frames";
    write(file, frames);
    std::vector<std::string> line{"publish", file, "--box", "0,0,0,1,1,1", "--port", "0", "--rate", "1000"};
    line.insert(line.end(), options.begin(), options.end());
    return run(line);
  }

  void expectRefusal(const Outcome& outcome, int code, const std::string& words) {
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << "expected: " << words << "\nprinted: " << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  }

  TemporaryDirectory directory_;
};

TEST_F(Publish, ReadsPlyFramesWithTheirValues) {
  const Outcome outcome =
      publish(framePly(12) + framePly(12) + framePly(12), {"--values", "0,1", "--attribute", "heat"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("3 frames"), std::string::npos) << outcome.out;
  // x runs to 1.1.
  EXPECT_NE(outcome.out.find("3 values clamped"), std::string::npos) << outcome.out;
}

TEST_F(Publish, ReadsFloats) {
  const Outcome outcome = publish(std::string(2 * 5 * 3 * 4, '\0'), {"--vertices", "5"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("2 frames"), std::string::npos) << outcome.out;
}

TEST_F(Publish, NamesTheFrameThatIsWrong) {
  expectRefusal(publish(std::string(65, '\0'), {"--vertices", "5"}), 3, "frames, frame 1: the input ends within");
  expectRefusal(publish(std::string(65, '\0')), 1, "--vertices is missing");
  const std::string ply = framePly(12);
  expectRefusal(publish(ply + ply.substr(0, ply.size() - 60)), 3, "frames, frame 1: the input ends after");
  expectRefusal(publish(ply + framePly(11)), 3, "frames, frame 1: there are 11 vertices; the stream has 12");
  expectRefusal(publish(ply + "nonsense\n"), 3, "frames, frame 1: this is no PLY file");
  expectRefusal(publish(ply, {"--normals", "8"}), 3, "frames, frame 0: the vertices have no normals");
  expectRefusal(publish(ply, {"--values", "0,1"}), 1, "--attribute is missing");
  expectRefusal(publish(ply, {"--values", "0,1", "--attribute", "cold"}), 3, "no \"cold\"");
  expectRefusal(publish(""), 1, "--vertices is missing");
}

TEST_F(Publish, RefusesWhatItCannotRepeat) {
  expectRefusal(run({"publish", "--box", "0,0,0,1,1,1", "--loop"}), 1, "--loop repeats files");
}

} // namespace
} // namespace imgeo
