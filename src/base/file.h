#pragma once
// Whole files in and out.

#include "base/bytes.h"

#include <filesystem>
#include <string>

namespace imgeo {

/// Reads a whole file ("-" reads standard input to its end).
/// Throws Error{io} naming the path and the system's reason.
Bytes readFile(const std::filesystem::path& path);

/// Writes a whole new file, or replaces one. Throws Error{io}; a regular
/// file that could not be written whole is removed.
void writeFile(const std::filesystem::path& path, ByteSpan bytes);

/// The first 16 hexadecimal digits of the content's 128-bit xxHash (XXH3): names
/// files by what they hold, so that they may be cached for ever.
std::string contentName(ByteSpan bytes);

} // namespace imgeo
