#include "live/frame_image.h"

#include "containers/png/png.h"

namespace imgeo::live {

namespace {

constexpr std::uint32_t widthWithoutGrid = 256;

} // namespace

Bytes imageOfFrame(ByteSpan bytes, const std::string& location) {
  const Frame frame = decodeFrame(bytes, location);
  const FrameLayout& layout = frame.layout;
  const std::uint32_t width = layout.columns > 0 ? layout.columns : widthWithoutGrid;
  const std::uint32_t rows = (layout.vertices + width - 1) / width, planes = (layout.positionBits + 7) / 8;
  Image image{width, planes * rows + 1, 3, {}};
  image.pixels.resize(std::size_t{3} * width * image.height);
  for (std::uint32_t plane = 0; plane < planes; ++plane)
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const auto component = frame.component(axis);
      std::uint8_t* out = image.pixels.data() + std::size_t{3} * width * rows * plane + axis;
      for (std::uint32_t i = 0; i < layout.vertices; ++i)
        out[std::size_t{3} * i] = static_cast<std::uint8_t>(component[i] >> (8 * (planes - 1 - plane)));
    }
  // The last row begins with the number of the frame, the most significant byte first, as far as there are pixels.
  std::uint8_t* last = image.pixels.data() + std::size_t{3} * width * (image.height - 1);
  for (std::uint32_t i = 0; i < 9 && i < 3 * width; ++i)
    last[i] = i == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(frame.number >> (8 * (8 - i)));
  return encodePng(image, 0);
}

} // namespace imgeo::live
