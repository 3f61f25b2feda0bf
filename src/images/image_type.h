#pragma once
// What kind of image a file is.

#include "base/bytes.h"

#include <string>
#include <string_view>

namespace imgeo {

/// The ending that says what an image is, ".png" …, told by its first bytes; empty for
/// kinds that neither browsers show nor we can read.
std::string imageType(ByteSpan bytes);

/// Whether browsers show images of this type as a matter of course. They do show .bmp, at
/// many times the bytes of any other.
bool isForPages(std::string_view type);

/// Whether `decodeRaster` reads it.
bool isDecodable(std::string_view type);

} // namespace imgeo
