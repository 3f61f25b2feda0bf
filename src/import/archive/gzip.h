#pragma once
// Unpacking of gzipped files (RFC 1952).

#include "base/bytes.h"

#include <string>

namespace imgeo {

/// Unpacked sizes up to this are never refused for their ratio.
inline constexpr std::size_t kAnyRatioBytes = std::size_t{64} << 20;
/// Above it, a file may grow by this factor at most: meshes pack 3 to 20 times,
/// deflate could reach 1032.
inline constexpr std::size_t kMaxUnpackRatio = 100;

/// What a file of so many packed bytes may unpack to.
std::size_t unpackedLimit(std::size_t packed);

bool isGzip(ByteSpan bytes);

/// Unpacks every member of a gzip file, one after the other; zero bytes behind
/// the last are padding. Safe for untrusted bytes: allocates at most the limits
/// above. Throws Error (malformed, limit) naming `name` and the byte.
Bytes gunzip(ByteSpan bytes, const std::string& name);

} // namespace imgeo
