#pragma once
// Recognising image files by their first bytes.

#include "base/bytes.h"

#include <string>
#include <string_view>

namespace imgeo {

/// The file extension of the image's type, such as ".png"; empty for types that neither browsers show nor imgeo
/// decodes.
std::string imageType(ByteSpan bytes);

/// Whether pages use images of this type as they are. Browsers show .bmp too, but it takes many times the bytes.
bool isShownByBrowsers(std::string_view type);

/// Whether `decodeRaster` decodes this type.
bool isDecodable(std::string_view type);

} // namespace imgeo
