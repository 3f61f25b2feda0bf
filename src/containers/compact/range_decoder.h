#pragma once
// Decodes what range_encoder.h encodes. Safe for untrusted bytes: past the end of a stream it reads zeros, and `finish`
// throws.

#include "base/bytes.h"
#include "base/error.h"
#include "containers/compact/models.h"

#include <string>

namespace imgeo::compact {

class RangeDecoder {
public:
  static constexpr bool encodes = false;

  /// `bytes` and `location` outlive the decoder.
  RangeDecoder(ByteSpan bytes, std::size_t modelCount, const std::string& location)
      : models_(modelCount), bytes_(bytes), end_(bytes.size()), location_(location) {
    for (int i = 0; i < 3; ++i)
      shiftIn();
  }

  /// Reads a bit. The value argument is for encoders.
  bool bit(std::size_t model, bool = false) {
    Model& m = models_[model];
    const std::uint32_t bound = (range_ >> 8) * m.probability() >> 8;
    const bool value = code_ < bound;
    m.update(value);
    if (value) {
      range_ = bound;
    } else {
      code_ -= bound;
      range_ -= bound;
    }
    for (; range_ < 65536; range_ <<= 8)
      shiftIn();
    return value;
  }

  /// Reads `count` (0 .. 30) raw bits.
  std::uint32_t raw(std::uint32_t count, std::uint32_t = 0) {
    for (; rawBitCount_ < count; rawBitCount_ += 8)
      rawBits_ |= std::uint64_t{end_ > 0 ? bytes_[--end_] : underrun()} << rawBitCount_;
    const auto value = static_cast<std::uint32_t>(rawBits_ & ((std::uint64_t{1} << count) - 1));
    rawBits_ >>= count;
    rawBitCount_ -= count;
    return value;
  }

  /// Throws Error{malformed} unless a condition holds.
  void require(bool condition, const char* message) const {
    if (!condition)
      throw Error(ErrorKind::malformed, location_, message);
  }

  /// Call it after the last read: throws unless the stream has exactly the length of its contents.
  void finish() const { require(at_ + underrun_ == end_, "a stream is not as long as what it holds"); }

private:
  void shiftIn() {
    code_ = code_ << 8 | (at_ < bytes_.size() ? bytes_[at_] : 0u);
    ++at_;
  }
  std::uint8_t underrun() {
    ++underrun_;
    return 0;
  }

  Models models_;
  ByteSpan bytes_;
  std::size_t at_ = 0, end_, underrun_ = 0;
  std::uint32_t code_ = 0, range_ = 0xffffff;
  std::uint64_t rawBits_ = 0;
  std::uint32_t rawBitCount_ = 0;
  const std::string& location_;
};

} // namespace imgeo::compact
