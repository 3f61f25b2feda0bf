#include "transcode/out_of_core/choose.h"

#include "base/error.h"
#include "containers/encodings.h"
#include "containers/option_checks.h"
#include "imgeo/version.h"
#include "import/source_name.h"
#include "transcode/options/resolve_options.h"
#include "transcode/out_of_core/large_meshes.h"
#include "transcode/out_of_core/memory_needs.h"
#include "transcode/out_of_core/small_meshes.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

/// Sources whose conversion takes more than so many times their bytes of memory are none.
constexpr std::uint64_t maxMemoryPerByte = 24, maxMemoryPerObjByte = 4;
/// Sources are seldom packed to less than this part.
constexpr std::uint64_t maxPackRatio = 16;

std::uint64_t memoryPerByte(const fs::path& input) {
  return extensionOf(input.string()) == ".obj" ? maxMemoryPerObjByte : maxMemoryPerByte;
}

std::uint64_t machineMemory() {
  const long pages = sysconf(_SC_PHYS_PAGES), pageBytes = sysconf(_SC_PAGE_SIZE);
  return pages > 0 && pageBytes > 0 ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(pageBytes) : 0;
}

/// The option that asks for conversion out of core, or nullptr.
const char* statedOption(const ConvertOptions& options) {
  return options.ranks.count > 1       ? "--ranks"
         : options.resume              ? "--resume"
         : !options.workFolder.empty() ? "--work"
         : options.memoryBytes > 0     ? "--memory"
                                       : nullptr;
}

/// Why the options allow no conversion out of core, or nullptr.
const char* contradiction(const fs::path& input, const ConvertOptions& options, const ConvertOptions& given) {
  if (options.levels == LevelChoice::never)
    return "only meshes and point clouds with levels of detail are converted out of core: --levels always";
  if (!rowOf(*options.encoding).capabilities.levels || given.target == Target::x3dom)
    return "only compact has levels of detail, by which sources are converted out of core";
  if (options.form != MeshForm::mesh || options.primitives != Primitives::triangles)
    return "only meshes of triangles, and point clouds, are converted out of core";
  if (options.dropped.degenerate || options.dropped.repeated)
    return "conversion out of core drops no elements: no --drop";
  if (input == "-")
    return "standard input is read whole; conversion out of core needs a file";
  return nullptr;
}

} // namespace

std::uint64_t memoryLimit(std::uint64_t stated, std::uint32_t processes) {
  return stated > 0 ? stated : machineMemory() / 4 * 3 / processes;
}

std::uint64_t maxUnpackedBytes(const fs::path& input) {
  std::error_code reason;
  const std::uint64_t bytes = fs::file_size(input, reason);
  return reason ? 0 : input.extension() == ".gz" ? bytes * maxPackRatio : bytes;
}

std::unique_ptr<ChunkedSource> chooseOutOfCore(const fs::path& input, const fs::path& site,
                                               const ConvertOptions& given) {
  const ConvertOptions options = resolved(given);
  const char* stated = statedOption(options);
  if (const char* reason = contradiction(input, options, given)) {
    if (stated)
      refuseOption(stated, reason);
    return nullptr;
  }
  const std::uint64_t memory = memoryLimit(options.memoryBytes, options.ranks.onMachine),
                      minimum = minimumMemory(options.regionTriangles);
  if (options.memoryBytes > 0 && options.memoryBytes < minimum)
    refuseOption("--memory", fmt::format("regions of {} triangles or points take at least {} MB; "
                                         "a smaller --region-triangles takes less",
                                         options.regionTriangles, (minimum + 999'999) / 1'000'000));
  const bool isAskedFor = options.ranks.count > 1 || options.resume || !options.workFolder.empty();
  const std::uint64_t bytes = maxUnpackedBytes(input);
  if (bytes == 0 || (!isAskedFor && bytes < memory / memoryPerByte(input)))
    return nullptr;
  std::unique_ptr<ChunkedSource> source;
  try {
    source =
        ChunkedSource::open(input, workFolderOf(site, options).parent_path(), pieceRecords(options.regionTriangles));
  } catch (const Error& error) {
    if (stated || error.kind() != ErrorKind::unsupported)
      throw;
    return nullptr;
  }
  const std::vector<std::size_t> large = largeMeshes(*source, options);
  const bool fits = inCoreMemory(source->elementCount()) + structureMemory(source->meshCount()) <= memory;
  if (large.empty() ? fits || options.ranks.rank > 0 : fits && !isAskedFor)
    return nullptr; // rank 0 converts small meshes alone
  if (options.memoryBytes > 0)
    requireMemoryForMeshes(*source, options);
  return source;
}

fs::path workFolderOf(const fs::path& site, const ConvertOptions& options) {
  if (!options.workFolder.empty())
    return options.workFolder;
  fs::path target = fs::absolute(site).lexically_normal();
  if (!target.has_filename())
    target = target.parent_path();
  return target.parent_path() / fmt::format(".{}.imgeo-work", target.filename().string());
}

std::string jobOf(const fs::path& input, const ConvertOptions& options) {
  const auto changed = fs::last_write_time(input).time_since_epoch().count();
  std::string job = fmt::format("imgeo {}\nsource {} bytes {} changed {}\n", version(), fs::canonical(input).string(),
                                fs::file_size(input), changed);
  job += fmt::format("group-triangles {} region-triangles {} position-bits {} normals {} normal-bits {} color-bits {} "
                     "attribute-bits {} effort {} weighting {} "
                     "tex-coord-bits {}\n",
                     options.groupTriangles, options.regionTriangles, options.positionBits,
                     static_cast<int>(options.normals), options.normalBits, options.colorBits, options.attributeBits,
                     options.effort, static_cast<int>(options.normalWeighting), options.texCoordBits);
  if (options.creaseDegrees)
    job += fmt::format("crease-angle {}\n", *options.creaseDegrees);
  job += fmt::format("textures {} {} {}\n", static_cast<int>(options.textures.format), options.textures.size,
                     options.textures.quality.value_or(-1));
  if (options.maxError)
    job += fmt::format("max-error {}{}\n", options.maxError->value, options.maxError->isPercent ? "%" : "");
  job += fmt::format("attributes {} {}\n", options.keepAttributes.all, fmt::join(options.keepAttributes.names, ","));
  return job;
}

} // namespace imgeo
