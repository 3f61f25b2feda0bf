// Tests that the tool answers every error with one clear sentence on standard error and the documented exit code, and
// leaves no files behind.

#include "run.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using namespace testing;

class Faults : public ::testing::Test {
protected:
  /// Runs `convert` on a file of this text and expects it to fail as stated.
  void expectRefusal(const std::string& name, const std::string& text, int code, const std::string& words,
                     const std::vector<std::string>& options = {}) {
    const std::string input = directory_ / name;
    write(input, text);
    std::vector<std::string> line{"convert", input, "-o", directory_ / "deep/site"};
    line.insert(line.end(), options.begin(), options.end());
    expectSentence(run(line), code, words);
    EXPECT_EQ(namesIn(directory_.path()), std::vector<std::string>{name}) << "something was left behind";
    std::filesystem::remove(input);
  }

  static void expectSentence(const Outcome& outcome, int code, const std::string& words) {
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(outcome.err.starts_with("imgeo: ")) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << "expected: " << words << "\nprinted: " << outcome.err;
  }

  TemporaryDirectory directory_;
};

std::string header(const std::string& format, const std::string& vertices, const std::string& faces) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

TEST_F(Faults, RefusesATruncatedPly) {
  const std::string whole = gridPly(10);
  expectRefusal("cut.ply", whole.substr(0, whole.size() / 2), 3, "cut.ply");
  expectRefusal("cut.ply", header("binary_little_endian", "100", "10") + std::string(50, 'x'), 3, "cut.ply");
}

