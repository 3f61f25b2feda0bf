#include "containers/image_file.h"

#include "containers/webp/webp.h"

namespace imgeo {

const char* nameOf(ImageFormat format) {
  return format == ImageFormat::webp ? "webp" : "png";
}

const char* extensionOf(ImageFormat format) {
  return format == ImageFormat::webp ? ".webp" : ".png";
}

Bytes encodeImageFile(const Image& image, ImageFormat format, int effort) {
  return format == ImageFormat::webp ? encodeWebp(image, effort) : encodePng(image, effort);
}

EncodedImage encodeImage(const Image& image, ImageFormat format, int effort) {
  EncodedImage png{ImageFormat::png, encodePng(image, effort)};
  if (format == ImageFormat::png)
    return png;
  EncodedImage webp{ImageFormat::webp, encodeWebp(image, effort)};
  return webp.bytes.size() < png.bytes.size() ? webp : png;
}

Image decodeImageFile(ByteSpan bytes, const std::string& location) {
  return isWebp(bytes) ? decodeWebp(bytes, location) : decodePng(bytes, location);
}

} // namespace imgeo
