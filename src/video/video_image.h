#pragma once
// A frame of a sequence as the RGB image of a lossless video. docs/formats/video.md specifies every pixel.

#include "live/frame.h"

namespace imgeo {

/// Rows of a video: the largest edge that common decoders have.
inline constexpr std::uint32_t maxVideoEdge = 16384;

/// The size of the images of a video, in pixels.
struct VideoSize {
  std::uint32_t width = 0, height = 0;
  friend bool operator==(const VideoSize&, const VideoSize&) = default;
};

/// Throws Error{limit} with `location` for frames that need more than maxVideoEdge rows or columns.
VideoSize videoSizeOf(const live::FrameLayout& layout, const std::string& location);

/// RGB, row by row: the byte planes of the frame, three in the channels of an image, image under image; then a row with
/// the frame's number and a checksum.
Bytes videoImageOf(const live::Frame& frame, VideoSize size);

/// Reads a frame from the pixels of a decoded video. Safe for untrusted pixels, which are those of `size`. Throws
/// Error{malformed} with `location` for pixels that are not those of frame `number` as videoImageOf() made them: the
/// video is not lossless, or was not decoded exactly.
live::Frame frameOfVideoImage(ByteSpan pixels, VideoSize size, const live::FrameLayout& layout, std::uint32_t number,
                              const std::string& location);

} // namespace imgeo
