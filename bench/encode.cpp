// Processor time and peak memory of writing compact at each effort, on one thread, beside
// Draco and gltfpack on the same mesh: whole processes, medians of three. Ours reads a GLB's
// equal as PLY, welds it and writes the page too. Prints a Markdown table.
//
//   build/bench/encode MODEL...        (in the repository's root, with draco_encoder installed)

#include "bench/process.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace imgeo {
namespace {

namespace fs = std::filesystem;

Run median(const std::vector<std::string>& words) {
  std::vector<Run> runs{runOnce(words), runOnce(words), runOnce(words)};
  std::ranges::sort(runs, {}, &Run::processorSeconds);
  return runs[1];
}

void printModel(const std::string& model, const fs::path& work) {
  const fs::path ply = work / "mesh.ply", glb = work / "mesh.glb";
  const std::string site = work / "site", report = work / "report.json", out = work / "out";
  writePrepared(model, ply, MeshFormat::ply);
  writePrepared(model, glb, MeshFormat::glb);
  const Run draco = median({"draco_encoder", "-i", ply, "-o", out, "-cl", "10", "-qp", "16", "-qn", "8"});
  double triangles = 0;
  const auto print = [&](const std::string& what, const Run& run, std::uint64_t bytes) {
    fmt::print("| {} | {} | {:.2f} | {:.2f} | {:.0f} | {} |\n", fs::path(model).filename().string(), what,
               run.processorSeconds / triangles * 1e6, run.processorSeconds / draco.processorSeconds,
               static_cast<double>(run.peakBytes) / triangles, bytes);
    std::fflush(stdout);
  };
  for (int effort = 0; effort <= 9; ++effort) {
    const Run run = median({"build/imgeo", "convert", ply, "-o", site, "--profile", "compact", "--effort",
                            std::to_string(effort), "--threads", "1", "-r", report});
    const auto json = nlohmann::json::parse(asText(readFile(report)));
    triangles = json["triangles"];
    print(fmt::format("imgeo, --effort {}", effort), run,
          static_cast<std::uint64_t>(json["bytesPerTriangle"].get<double>() * triangles + 0.5));
  }
  print("draco_encoder -cl 10", draco, fs::file_size(work / "out"));
  const std::string packed = work / "packed.glb";
  const Run gltfpack = median({"node", "node_modules/gltfpack/cli.js", "-i", glb, "-o", packed, "-cz", "-vp",
                               "16", "-vn", "8", "-kv"});
  print("gltfpack -cz", gltfpack, fs::file_size(packed));
}

void benchmark(const std::vector<std::string>& models, const fs::path& work) {
  fmt::print("| model | | s / million triangles | of Draco's | peak memory, bytes / triangle | bytes |\n"
             "|---|---|--:|--:|--:|--:|\n");
  for (const std::string& model : models)
    printModel(model, work);
}

} // namespace
} // namespace imgeo

int main(int count, char** words) {
  return imgeo::runInFolder(count, words, "encode", imgeo::benchmark);
}
