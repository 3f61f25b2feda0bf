#include "video/sequence_video.h"

#include "base/error.h"
#include "video/vp9.h"

#include <fmt/format.h>

namespace imgeo {

namespace {

/// libvpx's "cpu-used" for an effort: the smaller, the slower and the fewer bytes.
int speedOf(int effort) {
  return effort >= 9 ? 2 : effort >= 4 ? 4 : 6;
}

/// The image from which one is decoded: in files of other programs that may be the first.
std::uint32_t keyBefore(const WebmVideo& video, std::uint32_t image) {
  while (image > 0 && !video.packets[image].isKey)
    --image;
  return image;
}

} // namespace

std::vector<Bytes> encodeVideoFrames(std::span<const live::Frame> frames, VideoSize size, int effort) {
  Vp9Encoder encoder(size, speedOf(effort));
  std::vector<Bytes> packets;
  for (const live::Frame& frame : frames)
    packets.push_back(encoder.encode(videoImageOf(frame, size)));
  return packets;
}

void decodeVideoFrames(ByteSpan bytes, const SequenceIndex& index, std::uint32_t first, std::uint32_t end,
                       const std::string& location, const std::function<void(const live::Frame&)>& visit) {
  const WebmVideo video = readWebm(bytes, location);
  const live::FrameLayout& layout = index.description.layout;
  const VideoSize size = videoSizeOf(layout, location);
  if (video.size != size)
    throw Error(ErrorKind::malformed, location,
                fmt::format("has images of {} x {} pixels; those of its frames have {} x {}", video.size.width,
                            video.size.height, size.width, size.height));
  if (video.packets.size() != index.frameCount())
    throw Error(ErrorKind::malformed, location,
                fmt::format("has {} images; its index states {} frames", video.packets.size(), index.frameCount()));
  Vp9Decoder decoder(size, location);
  for (std::uint32_t number = keyBefore(video, first); number < end; ++number) {
    const Bytes pixels = decoder.decode(video.packets[number], number);
    if (number < first)
      continue;
    live::Frame frame = frameOfVideoImage(pixels, size, layout, number, location);
    frame.time = number / index.description.rate;
    visit(frame);
  }
}

} // namespace imgeo
