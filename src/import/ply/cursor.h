#pragma once
// Cursors over the body of a PLY file, one for text and one for binary data, with the same functions, so that one
// reader serves all encodings. Values are passed as double, which represents every PLY type exactly. Safe for untrusted
// bytes.

#include "import/ply/header.h"
#include "import/source_name.h"
#include "import/text/text_scanner.h"

#include <fmt/format.h>
#include <span>

namespace imgeo {

/// The record that a cursor is in, for messages.
struct PlyRecord {
  const PlyElement* element = nullptr;
  std::uint64_t index = 0;

  std::string name() const { return fmt::format("{} {} of {}", element->name, index + 1, element->count); }
};

/// Every record begins on a line of its own and may span several. Further words on its last line are an error, so that
/// a missing value is reported near its position and does not shift all values after it.
class AsciiPlyCursor {
public:
  AsciiPlyCursor(ByteSpan bytes, const std::string& name, std::size_t from) : scanner_(bytes, name, from) {}

  /// Bytes of the shortest value: a digit and a separator.
  static std::size_t minSize(PlyType) { return 2; }
  /// The separator after the last value of a file may be missing.
  static constexpr std::size_t optionalEndBytes = 1;
  std::size_t bytesLeft() const { return scanner_.bytesLeft(); }
  /// Valid between records: the byte at which the line of the next record begins.
  std::size_t beginOfLine() const {
    return scanner_.byteOffset() + (scanner_.atEnd() || !scanner_.atLineEnd() ? 0 : 1);
  }
  void goTo(std::size_t byteOffset) { scanner_.goTo(byteOffset); }

  void beginRecord(const PlyRecord& record) { record_ = record; }
  void endRecord() {
    scanner_.skipBlanks();
    if (!scanner_.atLineEnd())
      fail(ErrorKind::malformed, "this line has further words after the end of " + record_.name());
  }
  double scalar(PlyType type) {
    scanner_.skipSpace();
    if (scanner_.atEnd())
      fail(ErrorKind::truncated, "the file ends within " + record_.name());
    if (type == PlyType::float32)
      return scanner_.float32("a number");
    if (type == PlyType::float64)
      return scanner_.float64("a number");
    return static_cast<double>(scanner_.integerWord("an integer"));
  }
  void values(PlyType type, std::span<double> out) {
    for (double& value : out)
      value = scalar(type);
  }
  void skip(PlyType type, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      scalar(type);
  }
  std::size_t trailingBytes() {
    scanner_.skipSpace();
    return scanner_.bytesLeft();
  }
  [[noreturn]] void fail(ErrorKind kind, const std::string& message) const { scanner_.fail(kind, message); }

private:
  TextScanner scanner_;
  PlyRecord record_;
};

template <std::endian order> class BinaryPlyCursor {
public:
  BinaryPlyCursor(ByteSpan bytes, const std::string& name, std::size_t from) : bytes_(bytes), at_(from), name_(name) {}

  static std::size_t minSize(PlyType type) { return byteSizeOf(type); }
  static constexpr std::size_t optionalEndBytes = 0;
  std::size_t bytesLeft() const { return bytes_.size() - at_; }

  void beginRecord(const PlyRecord& record) { record_ = record; }
  void endRecord() {}

  double scalar(PlyType type) {
    double value = 0;
    values(type, {&value, 1});
    return value;
  }
  void values(PlyType type, std::span<double> out) {
    switch (type) {
    case PlyType::int8:
      return read<std::int8_t>(out);
    case PlyType::uint8:
      return read<std::uint8_t>(out);
    case PlyType::int16:
      return read<std::int16_t>(out);
    case PlyType::uint16:
      return read<std::uint16_t>(out);
    case PlyType::int32:
      return read<std::int32_t>(out);
    case PlyType::uint32:
      return read<std::uint32_t>(out);
    case PlyType::float32:
      return read<float>(out);
    case PlyType::float64:
      return read<double>(out);
    }
  }
  void skip(PlyType type, std::size_t count) {
    if (count > bytesLeft() / byteSizeOf(type))
      failTruncated();
    at_ += count * byteSizeOf(type);
  }
  std::size_t trailingBytes() const { return bytesLeft(); }
  [[noreturn]] void fail(ErrorKind kind, const std::string& message) const {
    throw Error(kind, byteLocation(name_, at_), message);
  }

private:
  template <typename T> void read(std::span<double> out) {
    if (out.size() > bytesLeft() / sizeof(T))
      failTruncated();
    const std::uint8_t* from = bytes_.data() + at_;
    for (std::size_t i = 0; i < out.size(); ++i, from += sizeof(T))
      out[i] = static_cast<double>(order == std::endian::little ? loadLittle<T>(from) : loadBig<T>(from));
    at_ += out.size() * sizeof(T);
  }
  [[noreturn]] void failTruncated() const { fail(ErrorKind::truncated, "the file ends within " + record_.name()); }

  ByteSpan bytes_;
  std::size_t at_;
  const std::string& name_;
  PlyRecord record_;
};

} // namespace imgeo
