// Cost of levels of detail as meshes grow: a generated closed surface of each size is converted with all processors and
// verified. Prints a Markdown table of time, processor time and peak memory, and of the bytes of all levels beside
// those of level 0.
//
//   build/bench/massive TRIANGLES...        (in the repository's root)

#include "bench/process.h"

#include <nlohmann/json.hpp>

namespace imgeo {
namespace fs = std::filesystem;

namespace {

struct LevelBytes {
  double triangles = 0, lowest = 0, all = 0;
  std::size_t levels = 0;
};

/// What `imgeo info` states of a site with one mesh.
LevelBytes levelBytesOf(const fs::path& site) {
  const std::string command = fmt::format("build/imgeo info --json '{}'", site.string());
  FILE* output = popen(command.c_str(), "r"); // a child process: this one must stay small (runOnce)
  const nlohmann::json info = output ? nlohmann::json::parse(output, nullptr, false) : nlohmann::json();
  if (!output || pclose(output) != 0 || !info.is_object()) {
    fmt::print(stderr, "failed: {}\n", command);
    std::exit(1);
  }
  const nlohmann::json& levels = info.at("geometries").at(0).at("levels");
  LevelBytes found;
  found.levels = levels.size();
  found.triangles = levels.at(0).at("triangles").get<double>();
  found.lowest = levels.at(0).at("bytes").get<double>();
  for (const nlohmann::json& level : levels)
    found.all += level.at("bytes").get<double>();
  return found;
}

void printSize(const std::string& size, const fs::path& folder) {
  const std::string source = folder / "relief.ply", site = folder / "site";
  runOnce({"build/imgeo", "sample", "relief", "--triangles", size, "-o", source});
  const Run converted =
      runOnce({"build/imgeo", "convert", source, "-o", site, "--levels", "always", "--no-pictures", "--force"});
  const Run verified = runOnce({"build/imgeo", "verify", site, source});
  const LevelBytes bytes = levelBytesOf(site);
  const auto cells = [&](const Run& run) {
    const double millions = bytes.triangles / 1e6;
    return fmt::format("{:.2f} | {:.2f} | {:.0f}", run.seconds / millions, run.processorSeconds / millions,
                       static_cast<double>(run.peakBytes) / bytes.triangles);
  };
  fmt::print("| {:.0f} | {} | {:.2f} | {:.2f} | {} | {} |\n", bytes.triangles, bytes.levels,
             bytes.all / bytes.triangles, bytes.all / bytes.lowest, cells(converted), cells(verified));
  std::fflush(stdout);
  fs::remove_all(site);
}

} // namespace
} // namespace imgeo

int main(int count, char** words) {
  return imgeo::runInFolder(
      count, words, "massive", [](const std::vector<std::string>& sizes, const imgeo::fs::path& folder) {
        fmt::print(
            "| triangles | levels | bytes a triangle | all levels ÷ level 0 | convert: s a million | processor s a "
            "million | peak bytes a triangle | verify: s a million | processor s a million | peak bytes a "
            "triangle |\n|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
        std::fflush(stdout);
        for (const std::string& size : sizes)
          imgeo::printSize(size, folder);
      });
}
