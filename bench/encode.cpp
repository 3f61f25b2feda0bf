// Processor time and peak memory of writing compact at each effort, compared with Draco and gltfpack on the same mesh:
// whole processes on one processor, alternating, medians of five. imgeo and Draco read the mesh as PLY, gltfpack as
// GLB; imgeo also welds it and writes the page, whose pictures have a row of their own. Memory is that beyond a process
// of the same program that does nothing. Prints a Markdown table.
//
//   build/bench/encode MODEL...        (in the repository's root, with draco_encoder installed)

#include "bench/process.h"

#include <algorithm>
#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <sched.h>

namespace imgeo {
namespace {

namespace fs = std::filesystem;

/// Applies to this process and to all processes that it starts.
void stayOnOneProcessor() {
  cpu_set_t allowed, first;
  CPU_ZERO(&first);
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0)
    for (int processor = 0; processor < CPU_SETSIZE && CPU_COUNT(&first) == 0; ++processor)
      if (CPU_ISSET(processor, &allowed))
        CPU_SET(processor, &first);
  if (sched_setaffinity(0, sizeof first, &first) != 0) {
    fmt::print(stderr, "cannot stay on one processor\n");
    std::exit(1);
  }
}

struct Program {
  std::string name;
  std::vector<std::string> words;
  std::vector<std::string> idleWords;   ///< has it start and end
  std::function<std::uint64_t()> bytes; ///< returns the number of bytes that the program has written
  std::vector<Run> runs;

  const Run& median() {
    std::ranges::sort(runs, {}, &Run::processorSeconds);
    return runs[runs.size() / 2];
  }
};

constexpr std::array efforts{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
constexpr int rounds = 5;

void printModel(const std::string& model, const fs::path& work) {
  const fs::path ply = work / "mesh.ply", glb = work / "mesh.glb";
  const std::string out = work / "out", packed = work / "packed.glb";
  writePrepared(model, ply, MeshFormat::ply);
  writePrepared(model, glb, MeshFormat::glb);
  double triangles = 0;
  std::vector<Program> programs;
  programs.push_back({"draco_encoder -cl 10",
                      {"draco_encoder", "-i", ply, "-o", out, "-cl", "10", "-qp", "16", "-qn", "8"},
                      {"draco_encoder", "-h"},
                      [&] { return fs::file_size(out); },
                      {}});
  const auto addConversion = [&](const std::string& name, int effort, bool hasPictures) {
    const std::string site = work / fmt::format("site{}", programs.size()), report = site + ".json";
    std::vector<std::string> words{
        "build/imgeo",          "convert",   ply, "-o", site,  "--profile", "compact", "--effort",
        std::to_string(effort), "--threads", "1", "-r", report};
    if (!hasPictures)
      words.push_back("--no-pictures");
    programs.push_back({name,
                        words,
                        {"build/imgeo", "--version"},
                        [&triangles, report] {
                          const auto json = nlohmann::json::parse(asText(readFile(report)));
                          triangles = json["triangles"];
                          return static_cast<std::uint64_t>(json["bytesPerTriangle"].get<double>() * triangles + 0.5);
                        },
                        {}});
  };
  for (const int effort : efforts)
    addConversion(fmt::format("imgeo, --effort {}", effort), effort, false);
  addConversion("imgeo, --effort 5, with pictures", 5, true);
  programs.push_back(
      {"gltfpack -cz",
       {"node", "node_modules/gltfpack/cli.js", "-i", glb, "-o", packed, "-cz", "-vp", "16", "-vn", "8", "-kv"},
       {"node", "node_modules/gltfpack/cli.js", "-v"},
       [&] { return fs::file_size(packed); },
       {}});
  for (int round = 0; round < rounds; ++round)
    for (Program& program : programs)
      program.runs.push_back(runOnce(program.words));
  std::vector<std::uint64_t> bytes;
  for (const Program& program : programs)
    bytes.push_back(program.bytes());
  const double draco = programs[0].median().processorSeconds;
  for (std::size_t i = 0; i < programs.size(); ++i) {
    const Run& run = programs[i].median();
    const std::uint64_t idleBytes = runOnce(programs[i].idleWords).peakBytes;
    fmt::print("| {} | {} | {:.2f} | {:.2f} | {:.0f} | {} |\n", fs::path(model).filename().string(), programs[i].name,
               run.processorSeconds / triangles * 1e6, run.processorSeconds / draco,
               static_cast<double>(run.peakBytes - std::min(idleBytes, run.peakBytes)) / triangles, bytes[i]);
  }
  std::fflush(stdout);
}

void benchmark(const std::vector<std::string>& models, const fs::path& work) {
  stayOnOneProcessor();
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
