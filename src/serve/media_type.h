#pragma once
// What a file's name says about its content and its life in caches.

#include <string_view>

namespace imgeo {

struct MediaType {
  std::string_view name;       ///< as Content-Type states it, with a charset for text
  bool isCompressible = false; ///< worth compressing on the way
};

/// By the extension, without regard to case; "application/octet-stream" for others.
MediaType mediaTypeOf(std::string_view fileName);

/// Whether the stem ends in exactly 16 lower-case hex digits, as contentName of
/// base/file.h makes them: such a file never changes.
bool isContentNamed(std::string_view fileName);

} // namespace imgeo
