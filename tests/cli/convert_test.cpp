// Tests `imgeo convert` as a user runs it, with `info`, `verify`, `export` and `serve` on its sites.

#include "base/soak_testing.h"
#include "run.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>

namespace imgeo {
namespace {

using namespace testing;
using Json = nlohmann::json;

class Convert : public ::testing::Test {
protected:
  void SetUp() override { write(input_, gridPly(20)); }

  TemporaryDirectory directory_;
  std::string input_ = directory_ / "statue.ply", site_ = directory_ / "site";
};

TEST_F(Convert, ReportsWhatItChose) {
  const Outcome outcome = run({"convert", input_, "-o", site_});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "") << "silent where standard error is no terminal";
  for (const char* words : {"sig (PNG images)", "profile compact", "target web", "8 bits: step 0.25, as in the source",
                            "octahedral, 8 bits: off by at most 0.96 degrees; computed", "800 triangles",
                            "patches    1 of at most 441 vertices\n", "patch", "bytes a triangle", "memory"})
    EXPECT_NE(outcome.out.find(words), std::string::npos) << words << " is not in:\n" << outcome.out;
  EXPECT_EQ(outcome.out.find('\x1b'), std::string::npos) << "colours are for terminals";
  EXPECT_EQ(namesIn(site_), (std::vector<std::string>{"geometry", "icon.png", "imgeo.css", "imgeo.json", "index.html",
                                                      "picture.png", "runtime", "scene.x3d"}));
}

TEST_F(Convert, ReportsTheSizeOfGrids) {
  // More vertices than other patches may have.
  const std::size_t columns = 300, rows = 299;
  std::string heights = "ncols 300\nnrows 299\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
  for (std::size_t n = 0; n < columns * rows; ++n)
    heights += std::to_string(n % 7) + (n % columns == columns - 1 ? "\n" : " ");
  const std::string source = directory_ / "hills.asc";
  write(source, heights);
  const Outcome outcome = run({"convert", source, "-o", site_, "--as", "height-map", "--no-pictures"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("patches    1 grid of at most 89,700 vertices\n"), std::string::npos) << outcome.out;
  const Json report = Json::parse(run({"convert", source, "-o", site_, "--as", "height-map", "--json"}).out);
  EXPECT_EQ(report["grids"], 1);
  EXPECT_EQ(report["largestPatch"], 89'700);
}

TEST_F(Convert, PrintsHowToEmbedTheSiteInAPageBesideItsFolder) {
  const std::string site = directory_ / "A & B";
  const std::string snippet = "<script type=\"module\" src=\"A%20%26%20B/runtime/imgeo.js\"></script>\n"
                              "<imgeo-viewer src=\"A%20%26%20B/\"></imgeo-viewer>";
  const std::string printed = run({"convert", input_, "-o", site}).out;
  EXPECT_NE(printed.find(snippet), std::string::npos);
  EXPECT_NE(printed.find("imgeo serve '" + site + "'\n"), std::string::npos) << "a shell reads it as one word";
  EXPECT_EQ(Json::parse(run({"convert", input_, "-o", site + "/", "--json"}).out)["embed"], snippet);
  // The module of that name leads to the one that the site's own page loads.
  const std::string page = textOf(site + "/index.html"), module = textOf(site + "/runtime/imgeo.js");
  const std::size_t begin = page.find("src=\"runtime/imgeo-") + std::string("src=\"runtime/").size();
  EXPECT_NE(module.find("\"./" + page.substr(begin, page.find('"', begin) - begin) + "\""), std::string::npos)
      << module;
  EXPECT_EQ(run({"convert", input_, "-o", site, "--target", "x3dom"}).out.find("imgeo-viewer"), std::string::npos)
      << "that site has no runtime of ours";
}

TEST_F(Convert, ReportsTheErrorOfEverythingThatItRounds) {
  const std::string input = directory_ / "painted.ply", points = directory_ / "points.ply";
  write(input, "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
               "property float s\nproperty float t\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
               "element face 1\nproperty list uchar int vertex_index\nend_header\n"
               "0 0 0 0 0 255 0 0\n1 0 0 8 0 0 255 0\n0 1 0 0 1 0 0 255\n3 0 1 2\n");
  const Outcome outcome = run({"convert", input, "-o", site_, "-vt", "5", "-vc", "4", "-vn", "10"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* words : {"octahedral, 10 bits: off by at most 0.24 degrees",
                            "texcoords  5 bits: off by at most 0.129", "colours    4 bits: off by at most 8.5 of 255"})
    EXPECT_NE(outcome.out.find(words), std::string::npos) << words << " is not in:\n" << outcome.out;
  EXPECT_EQ(run({"verify", site_, input}).code, 0);
  const Json report = Json::parse(run({"convert", input, "-o", site_, "-vt", "5", "--json"}).out);
  EXPECT_NEAR(report["texCoordError"].get<double>(), 8.0 / 31 / 2, 1e-5);
  EXPECT_EQ(report["colorError"], 0);
  write(points, "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
                "end_header\n1 2 3\n");
  const std::string plain = run({"convert", points, "-o", site_}).out;
  for (const char* label : {"normals", "texcoords", "colours"})
    EXPECT_EQ(plain.find(label), std::string::npos) << label << " are in:\n" << plain;
}

TEST_F(Convert, ReportsTheBitsThatMaxErrorChoosesForEachMesh) {
  const std::string input = directory_ / "two.obj";
  write(input, "o small\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no large\nv 0 0 9\nv 1000 0 9\nv 0 1000 9\nf 4 5 6\n");
  const Json report = Json::parse(run({"convert", input, "-o", site_, "--max-error", "0.002", "--json"}).out);
  EXPECT_EQ(report["minPositionBits"], 9);
  EXPECT_EQ(report["positionBits"], 19);
  EXPECT_LE(report["positionError"].get<double>() * std::sqrt(3.0), 0.002);
}

TEST_F(Convert, ChoosesCompactUnlessOptionsNeedClassic) {
  const auto profileOf = [&](std::vector<std::string> options) {
    std::vector<std::string> line{"convert", input_, "-o", site_, "--json"};
    line.insert(line.end(), options.begin(), options.end());
    const Outcome outcome = run(line);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Json::parse(outcome.out)["profile"].get<std::string>();
  };
  EXPECT_EQ(profileOf({}), "compact");
  EXPECT_EQ(profileOf({"--primitives", "points"}), "compact");
  EXPECT_EQ(profileOf({"--profile", "classic"}), "classic");
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{{"--target", "x3dom"},
                                                                                       {"--primitives", "strips"},
                                                                                       {"--index", "off"},
                                                                                       {"--normals", "palette"},
                                                                                       {"-vp", "32"}})
    EXPECT_EQ(profileOf(options), "classic") << options[0];
}

TEST_F(Convert, WritesABaseMeshForLargeMeshes) {
  write(input_, gridPly(80)); // 12,800 triangles
  const auto bytesOf = [&](std::vector<std::string> options) {
    std::vector<std::string> line{"convert", input_, "-o", site_, "--patch-vertices", "3000", "--json"};
    line.insert(line.end(), options.begin(), options.end());
    EXPECT_EQ(run(line).code, 0);
    EXPECT_EQ(run({"verify", site_, input_}).code, 0);
    std::size_t bytes = 0;
    const Json info = Json::parse(run({"info", site_, "--json"}).out);
    for (const Json& file : info["files"])
      bytes += file["role"] == "base" ? file["bytes"].get<std::size_t>() : 0;
    return bytes;
  };
  const std::size_t standard = bytesOf({});
  EXPECT_GT(standard, 100u);
  EXPECT_EQ(bytesOf({"--base", "2"}), standard);
  EXPECT_NE(bytesOf({"--base", "10"}), standard);
  EXPECT_EQ(bytesOf({"--base", "0"}), 0u);
}

TEST_F(Convert, MakesPointsAndLinesSmallerThanClassicDoes) {
  std::string points = "ply\nformat ascii 1.0\nelement vertex 3000\nproperty float x\nproperty float y\n"
                       "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                       "end_header\n",
              lines = "";
  for (int i = 0; i < 3000; ++i) {
    const double angle = 0.02 * i, radius = 1 + 0.3 * std::sin(7.3 * i);
    const std::string position = std::to_string(radius * std::cos(angle)) + " " +
                                 std::to_string(radius * std::sin(angle)) + " " + std::to_string(0.001 * i);
    points += position + " " + std::to_string(i % 256) + " 80 " + std::to_string(i % 7) + "\n";
    lines += "v " + position + "\n" + (i > 0 ? "l " + std::to_string(i) + " " + std::to_string(i + 1) + "\n" : "");
  }
  for (const auto& [name, text] : {std::pair<std::string, std::string>{"cloud.ply", points}, {"wire.obj", lines}}) {
    const std::string input = directory_ / name;
    write(input, text);
    std::map<std::string, std::size_t> bytes;
    for (const std::string profile : {"compact", "classic"}) {
      ASSERT_EQ(run({"convert", input, "-o", site_, "--profile", profile}).code, 0);
      EXPECT_EQ(run({"verify", site_, input}).code, 0);
      const Json info = Json::parse(run({"info", site_, "--json"}).out);
      for (const Json& file : info["files"])
        if (file["path"].get<std::string>().starts_with("geometry/"))
          bytes[profile] += file["bytes"].get<std::size_t>();
    }
    EXPECT_LT(bytes["compact"], bytes["classic"]) << name;
    RecordProperty(name + " compact", static_cast<int>(bytes["compact"]));
    RecordProperty(name + " classic", static_cast<int>(bytes["classic"]));
  }
}

TEST_F(Convert, WritesTheSameReportToAFileAndAsJson) {
  write(input_, gridPly(14)); // too few vertices for a lattice of its own
  const Outcome outcome =
      run({"convert", "-i", input_, "-o", site_, "-r", directory_ / "report.json", "--json", "-vp", "12"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, textOf(directory_ / "report.json"));
  const Json report = Json::parse(outcome.out);
  EXPECT_EQ(report["triangles"], 392);
  EXPECT_EQ(report["vertices"], 225);
  EXPECT_EQ(report["positionBits"], 12);
  EXPECT_EQ(report["normals"], "area");
  EXPECT_DOUBLE_EQ(report["step"], 14.0 / 4095);
  const Json info = Json::parse(run({"info", site_, "--json"}).out);
  EXPECT_EQ(info["bytesPerTriangle"], report["bytesPerTriangle"]);
}

TEST_F(Convert, KeepsTheLatticeOfTheSourceWhereItIsCoarser) {
  const Json report = Json::parse(run({"convert", input_, "-o", site_, "--json", "-vp", "12"}).out);
  EXPECT_EQ(report["positionBits"], 8);
  EXPECT_EQ(report["step"], 0.25);
  EXPECT_EQ(report["positionError"], 0);
  const Outcome verified = run({"verify", site_, input_});
  EXPECT_EQ(verified.code, 0) << verified.out;
}

TEST_F(Convert, TakesEveryShortName) {
  write(input_, gridPly(14)); // too few vertices for a lattice of its own
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{{"-vp", "14"},
                                                                                       {"-qp=14"},
                                                                                       {"-vp14"},
                                                                                       {"--position-bits=14"},
                                                                                       {"-vn", "8", "-vp", "14"},
                                                                                       {"-qn", "8", "-qp", "14"},
                                                                                       {"-vt", "16", "-qp", "14"},
                                                                                       {"-qt", "16", "-qp", "14"},
                                                                                       {"-vc", "8", "-qp", "14"},
                                                                                       {"-v", "-qp", "14"}}) {
    std::vector<std::string> line{"convert", input_, "-o" + site_, "-r=" + (directory_ / "report.json").string()};
    line.insert(line.end(), options.begin(), options.end());
    const Outcome outcome = run(line);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(Json::parse(textOf(directory_ / "report.json"))["positionBits"], 14) << options.front();
  }
  EXPECT_EQ(run({"convert", "-h"}).out, run({"convert", "--help"}).out);
}

TEST_F(Convert, StoresNormalsAsRequested) {
  const auto bound = [&](std::vector<std::string> options) {
    std::vector<std::string> line{"convert", input_, "-o", site_, "--json"};
    line.insert(line.end(), options.begin(), options.end());
    const Outcome outcome = run(line);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(run({"verify", site_, input_}).code, 0);
    const Json geometry = Json::parse(run({"info", site_, "--json"}).out)["geometries"][0];
    EXPECT_EQ(geometry["normalEncoding"], options[1]);
    const Json report = Json::parse(outcome.out);
    EXPECT_EQ(geometry["normalBits"], report["normalBits"]);
    return report["normalErrorDegrees"].get<double>();
  };
  EXPECT_NEAR(bound({"--normals", "rgb", "--profile", "classic"}), 0.389, 0.001);
  EXPECT_NEAR(bound({"--normals", "octahedral", "--profile", "classic"}), 0.639, 0.001);
  EXPECT_NEAR(bound({"--normals", "spherical"}), 0.789, 0.001);
  EXPECT_LT(bound({"--normals", "palette"}), 12);
  EXPECT_NEAR(bound({"--normals", "octahedral", "--container", "bg"}), 0.639, 0.001);
  EXPECT_NEAR(bound({"--normals", "octahedral", "--container", "bg", "-vp", "20"}), 0.0025, 0.0001);
  EXPECT_NEAR(bound({"--normals", "spherical", "--container", "bg", "-vp", "10"}), 0.789, 0.001);
}

TEST_F(Convert, ReportsTrianglesThatCollapseOnACoarseLattice) {
  write(input_, gridPly(600)); // more quads along a side than 8 bits have steps
  const Outcome coarse = run({"convert", input_, "-o", site_, "-vp", "8", "--json", "--effort", "0"});
  ASSERT_EQ(coarse.code, 0) << coarse.err;
  const Json report = Json::parse(coarse.out);
  const std::size_t collapsed = report["collapsed"]["triangles"];
  EXPECT_GT(collapsed, 360'000u);
  EXPECT_NE(coarse.err.find(std::to_string(collapsed) + " of 720000 triangles have no area at 8 bits"),
            std::string::npos)
      << coarse.err;
  const Outcome fine = run({"convert", input_, "-o", site_, "--effort", "0", "--json"});
  EXPECT_EQ(fine.err, "");
  EXPECT_EQ(Json::parse(fine.out)["collapsed"]["triangles"], 0);
}

TEST_F(Convert, ReadsStandardInput) {
  ASSERT_EQ(run({"convert", input_, "-o", site_, "--title", "T"}).code, 0);
  ASSERT_EQ(run({"convert", "-", "-o", directory_ / "piped", "--title", "T"}, input_).code, 0);
  EXPECT_EQ(textOf(site_ + "/index.html"), textOf(directory_ / "piped/index.html"));
  EXPECT_EQ(run({"verify", directory_ / "piped", "-"}, input_).code, 0);
}

TEST_F(Convert, CountsTheBytesOfAPipe) {
  const std::string command = "cat " + input_ + " | " IMGEO_TOOL " convert /dev/stdin -o " + site_ + " --json";
  ASSERT_EQ(wait(startProgram("sh", {"-c", command}, directory_ / "out", directory_ / "err")), 0);
  EXPECT_EQ(Json::parse(textOf(directory_ / "out"))["sourceBytes"], textOf(input_).size());
}

TEST_F(Convert, WritesTheSameBytesWithAnyNumberOfThreads) {
  for (const std::string threads : {"1", "2"})
    ASSERT_EQ(
        run({"convert", input_, "-o", directory_ / threads, "--patch-vertices", "256", "--threads", threads}).code, 0);
  EXPECT_EQ(textOf(directory_ / "1/index.html"), textOf(directory_ / "2/index.html"));
  EXPECT_EQ(namesIn(directory_ / "1/geometry"), namesIn(directory_ / "2/geometry"));
}

TEST_F(Convert, TakesTheTitle) {
  ASSERT_EQ(run({"convert", input_, "-o", site_}).code, 0);
  EXPECT_NE(textOf(site_ + "/index.html").find("<title>statue</title>"), std::string::npos);
  ASSERT_EQ(run({"convert", input_, "-o", site_, "--title", "<Tom & \"Jerry\">"}).code, 0);
  EXPECT_NE(textOf(site_ + "/index.html").find("<title>&lt;Tom &amp; "), std::string::npos);
}

TEST_F(Convert, ReportsAxesUnitAndView) {
  const Outcome guessed = run({"convert", input_, "-o", site_});
  EXPECT_NE(guessed.out.find("guessed: "), std::string::npos) << guessed.out;
  const Outcome stated = run({"convert", input_, "-o", site_, "--up", "-x", "--rotate", "y:90,x:-12.5", "--unit", "mm",
                              "--scale", "2", "--view", "top", "--json"});
  ASSERT_EQ(stated.code, 0) << stated.err;
  const Json report = Json::parse(stated.out);
  EXPECT_EQ(report["up"], "-x");
  EXPECT_EQ(report["isUpGuessed"], false);
  EXPECT_EQ(report["rotate"], Json::parse(R"(["y:90", "x:-12.5"])"));
  EXPECT_EQ(report["scale"], 0.002);
  EXPECT_EQ(report["view"], "top");
  EXPECT_EQ(run({"verify", site_, input_}).code, 0);
}

TEST_F(Convert, ReportsWhetherEdgesAreSharpAndThatItIsAGuess) {
  const Outcome curved = run({"convert", input_, "-o", site_});
  EXPECT_NE(curved.out.find("edges      smooth, guessed: "), std::string::npos) << curved.out;
  const std::string wedge = directory_ / "wedge.obj";
  write(wedge, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 0 1 1\n"
               "f 1 4 3 2\nf 1 5 6 4\nf 2 3 6 5\nf 1 2 5\nf 4 6 3\n");
  const Outcome sharp = run({"convert", wedge, "-o", site_});
  EXPECT_NE(sharp.out.find("edges      sharp above 39 degrees, guessed: "), std::string::npos) << sharp.out;
  const Json report = Json::parse(run({"convert", wedge, "-o", site_, "--json"}).out);
  EXPECT_EQ(report["guessedEdges"], Json::parse(R"({"creaseDegrees": 39.0, "sharpMeshes": 1, "smoothMeshes": 0})"));
  EXPECT_EQ(run({"verify", site_, wedge}).code, 0);
  const Outcome stated = run({"convert", wedge, "-o", site_, "--crease-angle", "180"});
  EXPECT_EQ(stated.out.find("edges "), std::string::npos) << stated.out;
  EXPECT_NE(stated.out.find("triangles count by their area, smooth"), std::string::npos) << stated.out;
  EXPECT_EQ(run({"verify", site_, wedge}).code, 0);
}

TEST_F(Convert, ReportsTheOriginOfAModelFarFromZero) {
  const std::string far = directory_ / "far.obj";
  write(far, "v 432100.5 5412345.25 312.5\nv 432101.5 5412345.25 312.5\nv 432100.5 5412346.25 313\nf 1 2 3\n");
  const Outcome converted = run({"convert", far, "-o", site_});
  ASSERT_EQ(converted.code, 0) << converted.err;
  EXPECT_NE(converted.out.find("origin     432100 5412345 0: subtracted"), std::string::npos) << converted.out;
  const Outcome again = run({"convert", far, "-o", site_, "--force", "--json"});
  EXPECT_EQ(Json::parse(again.out)["origin"], Json::parse("[432100.0, 5412345.0, 0.0]"));
  EXPECT_EQ(run({"verify", site_, far}).code, 0);
  const Outcome near = run({"convert", input_, "-o", site_, "--force", "--json"});
  EXPECT_EQ(Json::parse(near.out)["origin"], Json::parse("[0.0, 0.0, 0.0]"));
}

/// Kills conversions after ever longer times, each of them by this factor (and 0.5 ms) longer than the one before.
class KilledConvert : public Convert {
protected:
  void killAfterTimesThatGrowBy(double factor);
};

void KilledConvert::killAfterTimesThatGrowBy(double factor) {
  write(input_, gridPly(120));
  const std::string other = directory_ / "other.ply";
  write(other, gridPly(90));
  ASSERT_EQ(run({"convert", input_, "-o", site_}).code, 0);
  const std::string oldPage = textOf(site_ + "/index.html");
  ASSERT_EQ(run({"convert", other, "-o", directory_ / "whole"}).code, 0);
  const std::string newPage = textOf(directory_ / "whole/index.html");
  ASSERT_NE(oldPage, newPage);

  int killed = 0;
  unsigned delayUs = 0;
  bool finished = false;
  for (int round = 0; !finished && round < 60; ++round) {
    ASSERT_EQ(run({"convert", input_, "-o", site_}).code, 0);
    const pid_t child = start({"convert", other, "-o", site_}, "/dev/null", "/dev/null");
    usleep(delayUs);
    kill(child, SIGKILL);
    finished = wait(child) == 0;
    killed += !finished;
    delayUs = static_cast<unsigned>(delayUs * factor) + 500;

    const std::string page = textOf(site_ + "/index.html");
    const bool isNew = page == newPage;
    ASSERT_TRUE(isNew || page == oldPage);
    ASSERT_EQ(run({"verify", site_, isNew ? other : input_}).code, 0) << "after " << delayUs << " us";
  }
  EXPECT_GT(killed, 5) << "hardly ever killed, so hardly tested";
  ASSERT_EQ(run({"convert", other, "-o", site_}).code, 0);
  EXPECT_EQ(namesIn(directory_.path()), (std::vector<std::string>{"other.ply", "site", "statue.ply", "whole"}));
}

TEST_F(KilledConvert, AtAnyMomentLeavesTheOldSiteOrTheNew) {
  killAfterTimesThatGrowBy(2);
}

SOAK_TEST_F(KilledConvert, AtManyMomentsLeavesTheOldSiteOrTheNew) {
  killAfterTimesThatGrowBy(1.25);
}

/// Interrupts conversions when `hasBegun`; on a busy machine some end before the signal.
class InterruptedConvert : public Convert {
protected:
  int codeAfter(int signal, std::vector<std::string> arguments, const std::function<bool()>& hasBegun) {
    int code = 0;
    for (int attempt = 0; code == 0 && attempt < 5; ++attempt) {
      for (const std::string& name : namesIn(directory_.path()))
        if (name != "statue.ply")
          std::filesystem::remove_all(directory_ / name);
      const pid_t child = start(arguments, "/dev/null", directory_ / "err");
      for (int waited = 0; !hasBegun() && waited < 5000; ++waited)
        usleep(1000);
      kill(child, signal);
      code = wait(child);
    }
    return code;
  }
};

TEST_F(InterruptedConvert, RemovesItsFiles) {
  write(input_, gridPly(400));
  const auto hasStaged = [&] {
    return std::ranges::any_of(namesIn(directory_.path()),
                               [](const std::string& name) { return name.starts_with(".site.imgeo-"); });
  };
  for (const int signal : {SIGINT, SIGTERM}) {
    EXPECT_EQ(codeAfter(signal, {"convert", input_, "-o", site_, "--effort", "9"}, hasStaged), 128 + signal);
    EXPECT_EQ(namesIn(directory_.path()), (std::vector<std::string>{"err", "statue.ply"}));
  }
}

/// Readers report no progress; this file keeps one busy for seconds.
std::string longPly() {
  std::string lines = "ply\nformat ascii 1.0\nelement vertex 3000000\nproperty float x\nproperty float y\n"
                      "property float z\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n";
  for (int i = 0; i < 3000000; ++i)
    lines += "0.123456789 1.23456789 2.3456789\n";
  return lines;
}

TEST_F(InterruptedConvert, LeavesNothingWhereItReads) {
  write(input_, longPly());
  const std::string folder = directory_ / "new";
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    EXPECT_EQ(codeAfter(signal, {"convert", input_, "-o", folder + "/folder/site", "--threads", "1"},
                        [&] { return std::filesystem::exists(folder); }),
              128 + signal);
    EXPECT_EQ(textOf(directory_ / "err"), "imgeo: interrupted; nothing has changed\n");
    EXPECT_EQ(namesIn(directory_.path()), (std::vector<std::string>{"err", "statue.ply"}));
  }
}

TEST_F(Convert, SaysSoWhenItsInputIsShortenedWhileItIsRead) {
  write(input_, longPly());
  const pid_t child = start({"convert", input_, "-o", directory_ / "new/folder/site", "--threads", "1"}, "/dev/null",
                            directory_ / "err");
  const std::string maps = "/proc/" + std::to_string(child) + "/maps";
  for (int waited = 0; textOf(maps).find("statue.ply") == std::string::npos && waited < 50000; ++waited)
    usleep(100);
  std::filesystem::resize_file(input_, 1000);
  EXPECT_EQ(wait(child), 2);
  EXPECT_EQ(textOf(directory_ / "err"),
            "imgeo: an input file has been shortened while it was read; nothing has changed\n");
  EXPECT_EQ(namesIn(directory_.path()), (std::vector<std::string>{"err", "statue.ply"}));
}

TEST_F(Convert, RefusesASiteWithAFileOfSomebodyElse) {
  ASSERT_EQ(run({"convert", input_, "-o", site_}).code, 0);
  write(site_ + "/geometry/notes.txt", "mine");
  const Outcome refused = run({"convert", input_, "-o", site_});
  EXPECT_EQ(refused.code, 1);
  EXPECT_NE(refused.err.find("site/geometry/notes.txt: is in the site but was not written by imgeo"), std::string::npos)
      << refused.err;
  EXPECT_EQ(textOf(site_ + "/geometry/notes.txt"), "mine");
  EXPECT_EQ(run({"verify", site_, input_}).code, 0);
  EXPECT_EQ(run({"convert", input_, "-o", site_, "--force"}).code, 0);
  EXPECT_FALSE(std::filesystem::exists(site_ + "/geometry/notes.txt"));
}

TEST_F(Convert, InfoHasItsDocumentedKeysAndConsistentSums) {
  ASSERT_EQ(run({"convert", input_, "-o", site_, "--patch-vertices", "256"}).code, 0);
  const Outcome outcome = run({"info", site_, "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json info = Json::parse(outcome.out);
  for (const char* key : {"triangles", "vertices", "patches", "documentBytes", "containerBytes", "runtimeBytes",
                          "bytesPerTriangle", "files"})
    EXPECT_TRUE(info.contains(key)) << key;
  EXPECT_EQ(info["triangles"], 800);
  EXPECT_GT(info["patches"], 1);
  std::size_t document = 0, containers = 0, runtime = 0;
  for (const Json& file : info["files"]) {
    EXPECT_EQ(file["bytes"], std::filesystem::file_size(site_ + "/" + file["path"].get<std::string>()));
    const std::string role = file["role"];
    (role == "document"  ? document
     : role == "runtime" ? runtime
                         : containers) += role == "scene" || role == "style" || role == "marker" || role == "picture"
                                              ? 0
                                              : file["bytes"].get<std::size_t>();
  }
  EXPECT_EQ(info["documentBytes"], document);
  EXPECT_EQ(info["containerBytes"], containers);
  EXPECT_EQ(info["runtimeBytes"], runtime);
  EXPECT_GE(info["bytesPerTriangle"].get<double>() * 800, static_cast<double>(containers));

  for (const std::string path : {"/index.html", "/scene.x3d"})
    EXPECT_EQ(Json::parse(run({"info", site_ + path, "--json"}).out)["containerBytes"], containers) << path;
  const std::string image = site_ + "/geometry/" + namesIn(site_ + "/geometry").front();
  EXPECT_EQ(Json::parse(run({"info", image, "--json"}).out)["namedByContent"], true);
  EXPECT_EQ(Json::parse(run({"info", input_, "--json"}).out)["triangles"], 800);

  std::filesystem::remove(image);
  const Outcome incomplete = run({"info", site_});
  EXPECT_EQ(incomplete.code, 2);
  EXPECT_EQ(incomplete.err,
            "imgeo: " + image + ": is named by the document but cannot be read: No such file or directory\n");
}

TEST_F(Convert, VerifyExitsWithThreeAndReportsDifferencesOfAnotherSite) {
  ASSERT_EQ(run({"convert", input_, "-o", site_}).code, 0);
  EXPECT_EQ(run({"verify", site_, input_}).code, 0);
  write(directory_ / "other.ply", gridPly(19));
  const Outcome outcome = run({"verify", site_, directory_ / "other.ply", "--json"});
  EXPECT_EQ(outcome.code, 3);
  const Json report = Json::parse(outcome.out);
  EXPECT_EQ(report["equal"], false);
  EXPECT_GT(report["extraTriangles"], 0);
  EXPECT_FALSE(report["findings"].empty());
}

TEST_F(Convert, KeepsTheAttributesThatAreNamed) {
  write(input_, "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                "property float heat\nproperty uchar label\nelement face 1\n"
                "property list uchar int vertex_indices\nend_header\n0 0 0 0.5 1\n1 0 0 1.5 2\n0 1 0 -3 9\n3 0 1 2\n");
  EXPECT_NE(run({"info", input_}).out.find("heat, label"), std::string::npos);
  for (const std::vector<std::string>& encoding :
       {std::vector<std::string>{}, {"--profile", "classic"}, {"--container", "bg"}}) {
    std::vector<std::string> command{"convert", input_, "-o", site_, "--keep-attributes", "label,heat", "--json"};
    command.insert(command.end(), encoding.begin(), encoding.end());
    const Outcome outcome = run(command);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(Json::parse(outcome.out)["attributes"].size(), 2);
    EXPECT_EQ(run({"verify", site_, input_}).code, 0);
    EXPECT_NE(run({"info", site_}).out.find("further attributes heat, label\n"), std::string::npos);
    ASSERT_EQ(run({"export", site_, "-o", directory_ / "out.ply"}).code, 0);
    EXPECT_NE(textOf(directory_ / "out.ply").find("property float heat\nproperty float label\n"), std::string::npos);
  }
}

TEST_F(Convert, KeepsMoreAttributesThanCompactHoldsInClassic) {
  std::string properties;
  for (char name = 'a'; name <= 'n'; ++name)
    properties += std::string("property uchar ") + name + "\n";
  write(input_, "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n" +
                    properties + "end_header\n0 0 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14\n");
  const std::vector<std::string> command{"convert", input_, "-o", site_, "--json", "--keep-attributes"};
  const auto runWith = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), command.begin(), command.end());
    return run(arguments);
  };
  EXPECT_EQ(Json::parse(runWith({"all"}).out)["profile"], "classic");
  EXPECT_EQ(run({"verify", site_, input_}).code, 0);
  EXPECT_EQ(Json::parse(runWith({"a,b,c,d,e,f,g,h,i,j,k,l,m"}).out)["profile"], "compact");
  EXPECT_EQ(run({"verify", site_, input_}).code, 0);
  const Outcome refused = runWith({"all", "--profile", "compact"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_NE(refused.err.find("13 further attributes of a mesh, not 14"), std::string::npos) << refused.err;
}

TEST_F(Convert, DropsDegenerateAndRepeatedElementsOnRequest) {
  write(input_, "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
                "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
                "0 0 0\n1 0 0\n0 1 0\n1 1 0\n5 5 5\n3 0 1 2\n3 1 3 2\n3 2 0 1\n3 4 4 1\n");
  for (const auto& [drop, left] : {std::pair{"none", 4}, {"degenerate", 3}, {"repeated", 3}, {"both", 2}})
    for (const std::string profile : {"compact", "classic"}) {
      const Outcome outcome = run({"convert", input_, "-o", site_, "--profile", profile, "--drop", drop, "--json"});
      ASSERT_EQ(outcome.code, 0) << outcome.err;
      const Json report = Json::parse(outcome.out);
      EXPECT_EQ(report["triangles"], left) << drop;
      EXPECT_EQ(report["weld"]["degenerateElements"], 1);
      EXPECT_EQ(report["weld"]["duplicateElements"], 1);
      const Outcome verified = run({"verify", site_, input_});
      EXPECT_EQ(verified.code, 0) << verified.out;
    }
  const std::string output = run({"convert", input_, "-o", site_, "--drop", "degenerate"}).out;
  EXPECT_NE(output.find("dropped 1 degenerate elements, kept 1 repeated ones"), std::string::npos) << output;
}

TEST_F(Convert, ServePrintsTheAddressAndStopsOnCtrlC) {
  ASSERT_EQ(run({"convert", input_, "-o", site_}).code, 0);
  const pid_t child = start({"serve", site_, "--port", "0"}, directory_ / "out", directory_ / "err");
  for (int waited = 0; textOf(directory_ / "out").empty() && waited < 5000; ++waited)
    usleep(1000);
  EXPECT_NE(textOf(directory_ / "out").find("http://127.0.0.1:"), std::string::npos) << textOf(directory_ / "err");
  kill(child, SIGINT);
  EXPECT_EQ(wait(child), 0) << textOf(directory_ / "err");
}

} // namespace
} // namespace imgeo
