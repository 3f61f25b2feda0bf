#pragma once
// Files of frames that follow one another: the first stands alone, later ones may be differences to the frame before.

#include "live/frame.h"
#include "sequence/sequence_index.h"

#include <functional>

namespace imgeo {

/// The bytes of a file with these frames, of which there is at least one and which have one layout. Each frame is the
/// smaller of itself and of its difference to the one before. `compressionLevel`: of deflate, 1 .. 12. Deterministic.
Bytes encodeSequenceFile(std::span<const live::Frame> frames, int compressionLevel);

/// Reads the frames of file number `file` of the index and calls visit(frame) with each, in their order, up to and
/// without `end` if that is smaller than the number of all. Checks them against the index. Safe for untrusted bytes; at
/// most two frames are in memory. Throws Error{truncated, malformed, unsupported, limit} with `location` and the number
/// of the frame.
void decodeSequenceFile(ByteSpan bytes, const SequenceIndex& index, std::size_t file, const std::string& location,
                        const std::function<void(const live::Frame&)>& visit, std::uint32_t end = UINT32_MAX);

} // namespace imgeo
