#include "containers/webp/webp.h"

#include "containers/limits.h"

#include <cassert>
#include <memory>
#include <new>
#include <webp/encode.h>

namespace imgeo {

namespace {

/// Throws where a call of libwebp has failed. Image and settings are valid, so that the reason is lack of memory.
void requireMemory(bool isDone) {
  if (!isDone)
    throw std::bad_alloc();
}

/// Pixel n as 0xAARRGGBB.
std::uint32_t argbOf(const Image& image, std::size_t n) {
  const std::uint8_t* pixel = &image.pixels[n * image.channels];
  if (!image.palette.empty())
    pixel = &image.palette[std::size_t{3} * *pixel];
  const bool isGray = image.channels == 1 && image.palette.empty();
  const std::uint32_t red = pixel[0], green = pixel[isGray ? 0 : 1], blue = pixel[isGray ? 0 : 2];
  const std::uint32_t alpha = image.channels == 4 ? pixel[3] : 255;
  return alpha << 24 | red << 16 | green << 8 | blue;
}

} // namespace

Bytes encodeWebp(const Image& image, int effort) {
  assert(image.width > 0 && image.height > 0 && image.width <= maxImageEdge && image.height <= maxImageEdge);
  WebPConfig config;
  requireMemory(WebPConfigInit(&config) && WebPConfigLosslessPreset(&config, effort));
  config.exact = 1;
  WebPPicture picture;
  requireMemory(WebPPictureInit(&picture));
  const std::unique_ptr<WebPPicture, decltype(&WebPPictureFree)> freePicture(&picture, WebPPictureFree);
  WebPMemoryWriter writer;
  WebPMemoryWriterInit(&writer);
  const std::unique_ptr<WebPMemoryWriter, decltype(&WebPMemoryWriterClear)> freeWriter(&writer, WebPMemoryWriterClear);
  picture.use_argb = 1;
  picture.width = static_cast<int>(image.width);
  picture.height = static_cast<int>(image.height);
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &writer;
  requireMemory(WebPPictureAlloc(&picture));
  for (std::size_t row = 0; row < image.height; ++row)
    for (std::size_t column = 0; column < image.width; ++column)
      picture.argb[row * static_cast<std::size_t>(picture.argb_stride) + column] =
          argbOf(image, row * image.width + column);
  requireMemory(WebPEncode(&config, &picture));
  return Bytes(writer.mem, writer.mem + writer.size);
}

} // namespace imgeo