TEST_F(Faults, RefusesAPlyThatClaimsFourBillionFaces) {
  expectRefusal("liar.ply", header("ascii", "3", "4294967295") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", 3, "liar.ply");
  expectRefusal("liar.ply", header("binary_little_endian", "0", "4294967295"), 3, "liar.ply");
}

TEST_F(Faults, RefusesCoordinatesThatAreNoNumbers) {
  for (const char* bad : {"nan", "inf", "-inf"})
    expectRefusal("bad.ply", header("ascii", "3", "1") + "0 0 0\n1 " + bad + " 0\n0 1 0\n3 0 1 2\n", 3, "bad.ply:11");
}

TEST_F(Faults, RefusesTextureCoordinatesAndAttributesThatAreNoNumbers) {
  const auto cloud = [](const std::string& properties, const std::string& values) {
    return "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n" +
           properties + "end_header\n0 0 0 " + values + "\n";
  };
  expectRefusal("bad.ply", cloud("property float s\nproperty float t\n", "nan 0"), 3, "texture coordinate");
  expectRefusal("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt nan 0\nf 1/1 2/1 3/1\n", 3, "texture coordinate");
  const std::string heat = cloud("property float heat\n", "inf");
  expectRefusal("bad.ply", heat, 3, "attribute", {"--keep-attributes", "heat"});
  expectRefusal("bad.ply", heat, 1, "no attribute \"cold\" but heat", {"--keep-attributes", "cold"});
}

TEST_F(Faults, RefusesAnEmptyMesh) {
  expectRefusal("empty.ply", header("ascii", "0", "0"), 3, "empty.ply");
  expectRefusal("empty.ply", "", 3, "empty.ply");
  expectRefusal("empty.obj", "# nothing\n", 3, "empty.obj");
}

TEST_F(Faults, RefusesAnUnknownFormat) {
  expectRefusal("statue.max", "what is this", 3, "statue.max");
  expectRefusal("photo.png", "\x89PNG\r\n\x1a\n", 3, "photo.png");
}

TEST_F(Faults, RefusesAnInputThatIsMissingOrADirectory) {
  expectSentence(run({"convert", directory_ / "missing.ply", "-o", directory_ / "site"}), 2, "No such file");
  expectSentence(run({"convert", "/tmp", "-o", directory_ / "site"}), 2, "is a directory");
  expectSentence(run({"verify", directory_ / "site", directory_ / "missing.ply"}), 2, "site");
  EXPECT_TRUE(std::filesystem::is_empty(directory_.path()));
}

TEST_F(Faults, RefusesATargetThatCannotBeWritten) {
  write(directory_ / "mesh.ply", gridPly(3));
  expectSentence(run({"convert", directory_ / "mesh.ply", "-o", directory_ / "mesh.ply/site"}), 2, "mesh.ply");
  expectSentence(run({"convert", directory_ / "mesh.ply", "-o", "/proc/site"}), 2, "/proc");
  expectSentence(run({"convert", directory_ / "mesh.ply", "-o", "/dev/null"}), 2, "/dev/null");
  EXPECT_EQ(namesIn(directory_.path()), std::vector<std::string>{"mesh.ply"});
}

TEST_F(Faults, RefusesADirectoryThatIsNotASite) {
  std::filesystem::create_directory(directory_ / "photos");
  write(directory_ / "photos/cat.jpg", "cat");
  write(directory_ / "mesh.ply", gridPly(3));
  expectSentence(run({"convert", directory_ / "mesh.ply", "-o", directory_ / "photos"}), 1, "--force");
  EXPECT_EQ(namesIn(directory_ / "photos"), std::vector<std::string>{"cat.jpg"});
  EXPECT_EQ(namesIn(directory_.path()), (std::vector<std::string>{"mesh.ply", "photos"}));

  EXPECT_EQ(run({"convert", directory_ / "mesh.ply", "-o", directory_ / "photos", "--force"}).code, 0);
  EXPECT_FALSE(std::filesystem::exists(directory_ / "photos/cat.jpg"));
}

TEST_F(Faults, RefusesAnInputInsideTheDirectoryThatIsReplaced) {
  std::filesystem::create_directory(directory_ / "scans");
  write(directory_ / "scans/mesh.ply", gridPly(3));
  expectSentence(run({"convert", directory_ / "scans/mesh.ply", "-o", directory_ / "scans", "--force"}), 1, "inside");
  EXPECT_TRUE(std::filesystem::exists(directory_ / "scans/mesh.ply"));
}

TEST_F(Faults, RefusesOptionsThatCannotBeHonoured) {
  const auto refuse = [&](const std::string& words, const std::vector<std::string>& options) {
    expectRefusal("mesh.ply", gridPly(3), 1, words, options);
  };
  refuse("--normal-bits", {"--profile", "classic", "--normal-bits", "12"});
  refuse("--normal-bits", {"--container", "bg", "-vn", "12"});
  refuse("--normals", {"--normals", "cube"});
  refuse("--normals", {"--container", "bg", "--normals", "palette"});
  refuse("--normal-bits", {"--container", "bg", "--normals", "spherical", "-vp", "20", "-vn", "8"});
  refuse("--normal-bits", {"--normals", "palette", "-vn", "16"});
  refuse("--normal-bits", {"--profile", "classic", "--target", "x3dom", "-vn", "16"});
  refuse("--texcoord-bits", {"--profile", "classic", "--texcoord-bits", "12"});
  refuse("--texcoord-bits", {"--container", "bg", "--texcoord-bits", "24"});
  refuse("--texcoord-bits", {"--target", "x3dom", "--texcoord-bits", "24"});
  refuse("--color-bits", {"--container", "bg", "--color-bits", "24"});
  refuse("--color-bits", {"--profile", "compact", "--color-bits", "16"});
  refuse("--images", {"--container", "bg", "--images", "webp"});
  refuse("--images", {"--profile", "compact", "--images", "webp"});
  refuse("--images", {"--target", "x3dom", "--images", "webp"});
  refuse("--normal-bits", {"--container", "bg", "--normals", "spherical", "-vn", "32"});
  refuse("--normal-bits", {"--container", "bg", "--normals", "octahedral", "-vn", "32"});
  refuse("--normal-bits", {"--container", "bg", "--normals", "octahedral", "-vn", "8", "-vp", "8"});
  refuse("--normals", {"--target", "x3dom", "--normals", "octahedral"});
  refuse("--normals", {"--container", "bg", "--normals", "spherical", "--coord-type", "int16", "--target", "x3dom"});
  refuse("--coord-type", {"--coord-type", "uint16"});
  refuse("--coord-type", {"--container", "bg", "--coord-type", "float64"});
  refuse("--coord-type", {"--container", "bg", "--coord-type", "int8", "--target", "x3dom"});
  refuse("--layout", {"--layout", "interleaved"});
  refuse("--position-bits", {"--container", "bg", "--coord-type", "uint8", "-vp", "9"});
  refuse("--position-bits", {"--container", "bg", "--coord-type", "float32", "-vp", "25"});
  refuse("--position-bits", {"--container", "bg", "--coord-type", "int16", "-vp", "16", "--target", "x3dom"});
  refuse("--normal-bits",
         {"--container", "bg", "--coord-type", "int16", "--layout", "interleaved", "-vn", "8", "--target", "x3dom"});
  refuse("--position-bits", {"-vp", "7"});
  refuse("--position-bits", {"-qp", "33"});
  refuse("--position-bits", {"--position-bits", "abc"});
  refuse("--position-bits", {"--position-bits", "16.5"});
  refuse("--texcoord-bits", {"-vt", "12", "--profile", "classic"});
  refuse("--color-bits", {"-vc", "5", "--profile", "classic"});
  refuse("--profile", {"--profile", "dense"});
  refuse("--profile", {"--profile", "compact", "--container", "bg"});
  refuse("--profile", {"--profile", "compact", "--target", "x3dom"});
  refuse("--primitives", {"--profile", "compact", "--primitives", "strips"});
  refuse("--index", {"--profile", "compact", "--index", "off"});
  refuse("--normals", {"--profile", "compact", "--normals", "palette"});
  refuse("--normals", {"--normals", "derived", "--profile", "classic"});
  refuse("--base", {"--base", "26"});
  refuse("--base", {"--base", "-1"});
  refuse("--base", {"--base", "2%"});
  refuse("--base", {"--base", "2", "--profile", "classic"});
  refuse("--base", {"--base", "2", "--container", "bg"});
  refuse("--normal-bits", {"--profile", "compact", "--normal-bits", "17"});
  refuse("--position-bits", {"--profile", "compact", "--position-bits", "31"});
  refuse("--max-error", {"--max-error", "0"});
  refuse("--max-error", {"--max-error", "1mm"});
  refuse("--max-error", {"--max-error", "1e-30"});
  refuse("--max-error", {"--max-error", "0.1%", "--position-bits", "12"});
  refuse("--max-error", {"--max-error", "0.1%", "--container", "bg"});
  refuse("--target", {"--target", "vrml"});
  refuse("--up", {"--up", "north"});
  for (const char* rotation : {"90", "w:90", "x:", "x:90,", "x:90y:90", "x:inf", "x:1e999"})
    refuse("--rotate", {"--rotate", rotation});
  for (const char* scale : {"0", "-1", "2x", "inf", "1e13"})
    refuse("--scale", {"--scale", scale});
  refuse("--unit", {"--unit", "mile"});
  refuse("--view", {"--view", "outside"});
  refuse("--position-bits", {"--target", "x3dom", "--container", "bg", "-vp", "17"});
  refuse("--x3dom-url", {"--x3dom-url", "lib/"});
  refuse("--primitives", {"--primitives", "fans"});
  refuse("--patch-vertices", {"--patch-vertices", "4194305"});
  refuse("--patch-vertices", {"--patch-vertices", "65536", "--target", "x3dom"});
  refuse("--effort", {"--effort", "10"});
  refuse("nor any other", {"--keep-attributes", "heat"});
  refuse("--keep-attributes", {"--target", "x3dom", "--keep-attributes", "all"});
  refuse("--attribute-bits", {"--attribute-bits", "12"});
  refuse("--attribute-bits", {"--attribute-bits", "8"});
  refuse("--texture-quality", {"--texture-quality", "50"});
  refuse("--texture-quality", {"--texture-quality", "50", "--textures", "png"});
  refuse("--attribute-bits", {"--container", "bg", "--attribute-bits", "16"});
  refuse("did you mean --container?", {"--contaner", "bg"});
  refuse("--profile", {"another.ply", "--profile", "compact"}); // the frames of a sequence
  refuse("--container is given more than once", {"--container", "bg", "--container", "sig"});
}

TEST_F(Faults, RefusesCommandsThatAreIncomplete) {
  expectSentence(run({}), 1, "no command");
  expectSentence(run({"convrt"}), 1, "did you mean convert?");
  expectSentence(run({"convert", "mesh.ply"}), 1, "--output DIR is missing");
  expectSentence(run({"convert", "-o", "site"}), 1, "INPUT is missing");
  expectSentence(run({"convert", "mesh.ply", "-o"}), 1, "--output lacks its value");
  expectSentence(run({"verify", "site"}), 1, "INPUT is missing");
  expectSentence(run({"completion", "tcsh"}), 1, "tcsh");
}

TEST_F(Faults, ReportsAFullDevice) {
  if (!std::filesystem::exists("/dev/full"))
    GTEST_SKIP();
  write(directory_ / "mesh.ply", gridPly(3));
  const pid_t child = start({"info", directory_ / "mesh.ply"}, "/dev/full", directory_ / "err");
  EXPECT_EQ(wait(child), 2);
  EXPECT_NE(textOf(directory_ / "err").find("standard output"), std::string::npos);
}

} // namespace
} // namespace imgeo
