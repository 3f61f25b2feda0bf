#include "images/sgi.h"

#include "base/error.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

namespace {

constexpr std::size_t headerBytes = 512;

class SgiReader {
public:
  SgiReader(ByteSpan bytes, const std::string& location) : bytes_(bytes), location_(location) {
    if (bytes.size() < headerBytes)
      fail(ErrorKind::truncated, "ends in its header");
    const unsigned storage = bytes[2], dimensions = loadBig<std::uint16_t>(&bytes[4]);
    bytesPerChannel_ = bytes[3];
    width_ = loadBig<std::uint16_t>(&bytes[6]);
    height_ = dimensions >= 2 ? loadBig<std::uint16_t>(&bytes[8]) : 1;
    channels_ = dimensions >= 3 ? loadBig<std::uint16_t>(&bytes[10]) : 1;
    isRunLengthEncoded_ = storage == 1;
    if (storage > 1 || bytesPerChannel_ < 1 || bytesPerChannel_ > 2 || dimensions < 1 || dimensions > 3)
      fail(ErrorKind::malformed, fmt::format("states storage {}, {} bytes a channel and {} dimensions", storage,
                                             bytesPerChannel_, dimensions));
    if (width_ == 0 || height_ == 0)
      fail(ErrorKind::malformed, "has no pixels");
    if (channels_ < 1 || channels_ > 4)
      fail(ErrorKind::unsupported, fmt::format("has {} channels; those of 1 to 4 are decoded", channels_));
    if (const auto colorMap = loadBig<std::uint32_t>(&bytes[104]); colorMap != 0)
      fail(ErrorKind::unsupported, fmt::format("has the obsolete kind of colours {}; only 0 is decoded", colorMap));
  }

  Raster read(std::uint64_t maxPixels) const {
    requireRasterSize(width_, height_, maxPixels, location_);
    const std::size_t rows = std::size_t{height_} * channels_;
    const std::size_t minBytes = isRunLengthEncoded_ ? 8 * rows : rows * width_ * bytesPerChannel_;
    if (bytes_.size() - headerBytes < minBytes)
      fail(ErrorKind::truncated, fmt::format("needs {} bytes for {} x {} pixels of {} channels, but has {}",
                                             headerBytes + minBytes, width_, height_, channels_, bytes_.size()));
    Raster raster{width_, height_, {}};
    raster.pixels.assign(std::size_t{4} * width_ * height_, 255);
    for (std::uint32_t channel = 0; channel < channels_; ++channel)
      for (std::uint32_t row = 0; row < height_; ++row)
        readRow(channel, row, &raster.pixels[std::size_t{4} * width_ * (height_ - 1 - row)]);
    return raster;
  }

private:
  [[noreturn]] void fail(ErrorKind kind, const std::string& what) const {
    throw Error(kind, location_, "is an SGI image that " + what);
  }

  /// Reads a row of a channel into that channel of the pixels; grey into red, green and blue.
  void readRow(std::uint32_t channel, std::uint32_t row, std::uint8_t* pixels) const {
    const bool isGray = channels_ < 3;
    const std::uint32_t target = isGray && channel == 1 ? 3 : channel;
    if (isRunLengthEncoded_)
      readRuns(channel, row, pixels + target);
    else
      copy(&bytes_[headerBytes + (std::size_t{channel} * height_ + row) * width_ * bytesPerChannel_], width_,
           pixels + target);
    if (isGray && channel == 0)
      for (std::size_t x = 0; x < width_; ++x)
        pixels[4 * x + 1] = pixels[4 * x + 2] = pixels[4 * x];
  }

  /// The first byte of two is the higher one.
  void copy(const std::uint8_t* from, std::size_t count, std::uint8_t* to) const {
    for (std::size_t i = 0; i < count; ++i)
      to[4 * i] = from[i * bytesPerChannel_];
  }

  /// Rows may share their runs. A row ends where it is full, since some files have no zero after its last run.
  void readRuns(std::uint32_t channel, std::uint32_t row, std::uint8_t* to) const {
    ByteSpan runs = runsOf(channel, row);
    for (std::size_t done = 0; done < width_;) {
      const unsigned head = runs.size() < bytesPerChannel_ ? 0 : runs[bytesPerChannel_ - 1];
      const bool isCopied = head & 0x80;
      const std::size_t count = std::min<std::size_t>(head & 0x7f, width_ - done);
      const std::size_t values = isCopied ? count : 1;
      if (count == 0 || runs.size() < (1 + values) * bytesPerChannel_)
        fail(ErrorKind::malformed,
             fmt::format("has {} of {} pixels in row {} of channel {}", done, width_, row, channel));
      runs = runs.subspan(bytesPerChannel_);
      if (isCopied)
        copy(runs.data(), count, to + 4 * done);
      else
        for (std::size_t i = 0; i < count; ++i)
          to[4 * (done + i)] = runs[0];
      runs = runs.subspan(values * bytesPerChannel_);
      done += count;
    }
  }

  /// The tables of offsets and lengths stand behind the header.
  ByteSpan runsOf(std::uint32_t channel, std::uint32_t row) const {
    const std::size_t rows = std::size_t{height_} * channels_, number = std::size_t{channel} * height_ + row;
    const std::size_t offset = loadBig<std::uint32_t>(&bytes_[headerBytes + 4 * number]);
    const std::size_t length = loadBig<std::uint32_t>(&bytes_[headerBytes + 4 * (rows + number)]);
    if (offset > bytes_.size() || length > bytes_.size() - offset)
      fail(ErrorKind::malformed, fmt::format("has row {} of channel {} behind its end", row, channel));
    return bytes_.subspan(offset, length);
  }

  ByteSpan bytes_;
  const std::string& location_;
  std::uint32_t width_ = 0, height_ = 0, channels_ = 0, bytesPerChannel_ = 0;
  bool isRunLengthEncoded_ = false;
};

} // namespace

Raster decodeSgi(ByteSpan bytes, const std::string& location, std::uint64_t maxPixels) {
  return SgiReader(bytes, location).read(maxPixels);
}

} // namespace imgeo
