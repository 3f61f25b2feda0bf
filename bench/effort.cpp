// Size and time at each effort of the PNG encoder, for all images of SIG classic in fan order: bytes by kind of image,
// and processor seconds on one thread, the better of two runs. Prints the table of docs/decisions/png-effort.md.
//
//   build/bench/effort MODEL...

#include "base/parallel.h"
#include "bench/models.h"
#include "containers/container_reader.h"
#include "prepare/primitives.h"

#include <algorithm>
#include <ctime>
#include <filesystem>

namespace imgeo {
namespace {

struct Measured {
  double seconds = 0;
  std::size_t index = 0, high = 0, low = 0, other = 0;
};

Measured measure(const std::vector<IndexedPatch>& patches, const GeometryDescription& geometry, int effort) {
  EncodeOptions options;
  options.effort = effort;
  Measured measured;
  const std::clock_t start = std::clock();
  for (const IndexedPatch& patch : patches) {
    std::size_t coordImages = 0;
    for (const EncodedFile& file : encodePatch(patch, geometry, options).files) {
      const bool isCoord = file.role == Role::coord;
      (file.role == Role::index ? measured.index
       : !isCoord               ? measured.other
       : coordImages == 0       ? measured.high
                                : measured.low) += file.bytes.size();
      coordImages += isCoord;
    }
  }
  measured.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return measured;
}

void printTable(const std::string& path) {
  bench::visitSurfaces(path, [&](const Mesh& mesh) {
    const PatchedMesh patched = bench::patchesOf(mesh);
    const GeometryDescription geometry = describe(patched, {});
    std::vector<IndexedPatch> patches;
    for (const Patch& patch : patched.patches)
      patches.push_back(asTriangles(patch));
    fmt::print("\n| {}, --effort | s | index | coord high | coord low | normal | all |\n"
               "|---|--:|--:|--:|--:|--:|--:|\n",
               std::filesystem::path(path).filename().string());
    for (int effort = 0; effort <= 9; ++effort) {
      Measured m = measure(patches, geometry, effort);
      m.seconds = std::min(m.seconds, measure(patches, geometry, effort).seconds);
      fmt::print("| {} | {:.2f} | {} | {} | {} | {} | {} |\n", effort, m.seconds, m.index, m.high, m.low, m.other,
                 m.index + m.high + m.low + m.other);
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
