#pragma once
// Whether a source is converted out of core.

#include "imgeo/convert.h"
#include "import/chunks/chunked_source.h"

#include <memory>

namespace imgeo {

/// The memory that a process may take: as stated, or where that is 0 three quarters of the machine's, divided by so
/// many processes.
std::uint64_t memoryLimit(std::uint64_t stated, std::uint32_t processes = 1);

/// The bytes of a file, or those that a packed one may have when it is unpacked; 0 where there is none.
std::uint64_t maxUnpackedBytes(const std::filesystem::path& input);

/// The source, if it is to be converted out of core: converting it would take more memory than there is, or it has
/// largeMeshes(), and a work folder or several ranks are stated. For other ranks than 0 it has largeMeshes(). `options`
/// are not resolved. Throws Error{usage} where options contradict that, {unsupported} for sources that are not read
/// piece by piece. A gzipped source is unpacked on the disk of the work folder.
std::unique_ptr<ChunkedSource> chooseOutOfCore(const std::filesystem::path& input, const std::filesystem::path& site,
                                               const ConvertOptions& options);

/// The folder for work files: as stated, or one beside the site.
std::filesystem::path workFolderOf(const std::filesystem::path& site, const ConvertOptions& options);

/// What is converted and how, as far as work files depend on it.
std::string jobOf(const std::filesystem::path& input, const ConvertOptions& resolved);

} // namespace imgeo
