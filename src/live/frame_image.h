#pragma once
// The positions of a frame as an image, for viewers without a decoder of frames: docs/live.md, "Images".

#include "live/frame.h"

namespace imgeo::live {

/// A PNG of RGB pixels. Throws Error like decodeFrame().
Bytes imageOfFrame(ByteSpan frame, const std::string& location);

} // namespace imgeo::live
