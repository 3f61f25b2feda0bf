#pragma once
// Recognising image files by their first bytes.

#include "base/bytes.h"

#include <string>
#include <string_view>

namespace imgeo {

/// The file extension of the image's type, such as ".png"; empty for types that pages do not use and imgeo does not
/// decode.
std::string imageType(ByteSpan bytes);

/// Whether pages use images of this type unchanged. Browsers show .bmp too, but it takes many times the bytes.
bool isWebImageType(std::string_view type);

/// Whether `decodeRaster` decodes this type.
bool isDecodable(std::string_view type);

} // namespace imgeo
