#pragma once
// Reads the records of a PLY file's elements with either cursor. Checks counts before allocating.

#include "import/ply/cursor.h"

#include <algorithm>
#include <span>
#include <vector>

namespace imgeo {

template <typename Cursor> class PlyRecords {
public:
  explicit PlyRecords(Cursor cursor) : cursor_(cursor) {}

  Cursor& cursor() { return cursor_; }

  [[noreturn]] void fail(ErrorKind kind, const std::string& message) const { cursor_.fail(kind, message); }
  std::size_t bytesLeft() const { return cursor_.bytesLeft(); }
  /// The maximum number of values that the remaining bytes can hold.
  std::size_t valuesLeft(PlyType type) const { return roomLeft() / Cursor::minSize(type); }

  /// Calls body() for each record. Throws before the first where the remaining bytes cannot hold the stated count.
  template <typename Function> void forEach(const PlyElement& element, Function body) {
    checkCount(element);
    if (element.properties.empty())
      return; // its records take no bytes
    for (std::uint64_t i = 0; i < element.count; ++i) {
      cursor_.beginRecord({&element, i});
      body();
      cursor_.endRecord();
    }
  }

  void checkCount(const PlyElement& element) const {
    std::size_t minRecordBytes = 0;
    for (const PlyProperty& property : element.properties)
      minRecordBytes += Cursor::minSize(property.countType.value_or(property.type));
    if (minRecordBytes > 0 && element.count > roomLeft() / minRecordBytes)
      fail(ErrorKind::truncated,
           fmt::format("the header promises {} of '{}', at least {} bytes each, but only {} bytes are left",
                       element.count, element.name, minRecordBytes, bytesLeft()));
  }

  double scalar(PlyType type) { return cursor_.scalar(type); }
  /// Reads values of one type that follow each other.
  void values(PlyType type, std::span<double> out) { cursor_.values(type, out); }

  /// Reads a vertex index, which must be below `vertexCount` (at most 2^32).
  std::uint32_t vertexIndex(PlyType type, std::uint64_t vertexCount) {
    const double index = scalar(type);
    checkVertexIndex(index, vertexCount);
    return static_cast<std::uint32_t>(index);
  }
  void checkVertexIndex(double index, std::uint64_t vertexCount) const {
    if (!(index >= 0 && index < static_cast<double>(vertexCount)))
      fail(ErrorKind::malformed, fmt::format("vertex {} is named, but there are only {}", index, vertexCount));
  }

  /// Reads a list; the result is valid until the next call.
  std::span<const double> list(const PlyProperty& property) {
    scratch_.resize(listCount(property));
    cursor_.values(property.type, scratch_);
    return scratch_;
  }

  void skip(const PlyProperty& property) { cursor_.skip(property.type, property.isList() ? listCount(property) : 1); }

  /// The number of bytes after the last record, not counting leading white space.
  std::size_t trailingBytes() { return cursor_.trailingBytes(); }

private:
  /// The bytes that are left, with a separator that the end of the file may lack.
  std::size_t roomLeft() const { return bytesLeft() + Cursor::optionalEndBytes; }

  std::size_t listCount(const PlyProperty& property) {
    const double count = cursor_.scalar(*property.countType);
    if (count < 0)
      fail(ErrorKind::malformed, "a list has a negative count");
    if (count > static_cast<double>(valuesLeft(property.type)))
      fail(ErrorKind::truncated,
           fmt::format("a list promises {} values, but only {} bytes are left", count, bytesLeft()));
    return static_cast<std::size_t>(count);
  }

  Cursor cursor_;
  std::vector<double> scratch_;
};

} // namespace imgeo
