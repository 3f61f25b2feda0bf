// Time, peak memory and output size of `imgeo convert`, as a user sees them: whole processes, medians of five, peak
// memory as the kernel counts it. Each site is verified before it is timed. Runs alternate with npm's gltfpack
// (meshoptimizer compiled to WebAssembly) on the same meshes as GLB. The first model is measured at every effort.
// Prints Markdown tables.
//
//   build/bench/convert MODEL...        (in the repository's root)

#include "base/file.h"
#include "bench/process.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <unistd.h>
#include <vector>

namespace imgeo {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int runs = 5;
constexpr const char* defaultEffort = "5";

/// For each program the median times and the maximum peak memory. Runs alternate, so that other load on the machine
/// affects all programs alike.
std::vector<Run> measureInTurns(const std::vector<std::vector<std::string>>& programs) {
  std::vector<std::vector<Run>> all(programs.size());
  for (int round = 0; round < runs; ++round)
    for (std::size_t i = 0; i < programs.size(); ++i)
      all[i].push_back(runOnce(programs[i]));
  std::vector<Run> medians;
  for (std::vector<Run>& ofProgram : all) {
    const auto median = [&](auto member) {
      std::ranges::nth_element(ofProgram, ofProgram.begin() + runs / 2, {}, member);
      return ofProgram[runs / 2].*member;
    };
    const double seconds = median(&Run::seconds), processorSeconds = median(&Run::processorSeconds);
    medians.push_back({seconds, processorSeconds, std::ranges::max(ofProgram, {}, &Run::peakBytes).peakBytes});
  }
  return medians;
}

double millions(double number) {
  return number / 1e6;
}

struct Measured {
  Run run;
  Json report;
};

/// `encoding`: compact, classic or bg.
std::vector<std::string> convertWords(const std::string& model, const std::string& encoding, const std::string& effort,
                                      const fs::path& work) {
  return {"build/imgeo", "convert",     model,
          "-o",          work / "site", encoding == "bg" ? "--container" : "--profile",
          encoding,      "-r",          work / "report.json",
          "--effort",    effort};
}

Json reportIn(const fs::path& work) {
  return Json::parse(asText(readFile(work / "report.json")));
}

Measured measureConvert(const std::string& model, const std::string& encoding, const std::string& effort,
                        const fs::path& work) {
  const std::vector<std::string> words = convertWords(model, encoding, effort, work);
  runOnce(words);
  runOnce({"build/imgeo", "verify", work / "site", model});
  const Run run = measureInTurns({words})[0];
  return {run, reportIn(work)};
}

void printRow(const std::string& name, const std::string& encoding, const Measured& measured) {
  const double triangles = measured.report["triangles"];
  std::map<std::string, double> bytes;
  for (const Json& role : measured.report["roles"])
    bytes[role["role"]] += role["bytes"].get<double>();
  const auto each = [&](const std::string& role) { return bytes[role] / triangles; };
  fmt::print("| {} | {} | {:.0f} | {:.2f} s | {:.2f} M/s | {:.0f} MB | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.3f} | "
             "**{:.2f}** |\n",
             name, encoding, triangles, measured.run.seconds, millions(triangles / measured.run.seconds),
             millions(static_cast<double>(measured.run.peakBytes)), each("index"), each("coord"), each("normal"),
             each("patch") + each("base"), each("document"), measured.report["bytesPerTriangle"].get<double>());
  std::fflush(stdout);
}

/// Measures both programs with the same GLB: the mesh welded and with normals.
void compareWithGltfpack(const std::string& model, const fs::path& work) {
  const std::string name = fs::path(model).filename(), glb = work / "model.glb", packed = work / "packed.glb";
  writePrepared(model, glb, MeshFormat::glb);
  const Json package = Json::parse(asText(readFile("node_modules/gltfpack/package.json")));
  const std::vector<std::string> gltfpack{
      "node", "node_modules/gltfpack/cli.js", "-i", glb, "-o", packed, "-vp", "16", "-vn", "8"};
  std::vector<std::string> gltfpackCompressed = gltfpack;
  gltfpackCompressed.push_back("-cc");

  const auto fromGlb = convertWords(glb, "classic", defaultEffort, work),
             fromModel = convertWords(model, "classic", defaultEffort, work),
             compact = convertWords(glb, "compact", defaultEffort, work);
  runOnce(compact);
  const double compactBytes = reportIn(work)["bytesPerTriangle"];
  runOnce(fromGlb);
  const Json report = reportIn(work);
  runOnce(gltfpack);
  const auto size = static_cast<double>(fs::file_size(packed));
  runOnce(gltfpackCompressed);
  const auto sizeCompressed = static_cast<double>(fs::file_size(packed));

  const std::vector<Run> measured = measureInTurns({fromGlb, fromModel, compact, gltfpack, gltfpackCompressed});
  const double triangles = report["triangles"], ours = triangles * report["bytesPerTriangle"].get<double>();
  fmt::print("\n| {} | time | of imgeo's | processor time | peak memory | bytes/triangle |\n"
             "|---|--:|--:|--:|--:|--:|\n",
             name);
  const auto print = [&](const std::string& what, const Run& run, double bytes) {
    fmt::print("| {} | {:.2f} s | {:.2f} | {:.2f} s | {:.0f} MB | {:.2f} |\n", what, run.seconds,
               run.seconds / measured[0].seconds, run.processorSeconds, millions(static_cast<double>(run.peakBytes)),
               bytes / triangles);
  };
  const std::string version =
      fmt::format("gltfpack {} (npm, library.wasm) `-vp 16 -vn 8", package["version"].get<std::string>());
  print("imgeo convert --profile classic, from GLB", measured[0], ours);
  print("imgeo convert --profile classic, from " + name, measured[1], ours);
  print("imgeo convert --profile compact, from GLB", measured[2], triangles * compactBytes);
  print(version + "`, from GLB", measured[3], size);
  print(version + " -cc`, from GLB", measured[4], sizeCompressed);
  std::fflush(stdout);
}

/// Time and size at each effort, as images of classic.
void compareEfforts(const std::string& model, const fs::path& work) {
  fmt::print("\n| {}, --effort | time | bytes/triangle | peak memory, bytes/triangle |\n|---|--:|--:|--:|\n",
             fs::path(model).filename().string());
  for (int effort = 0; effort <= 9; ++effort) {
    const Measured measured = measureConvert(model, "classic", std::to_string(effort), work);
    const double triangles = measured.report["triangles"];
    fmt::print("| {} | {:.2f} s | {:.3f} | {:.0f} |\n", effort, measured.run.seconds,
               measured.report["bytesPerTriangle"].get<double>(),
               static_cast<double>(measured.run.peakBytes) / triangles);
    std::fflush(stdout);
  }
}

void benchmark(const std::vector<std::string>& models, const fs::path& work) {
  fmt::print("| model | form | triangles | convert | speed | peak memory | index | coord | normal | "
             "patch and base | document | together |\n"
             "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const std::string& model : models)
    for (const std::string encoding : {"compact", "classic", "bg"})
      printRow(fs::path(model).filename(), encoding, measureConvert(model, encoding, defaultEffort, work));
  fmt::print("\nBytes a triangle by role; medians of {} runs on {} threads.\n", runs, sysconf(_SC_NPROCESSORS_ONLN));
  for (const std::string& model : models)
    compareWithGltfpack(model, work);
  compareEfforts(models.front(), work);
}

} // namespace
} // namespace imgeo

int main(int count, char** words) {
  return imgeo::runInFolder(count, words, "convert", imgeo::benchmark);
}
