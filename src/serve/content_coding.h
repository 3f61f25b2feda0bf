#pragma once
// Content codings: which one a client takes, and the compressors.
// RFC 9110, section 12.5.3 (Accept-Encoding); RFC 7932 (brotli).

#include "base/bytes.h"

#include <string_view>

namespace imgeo {

enum class ContentCoding { identity, gzip, brotli };

/// As Content-Encoding names it: "br", "gzip"; "identity" is never sent.
std::string_view codingName(ContentCoding coding);

/// The best coding that an Accept-Encoding header allows: the one with the highest
/// q, brotli before gzip before identity where they are equal. Nonsense allows
/// nothing but identity. Safe for untrusted bytes.
ContentCoding chooseCoding(std::string_view acceptEncoding);

/// `bytes` in that coding; identity copies. Deterministic.
Bytes encodeContent(ContentCoding coding, ByteSpan bytes);

} // namespace imgeo
