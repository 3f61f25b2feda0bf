#include "transcode/verify/verify_work.h"

#include "base/file.h"
#include "base/parallel.h"

#include <algorithm>
#include <fmt/format.h>
#include <thread>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

// Above what was measured: docs/massive.md has the figures.
constexpr std::uint64_t inCoreElementBytes = 400;  ///< of a triangle, or point, that is compared in memory
constexpr std::uint64_t regionTriangleBytes = 900; ///< of a triangle of a region that is compared
constexpr std::uint64_t pieceTriangleBytes = 400;  ///< of a triangle that is scattered
constexpr std::uint64_t batchElementBytes = 400;   ///< of a triangle, or point, of meshes that are read and stored
constexpr std::uint64_t structureBytes = 8000;     ///< of a mesh, in the source and in the site
constexpr std::uint64_t fixedBytes = 96ull << 20;  ///< of everything else, and groups of levels that are read
constexpr std::uint32_t minRegionTriangles = 1u << 14, maxRegionTriangles = 1u << 19;
constexpr std::uint64_t minPieceTriangles = 1u << 14, maxPieceTriangles = 1u << 18;
constexpr std::uint64_t maxBatchElements = 1u << 20;

constexpr const char* job = "imgeo verify\n";

/// How much is done at a time.
struct Portions {
  std::size_t atOnce = 1;
  std::uint32_t regionTriangles = 0;
  std::uint64_t pieceTriangles = 0, batchElements = 0;
};

Portions portionsFor(std::uint64_t memory) {
  Portions portions;
  const std::size_t threads = std::max(std::thread::hardware_concurrency(), 1u);
  const std::uint64_t usable = memory - std::min(memory, fixedBytes);
  portions.atOnce = std::clamp<std::size_t>(usable / (regionTriangleBytes * minRegionTriangles), 1, threads);
  const std::uint64_t each = usable / portions.atOnce;
  portions.regionTriangles = static_cast<std::uint32_t>(
      std::clamp<std::uint64_t>(each / regionTriangleBytes, minRegionTriangles, maxRegionTriangles));
  portions.pieceTriangles = std::clamp(each / pieceTriangleBytes, minPieceTriangles, maxPieceTriangles);
  portions.batchElements = std::clamp(usable / batchElementBytes, minPieceTriangles, maxBatchElements);
  return portions;
}

} // namespace

std::uint64_t verifyMemoryInCore(std::uint64_t elements, std::uint64_t ofLargest) {
  return fixedBytes + readElementBytes * (elements - std::min(elements, ofLargest)) + inCoreElementBytes * ofLargest;
}

std::uint64_t verifyStructureMemory(std::uint64_t meshes) {
  return structureBytes * meshes;
}

std::uint64_t pieceTriangles(std::uint64_t memory) {
  return portionsFor(memory).pieceTriangles;
}

fs::path workFolderOf(const fs::path& site, const VerifyOptions& options) {
  if (!options.workFolder.empty())
    return options.workFolder;
  fs::path target = fs::weakly_canonical(site);
  if (!fs::is_directory(target)) // its page
    target = target.parent_path();
  return target.parent_path() / fmt::format(".{}.imgeo-verify", target.filename().string());
}

namespace {

bool isOfComparison(const fs::path& folder) {
  return asText(readFile(folder / workJobName)) == job;
}

} // namespace

VerifyWork::VerifyWork(const fs::path& folder, std::uint64_t memory) {
  const Portions portions = portionsFor(memory);
  atOnce_ = portions.atOnce;
  regionTriangles_ = portions.regionTriangles;
  pieceTriangles_ = portions.pieceTriangles;
  batchElements_ = portions.batchElements;
  const bool isNew = !fs::exists(folder);
  if (isWorkFolder(folder) && !isOfComparison(folder))
    throw Error(ErrorKind::usage, folder.string(), "is the work folder of a conversion; name another by --work");
  if (isNew)
    unfinished_.emplace(folder);
  folder_.emplace(folder, job, false);
  if (!isNew) // that of a comparison that was killed
    unfinished_.emplace(folder);
}

VerifyWork::~VerifyWork() {
  folder_->removeAll();
}

void VerifyWork::beginMesh(std::size_t number) {
  folder_->enter(fmt::format("{}", number));
}

void VerifyWork::beginWholeMeshes() {
  folder_->enter("whole");
}

void VerifyWork::endMesh() {
  folder_->removeSubfolder();
}

void VerifyWork::write(const std::string& name, ByteSpan bytes) const {
  try {
    folder_->write(name, bytes);
  } catch (const Error& error) {
    throw WorkFault{error};
  }
}

void VerifyWork::forEach(std::size_t count, const std::function<void(std::size_t)>& task) const {
  for (std::size_t begin = 0; begin < count; begin += atOnce_)
    parallelFor(std::min(atOnce_, count - begin), [&](std::size_t i) { task(begin + i); });
}

} // namespace imgeo
