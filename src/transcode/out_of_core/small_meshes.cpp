#include "transcode/out_of_core/small_meshes.h"

#include "containers/option_checks.h"
#include "transcode/out_of_core/large_meshes.h"
#include "transcode/out_of_core/memory_needs.h"
#include "transcode/source/preparation.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

namespace {

constexpr std::uint64_t storedElementBytes = 64; ///< on disk, about

constexpr std::uint64_t batchElementBytes = 200; ///< in memory, while meshes of a batch are read and prepared
constexpr std::uint64_t batchShare = 4;          ///< a batch takes this part of the memory
constexpr std::uint64_t minBatchElements = 1u << 14;

/// The triangles and points of a batch, about, of a source of so many meshes.
std::uint64_t batchElements(std::size_t meshes, const ConvertOptions& options) {
  const std::uint64_t fixed = inCoreMemory(0) + structureMemory(meshes),
                      memory = options.memoryBytes - std::min(options.memoryBytes, fixed);
  return std::clamp<std::uint64_t>(memory / batchShare / batchElementBytes,
                                   std::min<std::uint64_t>(minBatchElements, options.regionTriangles),
                                   options.regionTriangles);
}

std::uint64_t elementsOf(const ChunkedSource& source, const std::set<std::size_t>& meshes) {
  std::uint64_t elements = 0;
  for (const std::size_t mesh : meshes)
    elements += source.mesh(mesh).elementCount();
  return elements;
}

} // namespace

std::set<std::size_t> smallMeshes(const ChunkedSource& source, const ConvertOptions& options) {
  std::set<std::size_t> small;
  for (std::size_t mesh = 0; mesh < source.meshCount(); ++mesh)
    small.insert(small.end(), mesh);
  for (const std::size_t mesh : largeMeshes(source, options))
    small.erase(mesh);
  return small;
}

bool fitTogether(const ChunkedSource& source, const ConvertOptions& options) {
  return inCoreMemory(elementsOf(source, smallMeshes(source, options))) + structureMemory(source.meshCount()) <=
         options.memoryBytes;
}

void requireMemoryForMeshes(const ChunkedSource& source, const ConvertOptions& options) {
  std::uint64_t largest = 0;
  for (const std::size_t mesh : smallMeshes(source, options))
    largest = std::max(largest, source.mesh(mesh).elementCount());
  if (inCoreMemory(largest) > options.memoryBytes)
    refuseOption("--memory",
                 fmt::format("a mesh of {} triangles or points gets no levels of detail or has at most {}, and is "
                             "converted in memory, which takes about {} MB",
                             largest, options.regionTriangles, inCoreMemory(largest) / 1'000'000));
  const std::uint64_t ofLarge = largeMeshes(source, options).empty() ? 0 : minimumMemory(options.regionTriangles),
                      each = std::max(inCoreMemory(largest), ofLarge), ofAll = structureMemory(source.meshCount());
  if (each + ofAll > options.memoryBytes)
    refuseOption("--memory", fmt::format("what is known of {} meshes takes about {} MB, beside at least {} MB of one",
                                         source.meshCount(), ofAll / 1'000'000, each / 1'000'000));
}

std::unique_ptr<MeshFiles> storeSmallMeshes(const ChunkedSource& source, const ImportOptions& importOptions,
                                            const ConvertOptions& options, Ranks& ranks, const Progress& progress) {
  ranks.beginSmallMeshes();
  const WorkFolder& work = ranks.work();
  const std::set<std::size_t> meshes = smallMeshes(source, options);
  const PreparationOptions preparation = preparationFor(options);
  const std::vector<std::set<std::size_t>> batches =
      batchesOf(source, meshes, batchElements(source.meshCount(), options));
  std::uint64_t missing = 0;
  for (const std::set<std::size_t>& batch : batches)
    if (!work.has(fileOfBatch(batch)))
      missing += elementsOf(source, batch);
  work.requireDisk(missing * storedElementBytes);
  auto files = std::make_unique<MeshFiles>();
  for (std::size_t i = 0; i < batches.size(); ++i) {
    if (progress)
      progress(static_cast<double>(i) / static_cast<double>(batches.size()), "reading small meshes");
    ranks.check();
    const std::string file = fileOfBatch(batches[i]);
    if (!work.has(file))
      work.write(file, readBatch(source, batches[i], importOptions,
                                 [&](Scene& scene) { return prepareScene(scene, preparation, source.name()); }));
    files->add(work.file(file));
  }
  return files;
}

} // namespace imgeo
