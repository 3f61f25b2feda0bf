#pragma once
// SGI images (.rgb, .rgba, .sgi, .bw): The SGI Image File Format, Paul Haeberli, 1991. GraphicsMagick refuses those of
// grey and alpha, and those whose rows of run lengths have no zero at their end.

#include "images/raster.h"

#include <string>

namespace imgeo {

/// Decodes a file that begins with the magic number 0x01DA: verbatim or run-length encoded, one or two bytes a channel,
/// of which the higher is kept, with the channels grey, grey and alpha, RGB or RGBA. Safe for untrusted bytes. Throws
/// Error{limit, malformed, truncated, unsupported} with `location`.
Raster decodeSgi(ByteSpan bytes, const std::string& location, std::uint64_t maxPixels = maxRasterPixels);

} // namespace imgeo
