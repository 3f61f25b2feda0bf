#pragma once
// Media type and cacheability of a file, by its name.

#include <string_view>

namespace imgeo {

struct MediaType {
  std::string_view name;       ///< the value of Content-Type, with a charset for text
  bool isCompressible = false; ///< worth a content coding
};

/// By the extension, ignoring case; "application/octet-stream" for unknown ones.
MediaType mediaTypeOf(std::string_view fileName);

} // namespace imgeo
