#include "images/encode_image.h"

#include "base/dynamic_library.h"

#include <avif/avif.h>
#include <cassert>
#include <memory>
#include <new>
#include <webp/encode.h>

namespace imgeo {

namespace {

/// Throws where a library call has failed. Rasters and settings are valid, so that the reason is lack of memory.
void require(bool isDone) {
  if (!isDone)
    throw std::bad_alloc();
}

/// The functions of libavif that are used. The library depends on seven codecs.
struct Avif : DynamicLibrary {
  Avif() : DynamicLibrary(IMGEO_AVIF) {}

  decltype(&::avifEncoderCreate) encoderCreate = find("avifEncoderCreate");
  decltype(&::avifEncoderDestroy) encoderDestroy = find("avifEncoderDestroy");
  decltype(&::avifEncoderWrite) encoderWrite = find("avifEncoderWrite");
  decltype(&::avifImageCreate) imageCreate = find("avifImageCreate");
  decltype(&::avifImageDestroy) imageDestroy = find("avifImageDestroy");
  decltype(&::avifImageRGBToYUV) imageRGBToYUV = find("avifImageRGBToYUV");
  decltype(&::avifRGBImageSetDefaults) setDefaultsOfRgb = find("avifRGBImageSetDefaults");
  decltype(&::avifRWDataFree) freeData = find("avifRWDataFree");
};

Bytes encoded(const Raster& raster, const WebPConfig& config) {
  WebPPicture picture;
  require(WebPPictureInit(&picture));
  WebPMemoryWriter writer;
  WebPMemoryWriterInit(&writer);
  const std::unique_ptr<WebPPicture, decltype(&WebPPictureFree)> freePicture(&picture, WebPPictureFree);
  const std::unique_ptr<WebPMemoryWriter, decltype(&WebPMemoryWriterClear)> freeWriter(&writer, WebPMemoryWriterClear);
  picture.use_argb = 1;
  picture.width = static_cast<int>(raster.width);
  picture.height = static_cast<int>(raster.height);
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &writer;
  const int stride = 4 * picture.width;
  require(hasAlpha(raster) ? WebPPictureImportRGBA(&picture, raster.pixels.data(), stride)
                           : WebPPictureImportRGBX(&picture, raster.pixels.data(), stride));
  require(WebPEncode(&config, &picture));
  return Bytes(writer.mem, writer.mem + writer.size);
}

} // namespace

Bytes encodeWebp(const Raster& raster, int quality) {
  WebPConfig config;
  require(WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, static_cast<float>(quality)));
  config.use_sharp_yuv = 1; // without it, edges between saturated red and dark colours blur
  return encoded(raster, config);
}

Bytes encodeLosslessWebp(const Raster& raster) {
  WebPConfig config;
  require(WebPConfigInit(&config) && WebPConfigLosslessPreset(&config, 6));
  config.exact = 1; // keeps the colours of pixels whose alpha is 0: data maps store numbers there
  return encoded(raster, config);
}

Bytes encodeAvif(const Raster& raster, int quality) {
  static const Avif avif; // loaded at the first call
  const std::unique_ptr<avifImage, decltype(avif.imageDestroy)> image(
      avif.imageCreate(static_cast<int>(raster.width), static_cast<int>(raster.height), 8, AVIF_PIXEL_FORMAT_YUV420),
      avif.imageDestroy);
  const std::unique_ptr<avifEncoder, decltype(avif.encoderDestroy)> encoder(avif.encoderCreate(), avif.encoderDestroy);
  require(image && encoder);
  image->colorPrimaries = AVIF_COLOR_PRIMARIES_BT709;
  image->transferCharacteristics = AVIF_TRANSFER_CHARACTERISTICS_SRGB;
  image->matrixCoefficients = AVIF_MATRIX_COEFFICIENTS_BT601;
  image->yuvRange = AVIF_RANGE_FULL;
  avifRGBImage rgb;
  avif.setDefaultsOfRgb(&rgb, image.get());
  rgb.ignoreAlpha = !hasAlpha(raster);
  rgb.pixels = const_cast<std::uint8_t*>(raster.pixels.data()); // only read
  rgb.rowBytes = 4 * raster.width;
  require(avif.imageRGBToYUV(image.get(), &rgb) == AVIF_RESULT_OK);
  // libavif 1.0 maps quality to AV1's quantizers in this way.
  const int quantizer = ((100 - quality) * AVIF_QUANTIZER_WORST_QUALITY + 50) / 100;
  encoder->minQuantizer = encoder->maxQuantizer = quantizer;
  encoder->minQuantizerAlpha = encoder->maxQuantizerAlpha = quantizer;
  encoder->speed = 6;
  encoder->maxThreads = 1; // several images are encoded in parallel
  avifRWData output = AVIF_DATA_EMPTY;
  const avifResult result = avif.encoderWrite(encoder.get(), image.get(), &output);
  const std::unique_ptr<avifRWData, decltype(avif.freeData)> freeOutput(&output, avif.freeData);
  require(result == AVIF_RESULT_OK);
  return Bytes(output.data, output.data + output.size);
}

} // namespace imgeo
