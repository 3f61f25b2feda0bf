#include "transcode/verify/choose_comparison.h"

#include "base/error.h"
#include "scene/shape_instances.h"
#include "transcode/node_geometry/prepare_as.h"
#include "transcode/out_of_core/choose.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <utility>
#include <vector>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

/// Inputs whose comparison takes more than so many times their bytes of memory are none.
constexpr std::uint64_t maxCompareMemoryPerByte = 72;

bool hasLevels(const GeometryDescription& geometry) {
  return geometry.levels && geometry.operators.empty();
}

/// Why a site is compared with its input in memory, or nullptr.
const char* reasonForMemory(const std::optional<SiteManifest>& manifest, const fs::path& input) {
  if (!manifest)
    return "sites of other programs are compared in memory";
  if (manifest->primitives != Primitives::triangles)
    return "sites of lines or points that were made of triangles are compared in memory";
  if (manifest->dropped.degenerate || manifest->dropped.repeated)
    return "sites without what --drop left out are compared in memory";
  if (input == "-")
    return "standard input is read whole; comparison out of core needs a file";
  return nullptr;
}

/// The meshes of shapes, or geometries of a site, in the order of the document.
std::vector<std::size_t> meshesOf(const SceneGraph& graph, const std::string& location) {
  std::vector<std::size_t> meshes;
  for (const ShapeInstance& shape : shapeInstances(graph, location))
    meshes.push_back(shapeOf(graph, shape.node).mesh);
  return meshes;
}

/// The scene of a source without shapes that have no elements, as convert() leaves these out.
SceneGraph graphOf(const ChunkedSource& source, const ImportOptions& options) {
  SceneGraph graph = source.readScene({}, options).scene.graph;
  std::vector<bool> isEmpty;
  for (std::size_t mesh = 0; mesh < source.meshCount(); ++mesh)
    isEmpty.push_back(source.mesh(mesh).elementCount() == 0);
  removeShapes(graph, isEmpty);
  return graph;
}

/// Finds which meshes are large and which are read as a whole.
void divideMeshes(const SiteDocument& document, const ImportOptions& options, ChosenComparison& chosen) {
  const ChunkedSource& source = *chosen.source;
  const std::vector<std::size_t> geometries = meshesOf(document.scene.graph, document.root / document.name),
                                 meshes = meshesOf(graphOf(source, options), source.name());
  if (geometries.size() != meshes.size())
    return;
  std::map<std::size_t, std::set<std::size_t>> geometriesOfMesh, meshesOfGeometry;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    geometriesOfMesh[meshes[i]].insert(geometries[i]);
    meshesOfGeometry[geometries[i]].insert(meshes[i]);
  }
  for (const auto& [mesh, its] : geometriesOfMesh) {
    const GeometryDescription& geometry = document.scene.geometries.at(*its.begin());
    const bool isLarge = its.size() == 1 && meshesOfGeometry.at(*its.begin()).size() == 1 && hasLevels(geometry) &&
                         geometry.levels->topology == source.mesh(mesh).topology();
    (isLarge ? chosen.large : chosen.whole).insert(mesh);
  }
}

struct MeshSizes {
  std::uint64_t sum = 0, largest = 0; ///< triangles or points
};

MeshSizes sizeOf(const ChunkedSource& source, const std::set<std::size_t>& meshes) {
  MeshSizes sizes;
  for (const std::size_t mesh : meshes) {
    sizes.sum += source.mesh(mesh).elementCount();
    sizes.largest = std::max(sizes.largest, source.mesh(mesh).elementCount());
  }
  return sizes;
}

} // namespace

std::optional<ChosenComparison> chooseComparison(const SiteDocument& document,
                                                 const std::optional<SiteManifest>& manifest, const fs::path& site,
                                                 const fs::path& input, const VerifyOptions& options) {
  const bool isAskedFor = !options.workFolder.empty();
  const char* stated = isAskedFor ? "--work" : options.memoryBytes > 0 ? "--memory" : nullptr;
  if (options.memoryBytes > 0 && options.memoryBytes < minVerifyMemory)
    throw Error(ErrorKind::usage, "--memory",
                fmt::format("comparison out of core takes at least {} MB", minVerifyMemory / 1'000'000));
  const std::uint64_t memory = memoryLimit(options.memoryBytes);
  if (!isAskedFor && maxUnpackedBytes(input) < memory / maxCompareMemoryPerByte)
    return std::nullopt;
  if (const char* reason = reasonForMemory(manifest, input)) {
    if (stated)
      throw Error(ErrorKind::usage, stated, reason);
    return std::nullopt;
  }
  ChosenComparison chosen;
  try {
    chosen.source = ChunkedSource::open(input, workFolderOf(site, options).parent_path(), pieceTriangles(memory));
  } catch (const Error& error) {
    if (stated || error.kind() != ErrorKind::unsupported)
      throw;
    return std::nullopt;
  }
  std::set<std::size_t> all;
  for (std::size_t mesh = 0; mesh < chosen.source->meshCount(); ++mesh)
    all.insert(all.end(), mesh);
  const auto [sum, largest] = sizeOf(*chosen.source, all);
  chosen.structureBytes = verifyStructureMemory(all.size());
  if (!isAskedFor && verifyMemoryInCore(sum, largest) + chosen.structureBytes <= memory)
    return std::nullopt;
  divideMeshes(document, importOptionsFor(manifest, options.outside), chosen);
  const MeshSizes whole = sizeOf(*chosen.source, chosen.whole);
  if (const std::uint64_t needed = verifyMemoryInCore(whole.largest, whole.largest);
      stated && options.memoryBytes > 0 && needed > memory)
    throw Error(ErrorKind::usage, stated,
                fmt::format("a mesh of {} triangles or points has no levels of detail in the site, or is shown as an "
                            "instance of another or has become another kind of elements; it is compared in memory, "
                            "which takes about {} MB",
                            whole.largest, needed / 1'000'000));
  const std::uint64_t minimum = std::max(verifyMemoryInCore(whole.largest, whole.largest), minVerifyMemory / 2);
  if (stated && options.memoryBytes > 0 && minimum + chosen.structureBytes > memory)
    throw Error(
        ErrorKind::usage, stated,
        fmt::format("what is known of {} meshes of the input and of the site takes about {} MB, beside at least "
                    "{} MB of one",
                    all.size(), chosen.structureBytes / 1'000'000, minimum / 1'000'000));
  chosen.storesWhole = isAskedFor || verifyMemoryInCore(whole.sum, whole.largest) + chosen.structureBytes > memory;
  if (chosen.large.empty() && !chosen.whole.empty() && !chosen.storesWhole)
    return std::nullopt;
  chosen.wholeBytes = chosen.storesWhole ? 0 : whole.sum * readElementBytes;
  return chosen;
}

} // namespace imgeo
