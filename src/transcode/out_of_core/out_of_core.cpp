#include "transcode/out_of_core/out_of_core.h"

#include "transcode/out_of_core/large_levels.h"
#include "transcode/out_of_core/large_meshes.h"

#include <fmt/format.h>

namespace imgeo {

namespace {

/// Calls visit(levels) for each large mesh of a source.
template <typename Visit>
void forEachMesh(const ChunkedSource& source, const ImportOptions& importOptions, const ConvertOptions& options,
                 Ranks& ranks, const Progress& progress, Visit visit) {
  const std::vector<std::size_t> meshes = largeMeshes(source, options);
  const auto all = static_cast<double>(elementsOf(source, meshes));
  std::uint64_t before = 0;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const ChunkedMesh mesh = source.mesh(meshes[i]);
    const std::uint64_t behind = before + mesh.elementCount();
    const Progress named = [&](double share, const std::string& step) {
      if (progress)
        progress(share, meshes.size() == 1 ? step : fmt::format("mesh {} of {}: {}", i + 1, meshes.size(), step));
    };
    ranks.beginMesh(mesh.number());
    const LargeTask task{mesh,
                         importOptions,
                         options,
                         ranks,
                         named,
                         {static_cast<double>(before) / all, static_cast<double>(behind) / all},
                         elementsOf(source, std::span(meshes).subspan(i + 1))};
    visit(*(mesh.topology() == Topology::points ? largeCloudLevels(task) : largeMeshLevels(task)));
    before = behind;
  }
}

} // namespace

std::vector<LargeMesh> buildOutOfCore(const ChunkedSource& source, const ImportOptions& importOptions,
                                      const ConvertOptions& options, Ranks& ranks, ContentFiles& files,
                                      const Progress& progress) {
  std::vector<LargeMesh> meshes;
  forEachMesh(source, importOptions, options, ranks, progress, [&](LargeLevels& levels) {
    levels.buildShared();
    meshes.push_back(levels.finish(files));
  });
  return meshes;
}

std::size_t shareOutOfCore(const ChunkedSource& source, const ImportOptions& importOptions,
                           const ConvertOptions& options, Ranks& ranks, const Progress& progress) {
  std::size_t tasks = 0;
  forEachMesh(source, importOptions, options, ranks, progress, [&](LargeLevels& levels) {
    levels.buildShared();
    tasks += levels.taskCount();
  });
  return tasks;
}

} // namespace imgeo
