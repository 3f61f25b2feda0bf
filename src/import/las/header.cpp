#include "import/las/header.h"

#include "base/error.h"
#include "import/mesh/point_cloud.h"
#include "import/source_name.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string_view>

namespace imgeo::las {

namespace {

using Type = Dimension::Type;

/// Bytes of the records of formats 0 to 10 (LAS 1.4, tables 7 to 18).
constexpr std::array<std::uint16_t, 11> formatBytes{20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
/// Offset of red in the records of each format; 0: without colours.
constexpr std::array<std::uint8_t, 11> colorOffsets{0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};
/// From this format on, points have 4 bits for each return, and flags of their own byte.
constexpr std::uint8_t firstLongFormat = 6;

constexpr std::size_t shortestHeader = 227, headerOfVersion4 = 375;
constexpr std::size_t recordHeaderBytes = 54, longRecordHeaderBytes = 60;
constexpr std::size_t extraBytesDescriptor = 192;

std::size_t bytesOf(Type type) {
  constexpr std::array<std::size_t, 10> sizes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

/// The text of a field of fixed length, up to its first zero byte.
std::string_view textAt(ByteSpan bytes, std::size_t offset, std::size_t length) {
  const std::string_view text = asText(bytes.subspan(offset, length));
  return text.substr(0, text.find('\0'));
}

/// The dimensions of a format, except position and colour.
std::vector<Dimension> dimensionsOf(std::uint8_t format) {
  std::vector<Dimension> dimensions{{.name = "intensity", .type = Type::uint16, .offset = 12}};
  const auto add = [&](Dimension dimension) { dimensions.push_back(std::move(dimension)); };
  if (format < firstLongFormat) {
    add({.name = "returnNumber", .offset = 14, .mask = 7});
    add({.name = "numberOfReturns", .offset = 14, .shift = 3, .mask = 7});
    add({.name = "classification", .offset = 15, .mask = 31});
    add({.name = "scanAngle", .type = Type::int8, .offset = 16});
    add({.name = "userData", .offset = 17});
    add({.name = "pointSourceId", .type = Type::uint16, .offset = 18});
    if (format != 0 && format != 2)
      add({.name = "gpsTime", .type = Type::float64, .offset = 20});
    return dimensions;
  }
  add({.name = "returnNumber", .offset = 14, .mask = 15});
  add({.name = "numberOfReturns", .offset = 14, .shift = 4, .mask = 15});
  add({.name = "classification", .offset = 16});
  add({.name = "userData", .offset = 17});
  add({.name = "scanAngle", .type = Type::int16, .offset = 18, .scale = 0.006});
  add({.name = "pointSourceId", .type = Type::uint16, .offset = 20});
  add({.name = "gpsTime", .type = Type::float64, .offset = 22});
  if (format == 8 || format == 10)
    add({.name = "nearInfrared", .type = Type::uint16, .offset = 36});
  return dimensions;
}

class HeaderReader {
public:
  HeaderReader(ByteSpan bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  Header read() {
    if (bytes_.size() < shortestHeader)
      throw Error(ErrorKind::truncated, name_, "the file is too short for a LAS file's header");
    const std::uint8_t major = bytes_[24], minor = bytes_[25];
    if (major != 1 || minor > 4)
      throw Error(ErrorKind::unsupported, byteLocation(name_, 24),
                  fmt::format("LAS {}.{} is not read, only 1.0 to 1.4", major, minor));
    readFormat();
    readCount(minor);
    readTransform();
    readRecords();
    if (minor >= 4)
      readLongRecords();
    addExtraBytes();
    return std::move(header_);
  }

private:
  template <typename T> T at(std::size_t offset) const { return loadLittle<T>(&bytes_[offset]); }

  void readFormat() {
    const std::uint8_t stored = bytes_[104];
    if ((stored & 0xc0) != 0)
      throw Error(ErrorKind::unsupported, name_,
                  "is compressed (LAZ), which imgeo does not read; `las2las -i IN.laz -o OUT.las` of LAStools or `pdal "
                  "translate IN.laz OUT.las` unpacks it");
    if (stored >= formatBytes.size())
      throw Error(ErrorKind::unsupported, byteLocation(name_, 104),
                  fmt::format("points of format {} are not read, only those of formats 0 to 10", stored));
    header_.format = stored;
    header_.recordBytes = at<std::uint16_t>(105);
    if (header_.recordBytes < formatBytes[stored])
      throw Error(ErrorKind::malformed, byteLocation(name_, 105),
                  fmt::format("records of {} bytes are too short for points of format {}, which take {}",
                              header_.recordBytes, stored, formatBytes[stored]));
    header_.dimensions = dimensionsOf(stored);
    header_.hasWaveforms = stored == 4 || stored == 5 || stored == 9 || stored == 10;
  }

  void readCount(std::uint8_t minor) {
    header_.firstPoint = at<std::uint32_t>(96);
    header_.pointCount = at<std::uint32_t>(107);
    if (minor >= 4 && at<std::uint16_t>(94) >= headerOfVersion4 && bytes_.size() >= headerOfVersion4)
      if (const auto count = at<std::uint64_t>(247); count != 0)
        header_.pointCount = count;
    if (header_.firstPoint < shortestHeader || header_.firstPoint > bytes_.size())
      throw Error(ErrorKind::malformed, byteLocation(name_, 96),
                  fmt::format("the points cannot begin at byte {}", header_.firstPoint));
    const std::uint64_t there = (bytes_.size() - header_.firstPoint) / header_.recordBytes;
    if (header_.pointCount > there)
      throw Error(ErrorKind::truncated, byteLocation(name_, 107),
                  fmt::format("the header promises {} points of {} bytes, but only {} bytes follow", header_.pointCount,
                              header_.recordBytes, bytes_.size() - header_.firstPoint));
    if (header_.pointCount == 0)
      throw Error(ErrorKind::malformed, name_, "has no points");
    if (header_.pointCount > std::numeric_limits<std::uint32_t>::max())
      throw Error(ErrorKind::limit, name_, "more points than 32-bit indices can name");
  }

  void readTransform() {
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t scaleAt = 131 + 8 * static_cast<std::size_t>(axis), offsetAt = scaleAt + 24;
      header_.scale[axis] = at<double>(scaleAt);
      header_.offset[axis] = at<double>(offsetAt);
      const double reach = std::abs(header_.scale[axis]) * 2147483648.0 + std::abs(header_.offset[axis]);
      if (header_.scale[axis] == 0 || !(reach <= std::numeric_limits<float>::max()))
        throw Error(ErrorKind::malformed, byteLocation(name_, header_.scale[axis] == 0 ? scaleAt : offsetAt),
                    "scale and offset of the coordinates are no usable numbers");
    }
  }

  void readRecords() {
    std::size_t cursor = at<std::uint16_t>(94);
    const auto count = at<std::uint32_t>(100);
    for (std::uint32_t n = 0; n < count; ++n) {
      const std::size_t left = cursor <= bytes_.size() ? bytes_.size() - cursor : 0;
      const std::size_t length = left >= recordHeaderBytes ? at<std::uint16_t>(cursor + 20) : 0;
      if (left < recordHeaderBytes + length)
        throw Error(ErrorKind::truncated, byteLocation(name_, std::min(cursor, bytes_.size())),
                    fmt::format("the file ends within variable length record {} of {}", n + 1, count));
      readRecord(cursor, bytes_.subspan(cursor + recordHeaderBytes, length));
      cursor += recordHeaderBytes + length;
    }
  }

  void readLongRecords() {
    if (at<std::uint16_t>(94) < headerOfVersion4 || bytes_.size() < headerOfVersion4)
      return;
    std::uint64_t cursor = at<std::uint64_t>(235);
    const auto count = at<std::uint32_t>(243);
    for (std::uint32_t n = 0; n < count; ++n) {
      const std::uint64_t left = cursor <= bytes_.size() ? bytes_.size() - cursor : 0;
      const std::uint64_t length = left >= longRecordHeaderBytes ? at<std::uint64_t>(cursor + 20) : 0;
      if (left < longRecordHeaderBytes || length > left - longRecordHeaderBytes)
        throw Error(ErrorKind::truncated, byteLocation(name_, std::min<std::uint64_t>(cursor, bytes_.size())),
                    fmt::format("the file ends within extended variable length record {} of {}", n + 1, count));
      readRecord(cursor, bytes_.subspan(cursor + longRecordHeaderBytes, length));
      cursor += longRecordHeaderBytes + length;
    }
  }

  void readRecord(std::size_t start, ByteSpan content) {
    const std::string_view user = textAt(bytes_, start + 2, 16);
    const auto id = at<std::uint16_t>(start + 18);
    if (user == "LASF_Projection" && id == 2112)
      header_.wkt = std::string(textAt(content, 0, content.size()));
    else if (user == "LASF_Projection" && id == 34735)
      readGeoKeys(content);
    else if (user == "LASF_Spec" && id == 4)
      extraBytes_ = content;
  }

  /// The code of the projected system, or else of the geographic one (GeoTIFF 1.0, 2.4).
  void readGeoKeys(ByteSpan keys) {
    constexpr std::uint16_t geographic = 2048, projected = 3072, userDefined = 32767;
    for (std::size_t entry = 8; entry + 8 <= keys.size(); entry += 8) {
      const auto key = loadLittle<std::uint16_t>(&keys[entry]), where = loadLittle<std::uint16_t>(&keys[entry + 2]),
                 code = loadLittle<std::uint16_t>(&keys[entry + 6]);
      const bool isCode = where == 0 && code != 0 && code < userDefined;
      if (isCode && (key == projected || (key == geographic && header_.crs.empty())))
        header_.crs = fmt::format("EPSG:{}", code);
    }
  }

  /// Adds the dimensions that the extra bytes of each record hold (LAS 1.4, table 24).
  void addExtraBytes() {
    std::size_t offset = formatBytes[header_.format];
    for (std::size_t entry = 0; entry + extraBytesDescriptor <= extraBytes_.size(); entry += extraBytesDescriptor) {
      const ByteSpan descriptor = extraBytes_.subspan(entry, extraBytesDescriptor);
      const std::uint8_t dataType = descriptor[2], options = descriptor[3];
      if (dataType == 0) { // bytes without a meaning
        offset += options;
        continue;
      }
      if (dataType > 30)
        return; // what follows has no known place
      const auto type = static_cast<Type>((dataType - 1) % 10);
      const std::uint32_t components = 1 + (dataType - 1u) / 10u;
      Dimension dimension{
          .name = nameOf(textAt(descriptor, 4, 32)), .type = type, .offset = offset, .components = components};
      constexpr std::uint8_t hasScale = 8, hasOffset = 16;
      if ((options & hasScale) != 0)
        dimension.scale = loadLittle<double>(&descriptor[112]);
      if ((options & hasOffset) != 0)
        dimension.addend = loadLittle<double>(&descriptor[136]);
      offset += components * bytesOf(type);
      if (offset > header_.recordBytes)
        throw Error(ErrorKind::malformed, name_,
                    fmt::format("the extra bytes '{}' do not fit into records of {} bytes", dimension.name,
                                header_.recordBytes));
      header_.dimensions.push_back(std::move(dimension));
    }
  }

  /// A name that can stand in documents and lists, and that no other dimension has.
  std::string nameOf(std::string_view stored) const {
    std::vector<std::string> taken;
    for (const Dimension& dimension : header_.dimensions)
      taken.push_back(dimension.name);
    return pointValueName(stored, taken);
  }

  ByteSpan bytes_;
  const std::string& name_;
  Header header_;
  ByteSpan extraBytes_;
};

} // namespace

double Dimension::valueOf(const std::uint8_t* record, std::uint32_t component) const {
  const std::uint8_t* const at = record + offset + component * bytesOf(type);
  const double stored = [&]() -> double {
    switch (type) {
    case Type::uint8:
      return (*at >> shift) & mask;
    case Type::int8:
      return loadLittle<std::int8_t>(at);
    case Type::uint16:
      return loadLittle<std::uint16_t>(at);
    case Type::int16:
      return loadLittle<std::int16_t>(at);
    case Type::uint32:
      return loadLittle<std::uint32_t>(at);
    case Type::int32:
      return loadLittle<std::int32_t>(at);
    case Type::uint64:
      return static_cast<double>(loadLittle<std::uint64_t>(at));
    case Type::int64:
      return static_cast<double>(loadLittle<std::int64_t>(at));
    case Type::float32:
      return loadLittle<float>(at);
    case Type::float64:
      return loadLittle<double>(at);
    }
    return 0;
  }();
  return stored * scale + addend;
}

std::size_t Header::colorOffset() const {
  return colorOffsets[format];
}

bool Header::isWithheld(const std::uint8_t* record) const {
  return (record[15] & (format < firstLongFormat ? 0x80 : 0x04)) != 0;
}

Header readHeader(ByteSpan bytes, const std::string& name) {
  return HeaderReader(bytes, name).read();
}

} // namespace imgeo::las
