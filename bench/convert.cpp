// What `imgeo convert` takes and gives, measured as a user would see it: whole
// processes, medians of five, peak memory as the kernel counts it. Each site is
// verified before it is timed. On the first model every effort, and npm's gltfpack (meshoptimizer
// compiled to WebAssembly) runs beside it, on the same mesh as GLB.
// Prints Markdown tables for the README.
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

/// The median time and the largest peak.
Run measure(const std::vector<std::string>& words) {
  std::vector<double> seconds;
  Run result;
  for (int i = 0; i < runs; ++i) {
    const Run run = runOnce(words);
    seconds.push_back(run.seconds);
    result.peakBytes = std::max(result.peakBytes, run.peakBytes);
  }
  std::ranges::sort(seconds);
  result.seconds = seconds[runs / 2];
  return result;
}

double millions(double number) {
  return number / 1e6;
}

struct Measured {
  Run run;
  Json report;
};

Measured measureConvert(const std::string& model, const std::string& container, const std::string& effort,
                        const fs::path& work) {
  const std::string site = work / "site", report = work / "report.json";
  const std::vector<std::string> words{"build/imgeo", "convert", model,  "-o",       site,  "--container",
                                       container,     "-r",      report, "--effort", effort};
  runOnce(words);
  runOnce({"build/imgeo", "verify", site, model});
  Measured measured{measure(words), {}};
  measured.report = Json::parse(asText(readFile(report)));
  return measured;
}

void printRow(const std::string& name, const std::string& container, const Measured& measured) {
  const double triangles = measured.report["triangles"];
  std::map<std::string, double> bytes;
  for (const Json& role : measured.report["roles"])
    bytes[role["role"]] += role["bytes"].get<double>();
  const auto each = [&](const std::string& role) { return bytes[role] / triangles; };
  fmt::print("| {} | {} | {:.0f} | {:.2f} s | {:.2f} M/s | {:.0f} MB | {:.2f} | {:.2f} | {:.2f} | {:.3f} | "
             "**{:.2f}** |\n",
             name, container, triangles, measured.run.seconds, millions(triangles / measured.run.seconds),
             millions(static_cast<double>(measured.run.peakBytes)), each("index"), each("coord"),
             each("normal"), each("document"), measured.report["bytesPerTriangle"].get<double>());
  std::fflush(stdout);
}

void compareWithGltfpack(const std::string& model, const Measured& sig, const fs::path& work) {
  const fs::path glb = work / "model.glb", packed = work / "packed.glb";
  writePrepared(model, glb, MeshFormat::glb);
  const Json package = Json::parse(asText(readFile("node_modules/gltfpack/package.json")));
  const double triangles = sig.report["triangles"];
  fmt::print("\n| {} | time | ratio | peak memory | bytes/triangle |\n|---|--:|--:|--:|--:|\n",
             fs::path(model).filename().string());
  const auto print = [&](const std::string& what, const Run& run, double bytes) {
    fmt::print("| {} | {:.2f} s | {:.2f} | {:.0f} MB | {:.2f} |\n", what, run.seconds,
               run.seconds / sig.run.seconds, millions(static_cast<double>(run.peakBytes)),
               bytes / triangles);
    std::fflush(stdout);
  };
  print("imgeo convert, from gzipped ASCII PLY", sig.run,
        triangles * sig.report["bytesPerTriangle"].get<double>());
  for (const std::vector<std::string>& options : {std::vector<std::string>{}, {"-cc"}}) {
    std::vector<std::string> words{
        "node", "node_modules/gltfpack/cli.js", "-i", glb, "-o", packed, "-vp", "16", "-vn", "8"};
    words.insert(words.end(), options.begin(), options.end());
    const Run run = measure(words);
    print(fmt::format("gltfpack {} (npm, library.wasm) -vp 16 -vn 8{}, from GLB",
                      package["version"].get<std::string>(), options.empty() ? "" : " -cc"),
          run, static_cast<double>(fs::file_size(packed)));
  }
}

/// What each effort takes and gives, as images.
void compareEfforts(const std::string& model, const fs::path& work) {
  fmt::print("\n| {}, --effort | time | bytes/triangle | peak memory, bytes/triangle |\n|---|--:|--:|--:|\n",
             fs::path(model).filename().string());
  for (int effort = 0; effort <= 9; ++effort) {
    const Measured measured = measureConvert(model, "sig", std::to_string(effort), work);
    const double triangles = measured.report["triangles"];
    fmt::print("| {} | {:.2f} s | {:.3f} | {:.0f} |\n", effort, measured.run.seconds,
               measured.report["bytesPerTriangle"].get<double>(),
               static_cast<double>(measured.run.peakBytes) / triangles);
    std::fflush(stdout);
  }
}

int benchmark(const std::vector<std::string>& models) {
  std::string pattern = (fs::temp_directory_path() / "imgeo-bench-XXXXXX").string();
  const fs::path work = mkdtemp(pattern.data());
  fmt::print("| model | container | triangles | convert | speed | peak memory | index | coord | normal | "
             "document | together |\n"
             "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  std::vector<Measured> first;
  for (const std::string& model : models)
    for (const std::string container : {"sig", "bg"}) {
      const Measured measured = measureConvert(model, container, defaultEffort, work);
      printRow(fs::path(model).filename(), container, measured);
      first.push_back(measured);
    }
  fmt::print("\nBytes a triangle by role; medians of {} runs on {} threads.\n", runs,
             sysconf(_SC_NPROCESSORS_ONLN));
  compareWithGltfpack(models.front(), first.front(), work);
  compareEfforts(models.front(), work);
  fs::remove_all(work);
  return 0;
}

} // namespace
} // namespace imgeo

int main(int count, char** words) {
  if (count < 2) {
    fmt::print(stderr, "usage: build/bench/convert MODEL...\n");
    return 1;
  }
  return imgeo::benchmark({words + 1, words + count});
}
