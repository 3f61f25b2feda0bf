#pragma once
// Files beside those of a site that hold their content in a content coding, for static hosts that send such files
// (nginx: gzip_static, brotli_static) but compress nothing themselves.

#include "imgeo/convert.h"

#include <filesystem>

namespace imgeo {

/// Writes FILE.br and FILE.gz beside every file of a staged site that a content coding makes smaller: text and the
/// typed arrays of BG. Uses all threads. Throws Error{io}.
PrecompressReport precompressSite(const std::filesystem::path& site);

} // namespace imgeo
