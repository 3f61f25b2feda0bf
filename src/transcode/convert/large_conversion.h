#pragma once
// The part of a conversion that is done out of core, and by several ranks.

#include "imgeo/convert.h"
#include "transcode/out_of_core/out_of_core.h"

#include <filesystem>
#include <memory>

namespace imgeo {

/// The share of building levels out of core in the work of a conversion, of which the rest is done in memory.
double shareOfLevels(const ChunkedSource& source, const ConvertOptions& options);

/// What the other ranks are told of one that ends by what is no Error.
inline constexpr const char* interruptedRank = "it was interrupted";

/// Progress of that work as the stated share of the conversion's. `progress` must outlive it.
Progress progressOutOfCore(const Progress& progress, double share);

/// The options of building levels out of core.
ConvertOptions outOfCoreOptions(const ConvertOptions& given);

/// Opens the work folder, with the other ranks.
std::unique_ptr<Ranks> openRanks(const std::filesystem::path& input, const std::filesystem::path& workFolder,
                                 const ConvertOptions& options, const Progress& progress);

/// The conversion by another rank than 0, whose source may be none that is converted out of core.
ConvertReport convertShare(const std::filesystem::path& input, const std::filesystem::path& directory,
                           const ConvertOptions& given, const Progress& progress, const ChunkedSource* source);

} // namespace imgeo
