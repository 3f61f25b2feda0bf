#pragma once
// The frames of a sequence as a lossless video: docs/formats/video.md.

#include "sequence/sequence_index.h"
#include "video/webm.h"

#include <functional>

namespace imgeo {

/// The packets of frames that follow one another, of which the first stands alone. Deterministic. `effort`: 0 .. 9.
std::vector<Bytes> encodeVideoFrames(std::span<const live::Frame> frames, VideoSize size, int effort);

/// Reads frames `first` .. `end` - 1 of a video and calls visit(frame) with each, in their order. Checks them against
/// the index, which states their number, layout and rate. Safe for untrusted bytes. Throws Error{truncated, malformed,
/// unsupported, limit} with `location`: also for a video that is not lossless.
void decodeVideoFrames(ByteSpan bytes, const SequenceIndex& index, std::uint32_t first, std::uint32_t end,
                       const std::string& location, const std::function<void(const live::Frame&)>& visit);

} // namespace imgeo
