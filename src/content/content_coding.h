#pragma once
// Content codings: choice by the Accept-Encoding header, and compression.
// RFC 9110, section 12.5.3 (Accept-Encoding); RFC 7932 (brotli).

#include "base/bytes.h"

#include <string_view>

namespace imgeo {

enum class ContentCoding { identity, gzip, brotli };

enum class CodingEffort {
  fast,    ///< for the first request of a file: brotli 5, gzip 6
  smallest ///< for files that are coded once and sent often: brotli 11, gzip 12; a hundred times as slow with brotli
};

/// The name in Content-Encoding: "br", "gzip"; "identity" is not sent.
std::string_view codingName(ContentCoding coding);

/// The coding that an Accept-Encoding header prefers: the one with the highest q; brotli before gzip before identity
/// where q is equal. Malformed items of the header are ignored; identity is the coding if no other is allowed. Safe for
/// untrusted bytes.
ContentCoding chooseCoding(std::string_view acceptEncoding);

/// The extension of the file beside `name` that holds its content in this coding, as nginx (gzip_static,
/// brotli_static), Caddy and Apache expect it: ".br", ".gz"; empty for identity.
std::string_view codingExtension(ContentCoding coding);

/// Encodes `bytes`; identity copies them. The same bytes give the same result.
Bytes encodeContent(ContentCoding coding, ByteSpan bytes, CodingEffort effort = CodingEffort::fast);

} // namespace imgeo
