#pragma once
// data: URLs (RFC 2397), and the escapes of URLs.

#include "base/bytes.h"

#include <string>
#include <string_view>

namespace imgeo {

inline bool isDataUrl(std::string_view url) {
  return url.starts_with("data:");
}

/// "a%20b" -> "a b"; malformed escapes stay as they are.
std::string percentDecoded(std::string_view text);

/// Decodes base64 (RFC 4648), ignoring white space and padding. Throws Error{malformed} naming `location`.
Bytes base64Decoded(std::string_view text, const std::string& location);

/// A data: URL of this media type in base64 (RFC 2397).
std::string dataUrlOf(ByteSpan bytes, std::string_view mediaType);

/// The bytes of a data: URL, in base64 or with escapes. Throws Error{malformed} naming `location`.
Bytes bytesOfDataUrl(std::string_view url, const std::string& location);

} // namespace imgeo
