#include "transcode/convert/large_conversion.h"

#include "base/error.h"
#include "transcode/convert/peak_memory.h"
#include "transcode/convert/source_attributes.h"
#include "transcode/convert/stopwatch.h"
#include "transcode/options/resolve_options.h"
#include "transcode/out_of_core/choose.h"

namespace imgeo {

namespace fs = std::filesystem;

Progress progressOutOfCore(const Progress& progress) {
  return [&progress](double share, const std::string& step) {
    if (progress)
      progress(levelShare * share, step);
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
    try {
      report.tasks =
          shareOutOfCore(*source, importOptionsFor(options, {}), options, *ranks, progressOutOfCore(progress));
      report.tasksTaken = ranks->tasksTaken();
      ranks->leave([&] {
        if (progress)
          progress(levelShare, "waiting for rank 0");
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
