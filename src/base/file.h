#pragma once
// Reading and writing whole files, and the content hash in file names.

#include "base/bytes.h"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace imgeo {

/// Reads a whole file ("-" reads standard input to its end).
/// Throws Error{io} naming the path and the system's reason.
Bytes readFile(const std::filesystem::path& path);

/// Writes a file, replacing an existing one. Throws Error{io}; removes a regular file that could not be written
/// completely.
void writeFile(const std::filesystem::path& path, ByteSpan bytes);

/// Appends bytes to a file.
using AppendBytes = std::function<void(ByteSpan bytes)>;

/// The same for a file that is too large for memory: `write` is called once and appends its content piece by piece. The
/// file is removed, too, where `write` throws.
void writeFileInPieces(const std::filesystem::path& path, const std::function<void(const AppendBytes& append)>& write);

/// The first 16 hexadecimal digits of the content's 128-bit xxHash (XXH3). Files named by it never change, so that
/// caches may keep them indefinitely.
std::string contentName(ByteSpan bytes);

/// Whether the stem of a file name ends in exactly 16 lower-case hexadecimal digits, the result of contentName().
bool isContentNamed(std::string_view fileName);

} // namespace imgeo
