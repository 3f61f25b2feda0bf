#pragma once
// Decompression of gzipped files (RFC 1952).

#include "base/bytes.h"

#include <functional>
#include <span>
#include <string>

namespace imgeo {

/// Files that unpack to at most this size may have any compression ratio.
inline constexpr std::size_t unlimitedRatioBytes = std::size_t{64} << 20;
/// The maximum compression ratio of larger files. Meshes reach 3 to 20, deflate at most 1032.
inline constexpr std::size_t maxUnpackRatio = 100;

/// The maximum unpacked size of a file of `packed` bytes.
std::size_t unpackedLimit(std::size_t packed);

bool isGzip(ByteSpan bytes);

/// Unpacks all members of a gzip file; zero bytes after the last are padding. Safe for untrusted bytes: allocates at
/// most `unpackedLimit`. Throws Error (malformed, limit) naming `name` and the byte.
Bytes gunzip(ByteSpan bytes, const std::string& name);

/// The same into memory that `resize` gives: it is called with growing sizes, keeps what has been written, and is
/// called last with the size of the unpacked file.
void gunzipInto(const std::function<std::span<std::uint8_t>(std::size_t)>& resize, ByteSpan bytes,
                const std::string& name);

} // namespace imgeo
