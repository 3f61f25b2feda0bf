#include "live/frame.h"
#include "live/prediction.h"

#include "base/error.h"

#include <libdeflate.h>
#include <memory>
#include <new>

namespace imgeo::live {

namespace {

/// The planes of a frame.
std::unique_ptr<std::uint8_t[]> unpack(ByteSpan packed, std::size_t unpackedBytes, const std::string& location) {
  using Decompressor = std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>;
  thread_local const Decompressor decompressor(libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (!decompressor)
    throw std::bad_alloc();
  auto planes = std::make_unique_for_overwrite<std::uint8_t[]>(unpackedBytes);
  std::size_t read = 0;
  // Without a pointer to the actual number of bytes written, fewer than `unpackedBytes` are an error.
  const libdeflate_result result = libdeflate_gzip_decompress_ex(decompressor.get(), packed.data(), packed.size(),
                                                                 planes.get(), unpackedBytes, &read, nullptr);
  if (result != LIBDEFLATE_SUCCESS || read != packed.size())
    throw Error(ErrorKind::malformed, location, "the frame's compressed bytes are damaged");
  return planes;
}

void addPlane(const std::uint8_t* plane, std::span<std::uint32_t> residuals) {
  for (std::size_t i = 0; i < residuals.size(); ++i)
    residuals[i] = residuals[i] << 8 | plane[i];
}

void addBefore(const Frame& before, Frame& frame) {
  const std::size_t vertices = frame.layout.vertices;
  for (const ComponentBits& attribute : attributesOf(frame.layout)) {
    const std::uint32_t mask = (std::uint32_t{1} << attribute.bits) - 1;
    for (std::size_t i = attribute.first * vertices; i < (attribute.first + attribute.count) * vertices; ++i)
      frame.components[i] = (frame.components[i] + before.components[i]) & mask;
  }
}

Frame decode(ByteSpan bytes, const FrameHeader& header, const std::string& location) {
  const auto planes = unpack(bytes.subspan(frameHeaderBytes), unpackedBytesOf(header.layout), location);
  Frame frame{header.layout, header.number, header.epoch, header.time, {}};
  const std::size_t vertices = header.layout.vertices;
  frame.components.resize(componentCount(header.layout) * vertices);
  const std::uint8_t* plane = planes.get();
  for (const ComponentBits& attribute : attributesOf(header.layout)) {
    const std::span<std::uint32_t> components(frame.components.data() + attribute.first * vertices,
                                              attribute.count * vertices);
    for (std::uint32_t byte = 0; byte < (attribute.bits + 7) / 8; ++byte, plane += components.size())
      addPlane(plane, components);
    for (std::uint32_t i = 0; i < attribute.count; ++i)
      restoreValues(components.subspan(i * vertices, vertices), header.prediction, header.layout.columns,
                    attribute.bits);
  }
  return frame;
}

} // namespace

Frame decodeFrame(ByteSpan bytes, const std::string& location) {
  return decode(bytes, readFrameHeader(bytes, location), location);
}

Frame decodeFrame(ByteSpan bytes, const Frame* before, const std::string& location) {
  const FrameHeader header = readFrameHeader(bytes, location, FrameContext::sequence);
  if (header.isDifference && (before == nullptr || before->layout != header.layout))
    throw Error(ErrorKind::malformed, location, "is a difference to a frame that is not there");
  Frame frame = decode(bytes, header, location);
  if (header.isDifference)
    addBefore(*before, frame);
  return frame;
}

} // namespace imgeo::live
