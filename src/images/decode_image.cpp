#include "images/decode_image.h"

#include "base/dynamic_library.h"
#include "base/error.h"
#include "images/image_type.h"
#include "images/sgi.h"

#include <algorithm>
#include <fmt/format.h>
#include <magick/api.h>
#include <memory>

namespace imgeo {

namespace {

/// The functions of GraphicsMagick that are used. The library depends on fifty others.
struct Magick : DynamicLibrary {
  Magick() : DynamicLibrary(IMGEO_GRAPHICSMAGICK) {}

  decltype(&::AutoOrientImage) autoOrientImage = find("AutoOrientImage");
  decltype(&::BlobToImage) blobToImage = find("BlobToImage");
  decltype(&::CloneImageInfo) cloneImageInfo = find("CloneImageInfo");
  decltype(&::DestroyExceptionInfo) destroyExceptionInfo = find("DestroyExceptionInfo");
  decltype(&::DestroyImage) destroyImage = find("DestroyImage");
  decltype(&::DestroyImageInfo) destroyImageInfo = find("DestroyImageInfo");
  decltype(&::DispatchImage) dispatchImage = find("DispatchImage");
  decltype(&::GetExceptionInfo) getExceptionInfo = find("GetExceptionInfo");
  decltype(&::InitializeMagickEx) initializeMagickEx = find("InitializeMagickEx");
  decltype(&::PingBlob) pingBlob = find("PingBlob");
  decltype(&::SetMagickResourceLimit) setMagickResourceLimit = find("SetMagickResourceLimit");
  decltype(&::TransformColorspace) transformColorspace = find("TransformColorspace");
};

const Magick& magick();

struct Destroy {
  void operator()(ImageInfo* info) const { magick().destroyImageInfo(info); }
  void operator()(::Image* image) const { magick().destroyImage(image); }
};
using Info = std::unique_ptr<ImageInfo, Destroy>;
using Decoded = std::unique_ptr<::Image, Destroy>;

/// The errors and warnings of GraphicsMagick calls.
class MagickExceptions {
public:
  explicit MagickExceptions(const Magick& library) : library_(library) { library.getExceptionInfo(&info_); }
  ~MagickExceptions() { library_.destroyExceptionInfo(&info_); }
  MagickExceptions(const MagickExceptions&) = delete;
  MagickExceptions& operator=(const MagickExceptions&) = delete;

  ExceptionInfo* info() { return &info_; }
  bool isError() const { return info_.severity >= ErrorException; }

private:
  const Magick& library_;
  ExceptionInfo info_;
};

/// Initialises the library with limits: pixels stay in memory, and the library uses one thread. Its limits of size are
/// far above those of requireRasterSize(), which states the size: the library would only say that a header is wrong.
void start(const Magick& library) {
  MagickExceptions exceptions(library);
  library.initializeMagickEx(nullptr, MAGICK_OPT_NO_SIGNAL_HANDER, exceptions.info());
  library.setMagickResourceLimit(PixelsResource, std::int64_t{1} << 40);
  library.setMagickResourceLimit(WidthResource, 1 << 20);
  library.setMagickResourceLimit(HeightResource, 1 << 20);
  library.setMagickResourceLimit(DiskResource, 0);
  library.setMagickResourceLimit(ThreadsResource, 1);
}

/// Loads and initialises the library at the first call.
const Magick& magick() {
  static const Magick library = [] {
    const Magick loaded;
    start(loaded);
    return loaded;
  }();
  return library;
}

/// Settings that decode the first image of a file as exactly this type, without guessing from its content.
Info infoFor(const std::string& type) {
  std::string format = type == ".jpg" ? "JPEG" : type == ".tif" ? "TIFF" : type.substr(1);
  std::ranges::transform(format, format.begin(), [](char c) { return c >= 'a' && c <= 'z' ? c - 32 : c; });
  Info info(magick().cloneImageInfo(nullptr));
  fmt::format_to_n(info->magick, sizeof info->magick - 1, "{}", format);
  fmt::format_to_n(info->filename, sizeof info->filename - 1, "{}:", format);
  info->subimage = 0;
  info->subrange = 1;
  return info;
}

} // namespace

Raster decodeRaster(ByteSpan bytes, const std::string& location, std::uint64_t maxPixels) {
  const std::string type = imageType(bytes);
  if (!isDecodable(type))
    throw Error(ErrorKind::unsupported, location, "is an image of a kind that imgeo does not decode");
  if (type == ".sgi")
    return decodeSgi(bytes, location, maxPixels);
  const auto refuse = [&] {
    throw Error(ErrorKind::malformed, location, fmt::format("is a {} image that does not decode", type.substr(1)));
  };
  const Info info = infoFor(type);
  MagickExceptions exceptions(magick());
  if (const Decoded header(magick().pingBlob(info.get(), bytes.data(), bytes.size(), exceptions.info())); header)
    requireRasterSize(header->columns, header->rows, maxPixels, location);
  else
    refuse();
  Decoded image(magick().blobToImage(info.get(), bytes.data(), bytes.size(), exceptions.info()));
  if (!image || exceptions.isError())
    refuse();
  requireRasterSize(image->columns, image->rows, maxPixels, location);
  if (image->orientation > TopLeftOrientation)
    if (Decoded upright(magick().autoOrientImage(image.get(), image->orientation, exceptions.info())); upright)
      image = std::move(upright);
  if (!IsRGBCompatibleColorspace(image->colorspace))
    magick().transformColorspace(image.get(), RGBColorspace);
  Raster raster{static_cast<std::uint32_t>(image->columns), static_cast<std::uint32_t>(image->rows), {}};
  raster.pixels.resize(std::size_t{4} * raster.width * raster.height);
  if (magick().dispatchImage(image.get(), 0, 0, image->columns, image->rows, "RGBA", CharPixel, raster.pixels.data(),
                             exceptions.info()) == MagickFail)
    refuse();
  if (!image->matte) // the library leaves alpha undefined for opaque images
    for (std::size_t at = 3; at < raster.pixels.size(); at += 4)
      raster.pixels[at] = 255;
  return raster;
}

bool isShownInPages(ByteSpan bytes) {
  const std::string type = imageType(bytes);
  if (!isWebImageType(type) && type != ".bmp")
    return false;
  try {
    if (isDecodable(type))
      decodeRaster(bytes, "");
    return true;
  } catch (const Error& error) {
    return error.kind() == ErrorKind::limit; // too large for imgeo, not for every browser
  }
}

} // namespace imgeo
