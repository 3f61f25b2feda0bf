#include "transcode/verify/choose_comparison.h"

#include "base/error.h"
#include "transcode/out_of_core/choose.h"

#include <fmt/format.h>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

/// Inputs whose comparison takes more than so many times their bytes of memory are none.
constexpr std::uint64_t maxCompareMemoryPerByte = 72;

/// Why a site is compared with its input in memory, or nullptr.
const char* reasonForMemory(const SiteDocument& document, const std::optional<SiteManifest>& manifest,
                            const fs::path& input) {
  if (!manifest)
    return "sites of other programs are compared in memory";
  const std::vector<GeometryDescription>& geometries = document.scene.geometries;
  if (geometries.size() != 1 || !geometries[0].levels || !geometries[0].operators.empty() ||
      manifest->primitives != Primitives::triangles)
    return "only sites of one mesh or cloud with levels of detail are compared out of core";
  if (manifest->dropped.degenerate || manifest->dropped.repeated)
    return "sites without what --drop left out are compared in memory";
  if (input == "-")
    return "standard input is read whole; comparison out of core needs a file";
  return nullptr;
}

} // namespace

std::unique_ptr<ChunkedSource> chooseComparison(const SiteDocument& document,
                                                const std::optional<SiteManifest>& manifest, const fs::path& site,
                                                const fs::path& input, const VerifyOptions& options) {
  const bool isAskedFor = !options.workFolder.empty();
  const char* stated = isAskedFor ? "--work" : options.memoryBytes > 0 ? "--memory" : nullptr;
  if (options.memoryBytes > 0 && options.memoryBytes < minVerifyMemory)
    throw Error(ErrorKind::usage, "--memory",
                fmt::format("comparison out of core takes at least {} MB", minVerifyMemory / 1'000'000));
  const std::uint64_t memory = memoryLimit(options.memoryBytes);
  if (!isAskedFor && maxUnpackedBytes(input) < memory / maxCompareMemoryPerByte)
    return nullptr;
  if (const char* reason = reasonForMemory(document, manifest, input)) {
    if (stated)
      throw Error(ErrorKind::usage, stated, reason);
    return nullptr;
  }
  try {
    std::unique_ptr<ChunkedSource> source =
        ChunkedSource::open(input, workFolderOf(site, options).parent_path(), pieceTriangles(memory));
    const Topology ofSite = document.scene.geometries[0].levels->topology;
    if (source->meshCount() != 1)
      throw Error(ErrorKind::unsupported, input.string(),
                  "has several meshes, and the site one: they are compared in memory");
    if (const Topology ofInput = source->mesh(0).topology(); ofInput != ofSite)
      throw Error(ErrorKind::unsupported, input.string(),
                  fmt::format("has {}, and the site {}: they are compared in memory", nameOf(ofInput), nameOf(ofSite)));
    if (!isAskedFor && verifyMemoryInCore(source->elementCount()) <= memory)
      return nullptr;
    return source;
  } catch (const Error& error) {
    if (stated || error.kind() != ErrorKind::unsupported)
      throw;
    return nullptr;
  }
}

} // namespace imgeo
