#pragma once
// What kind of image a file is, by its first bytes.

#include "base/bytes.h"

#include <string>

namespace imgeo {

/// The ending of a file of images that browsers show (".png", ".jpg", ".webp",
/// ".avif", ".gif"); "" for any other.
std::string imageType(ByteSpan bytes);

} // namespace imgeo
