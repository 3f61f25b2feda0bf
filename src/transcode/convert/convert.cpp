// convert(): the order of the steps from an input file to a published site.

#include "imgeo/convert.h"

#include "base/error.h"
#include "containers/option_checks.h"
#include "transcode/convert/conversion.h"
#include "transcode/convert/sequence_options.h"
#include "transcode/options/resolve_options.h"
#include "transcode/out_of_core/choose.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

/// Refuses an input inside the target directory: publishing the site would remove it.
void requireOutside(const fs::path& input, const fs::path& directory) {
  std::error_code ignored;
  const fs::path file = fs::weakly_canonical(input, ignored), target = fs::weakly_canonical(directory, ignored);
  if (std::mismatch(target.begin(), target.end(), file.begin(), file.end()).first == target.end())
    throw Error(ErrorKind::usage, input.string(), "lies inside the directory that is to be replaced");
}

ConvertReport run(const std::vector<fs::path>& inputs, const fs::path& directory, const ConvertOptions& options,
                  const Progress& progress) {
  resolved(options); // refuses contradictions before anything is written
  if (options.ranks.rank >= options.ranks.count)
    refuseOption("--rank", fmt::format("{} ranks have the numbers 0 to {}", options.ranks.count,
                                       std::max(options.ranks.count, 1u) - 1));
  if (options.ranks.count > 1 && inputs.size() > 1)
    refuseOption("--ranks", "the frames of a sequence are converted by one process");
  if (recordsAll(options))
    requireSequenceOptions(options);
  for (const fs::path& input : inputs)
    if (input != "-")
      requireOutside(input, directory);

  std::unique_ptr<ChunkedSource> source;
  if (inputs.size() == 1)
    source = chooseOutOfCore(inputs.front(), directory, options);
  if (source)
    requireOutside(workFolderOf(directory, options), directory);
  if (options.ranks.rank > 0)
    return convertShare(inputs.front(), directory, options, progress, source.get());
  Conversion conversion(inputs, directory, options, progress, std::move(source));
  try {
    conversion.readSource();
    conversion.resolveOptions();
    conversion.prepareMeshes();
    conversion.shareEqualMeshes();
    conversion.sampleSurfaces();
    conversion.encodeMeshes();
    conversion.completeScene();
    conversion.writeDocuments();
    conversion.inspectSite();
    conversion.precompress();
    conversion.publish();
  } catch (const Error& error) {
    conversion.tellOthers(error.what());
    throw;
  } catch (...) {
    conversion.tellOthers(interruptedRank);
    throw;
  }
  return conversion.takeReport();
}

} // namespace

ConvertReport convert(const fs::path& input, const fs::path& directory, const ConvertOptions& options,
                      const Progress& progress) {
  return run({input}, directory, options, progress);
}

ConvertReport convertSequence(const std::vector<fs::path>& frames, const fs::path& directory,
                              const ConvertOptions& options, const Progress& progress) {
  if (frames.empty())
    throw Error(ErrorKind::usage, "", "a sequence has no frames");
  return run(frames, directory, frames.size() > 1 ? optionsForFiles(frames, options) : options, progress);
}

} // namespace imgeo
