#include "transcode/convert/large_conversion.h"

#include "base/error.h"
#include "transcode/convert/peak_memory.h"
#include "transcode/convert/source_attributes.h"
#include "transcode/convert/stopwatch.h"
#include "transcode/options/resolve_options.h"
#include "transcode/out_of_core/choose.h"
#include "transcode/out_of_core/large_meshes.h"

namespace imgeo {

namespace fs = std::filesystem;

namespace {

/// The share where all meshes are converted out of core.
constexpr double largestShare = 0.97;

} // namespace

double shareOfLevels(const ChunkedSource& source, const ConvertOptions& options) {
  const std::uint64_t large = elementsOf(source, largeMeshes(source, options));
  return largestShare * static_cast<double>(large) / static_cast<double>(source.elementCount());
}

Progress progressOutOfCore(const Progress& progress, double whole) {
  return [&progress, whole](double share, const std::string& step) {
    if (progress)
      progress(whole * share, step);
  };
}

ConvertOptions outOfCoreOptions(const ConvertOptions& given) {
  ConvertOptions options = resolved(given);
  options.memoryBytes = memoryLimit(options.memoryBytes, options.ranks.onMachine);
  return options;
}

std::unique_ptr<Ranks> openRanks(const fs::path& input, const fs::path& workFolder, const ConvertOptions& options,
                                 const Progress& progress) {
  return std::make_unique<Ranks>(options.ranks, workFolder, jobOf(input, options), options.resume, [&] {
    if (progress)
      progress(0, "waiting for the other ranks");
  });
}

ConvertReport convertShare(const fs::path& input, const fs::path& directory, const ConvertOptions& given,
                           const Progress& progress, const ChunkedSource* source) {
  ConvertReport report;
  Stopwatch total;
  if (source) {
    const ConvertOptions options = outOfCoreOptions(given);
    const std::unique_ptr<Ranks> ranks = openRanks(input, workFolderOf(directory, options), options, progress);
    const double share = shareOfLevels(*source, options);
    try {
      report.tasks =
          shareOutOfCore(*source, importOptionsFor(options, {}), options, *ranks, progressOutOfCore(progress, share));
      report.tasksTaken = ranks->tasksTaken();
      ranks->leave([&] {
        if (progress)
          progress(share, "waiting for rank 0");
      });
    } catch (const Error& error) {
      ranks->fail(error.what());
      throw;
    } catch (...) {
      ranks->fail(interruptedRank);
      throw;
    }
  }
  report.totalSeconds = total.lapSeconds();
  report.peakMemoryBytes = peakMemoryBytes();
  return report;
}

} // namespace imgeo
