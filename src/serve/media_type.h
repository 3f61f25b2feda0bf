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

/// Whether the stem ends in exactly 16 lower-case hex digits, the result of contentName (base/file.h): a file with such
/// a name does not change.
bool isContentNamed(std::string_view fileName);

} // namespace imgeo
