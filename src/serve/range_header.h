#pragma once
// The Range header of a request (RFC 9110, section 14).

#include <cstdint>
#include <string_view>

namespace imgeo {

struct ByteRange {
  enum class Kind {
    whole,         ///< no range, several ranges, or a malformed one: send everything
    partial,       ///< `count` bytes from `first`
    unsatisfiable, ///< well-formed, but the file has no such byte
  };
  Kind kind = Kind::whole;
  std::uint64_t first = 0, count = 0; ///< for whole: 0 and the file's size

  friend bool operator==(const ByteRange&, const ByteRange&) = default;
};

/// The range of a file of `size` bytes that "bytes=0-99", "bytes=100-" or "bytes=-100" asks for. Several ranges at once
/// give the whole file, as the RFC allows. Safe for untrusted bytes.
ByteRange parseRange(std::string_view header, std::uint64_t size);

} // namespace imgeo
