#pragma once
// Media type of a file by its name, and whether a content coding makes it smaller.

#include <cstddef>
#include <string_view>

namespace imgeo {

struct MediaType {
  std::string_view name;       ///< the value of Content-Type, with a charset for text
  bool isCompressible = false; ///< worth a content coding: text and typed arrays, not images
};

/// By the extension, ignoring case; "application/octet-stream" for unknown ones.
MediaType mediaTypeOf(std::string_view fileName);

/// Shorter files are sent as they are: a content coding would hardly shrink them.
inline constexpr std::size_t minEncodedBytes = 256;

} // namespace imgeo
