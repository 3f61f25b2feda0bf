// Size and time at each effort of the PNG encoder, for all images of SIG classic in fan order: bytes by kind of image,
// and processor seconds on one thread, the shorter time of two runs. Prints the table of docs/decisions/png-effort.md.
//
//   build/bench/effort MODEL...

#include "base/parallel.h"
#include "bench/models.h"
#include "containers/container_reader.h"

#include <algorithm>
#include <ctime>
#include <filesystem>

namespace imgeo {
namespace {

struct Measured {
  double seconds = 0; ///< of processor time
  bench::ImageBytes bytes;
};

Measured measure(const std::vector<IndexedPatch>& patches, const GeometryDescription& geometry, int effort) {
  EncodeOptions options;
  options.effort = effort;
  Measured measured;
  const std::clock_t start = std::clock();
  for (const IndexedPatch& patch : patches)
    measured.bytes.add(encodePatch(patch, geometry, options));
  measured.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return measured;
}

void printTable(const std::string& path) {
  bench::visitSurfaces(path, [&](const Mesh& mesh) {
    const PatchedMesh patched = bench::patchesOf(mesh);
    const GeometryDescription geometry = describe(patched, {});
    const std::vector<IndexedPatch> patches = bench::patchesInFanOrder(patched);
    fmt::print("\n| {}, --effort | s | index | coord high | coord low | normal | all |\n"
               "|---|--:|--:|--:|--:|--:|--:|\n",
               std::filesystem::path(path).filename().string());
    for (int effort = 0; effort <= 9; ++effort) {
      Measured m = measure(patches, geometry, effort);
      m.seconds = std::min(m.seconds, measure(patches, geometry, effort).seconds);
      fmt::print("| {} | {:.2f} | {} | {} | {} | {} | {} |\n", effort, m.seconds, m.bytes.index, m.bytes.high,
                 m.bytes.low, m.bytes.other, m.bytes.all());
      std::fflush(stdout);
    }
  });
}

} // namespace
} // namespace imgeo

int main(int count, char** words) {
  using namespace imgeo;
  return bench::run([&] {
    limitThreads(1);
    for (const std::string& model : bench::modelArguments(count, words, "effort", 5).models)
      printTable(model);
  });
}
