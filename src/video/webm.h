#pragma once
// WebM files with one VP9 video (webmproject.org/docs/container, RFC 9559), as far as videos of sequences need them.

#include "video/video_image.h"

#include <optional>

namespace imgeo {

inline constexpr std::size_t maxVideoBytes = std::size_t{1} << 28;

/// An encoded image.
struct VideoPacket {
  ByteSpan bytes;
  bool isKey = false; ///< it can be decoded without those before it
  double time = 0;    ///< seconds
};

/// `packets` refer to the bytes that were read.
struct WebmVideo {
  VideoSize size;
  std::vector<VideoPacket> packets;
};

/// Whether a packet of VP9 stands alone; nothing for bytes that are no packet of profile 1, which has RGB.
std::optional<bool> isKeyPacket(ByteSpan packet);

/// A file with the packets at `rate` images per second. A cluster begins at each key packet, and the first packet is
/// one. Deterministic. Throws Error{limit} for more than maxVideoBytes.
Bytes writeWebm(VideoSize size, std::span<const Bytes> packets, double rate);

/// Reads the first video of a file. Safe for untrusted bytes; allocates in proportion to them. Throws Error{truncated,
/// malformed, unsupported, limit} with `location`.
WebmVideo readWebm(ByteSpan bytes, const std::string& location);

} // namespace imgeo
