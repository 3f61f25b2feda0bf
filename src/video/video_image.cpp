#include "video/video_image.h"

#include "base/error.h"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <libdeflate.h>

namespace imgeo {

namespace {

/// Columns of vertices that are no grid, and the fewest of any image: the last row holds eight bytes.
constexpr std::uint32_t widthWithoutGrid = 1024, minWidth = 8;
constexpr std::size_t channels = 3;

/// Bytes of a vertex, each of which is a channel of an image.
std::uint32_t bytePlanesOf(const live::FrameLayout& layout) {
  return static_cast<std::uint32_t>(live::unpackedBytesOf(layout) / layout.vertices);
}

/// Calls visit(component, shift, plane) for each byte plane, in the order in which frames pack them.
template <typename Visit> void visitPlanes(const live::FrameLayout& layout, const Visit& visit) {
  std::uint32_t plane = 0;
  for (const live::ComponentBits& attribute : live::attributesOf(layout))
    for (std::uint32_t left = (attribute.bits + 7) / 8; left-- > 0;)
      for (std::uint32_t i = 0; i < attribute.count; ++i)
        visit(attribute.first + i, 8 * left, plane++);
}

/// The first channel of a plane: those of the vertices follow one another by `channels`.
std::size_t firstOf(std::uint32_t plane, std::size_t imagePixels) {
  return plane / channels * imagePixels * channels + plane % channels;
}

std::size_t pixelsOf(VideoSize size, const live::FrameLayout& layout) {
  return std::size_t{size.width} * ((layout.vertices + size.width - 1) / size.width);
}

std::size_t lastRowOf(VideoSize size) {
  return channels * size.width * (size.height - 1);
}

} // namespace

VideoSize videoSizeOf(const live::FrameLayout& layout, const std::string& location) {
  const std::uint32_t columns = layout.columns > 0 ? layout.columns : std::min(layout.vertices, widthWithoutGrid);
  const std::uint32_t width = std::max(columns, minWidth);
  const std::uint64_t rows = (layout.vertices + width - 1) / width;
  const std::uint64_t height = rows * ((bytePlanesOf(layout) + channels - 1) / channels) + 1;
  if (width > maxVideoEdge || height > maxVideoEdge)
    throw Error(ErrorKind::limit, location,
                fmt::format("the frames need images of {} x {} pixels; a video has at most {} x {}", width, height,
                            maxVideoEdge, maxVideoEdge));
  return {width, static_cast<std::uint32_t>(height)};
}

Bytes videoImageOf(const live::Frame& frame, VideoSize size) {
  const std::size_t imagePixels = pixelsOf(size, frame.layout), last = lastRowOf(size);
  Bytes pixels(channels * size.width * size.height);
  visitPlanes(frame.layout, [&](std::uint32_t component, std::uint32_t shift, std::uint32_t plane) {
    std::uint8_t* out = pixels.data() + firstOf(plane, imagePixels);
    for (const std::uint32_t value : frame.component(component)) {
      *out = static_cast<std::uint8_t>(value >> shift);
      out += channels;
    }
  });
  Bytes row;
  appendBig(row, static_cast<std::uint32_t>(frame.number));
  std::ranges::copy(row, pixels.begin() + static_cast<std::ptrdiff_t>(last));
  appendBig(row, libdeflate_crc32(0, pixels.data(), last + row.size()));
  std::ranges::copy(row, pixels.begin() + static_cast<std::ptrdiff_t>(last));
  return pixels;
}

live::Frame frameOfVideoImage(ByteSpan pixels, VideoSize size, const live::FrameLayout& layout, std::uint32_t number,
                              const std::string& location) {
  assert(pixels.size() == channels * size.width * size.height);
  const std::size_t imagePixels = pixelsOf(size, layout), last = lastRowOf(size);
  const std::uint32_t found = loadBig<std::uint32_t>(pixels.data() + last);
  if (loadBig<std::uint32_t>(pixels.data() + last + 4) != libdeflate_crc32(0, pixels.data(), last + 4))
    throw Error(
        ErrorKind::malformed, location,
        fmt::format("the pixels of frame {} are not those that were recorded: the video is not lossless", number));
  if (found != number)
    throw Error(ErrorKind::malformed, location, fmt::format("has frame {} instead of frame {}", found, number));
  live::Frame frame;
  frame.layout = layout;
  frame.number = number;
  frame.components.resize(std::size_t{live::componentCount(layout)} * layout.vertices);
  visitPlanes(layout, [&](std::uint32_t component, std::uint32_t shift, std::uint32_t plane) {
    const std::uint8_t* in = pixels.data() + firstOf(plane, imagePixels);
    std::uint32_t* out = frame.components.data() + std::size_t{component} * layout.vertices;
    for (std::uint32_t i = 0; i < layout.vertices; ++i)
      out[i] |= std::uint32_t{in[channels * i]} << shift;
  });
  return frame;
}

} // namespace imgeo
