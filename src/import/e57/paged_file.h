#pragma once
// The pages of an E57 file (ASTM E2807, 5): each has 1024 bytes, of which the last four are the checksum of the others.
// Physical offsets count all bytes of the file, logical ones leave out the checksums.

#include "base/bytes.h"
#include "base/error.h"

#include <cstdint>
#include <span>
#include <string>

namespace imgeo::e57 {

inline constexpr std::size_t pageBytes = 1024, pageContentBytes = 1020;

/// CRC-32C (Castagnoli; RFC 3720, appendix B.4).
std::uint32_t crc32c(ByteSpan bytes);

/// A file whose header has been read. `bytes` and `name` outlive it.
class PagedFile {
public:
  /// Reads the header. Throws Error (truncated, malformed, unsupported) with the byte.
  PagedFile(ByteSpan bytes, const std::string& name);

  std::uint64_t xmlStart() const { return xmlStart_; } ///< logical
  std::uint64_t xmlBytes() const { return xmlBytes_; } ///< all within the file
  std::uint64_t logicalBytes() const { return pages_ * pageContentBytes; }

  /// The logical offset of a physical one, which `what` of the file states. Throws Error{malformed} where it is behind
  /// the file or in a checksum.
  std::uint64_t logicalOf(std::uint64_t physical, const std::string& what) const;

  /// Copies bytes from a logical offset on, and compares the checksums of their pages. Throws Error: truncated where
  /// they reach beyond the file, malformed where a checksum differs.
  void read(std::uint64_t logical, std::span<std::uint8_t> out);

  /// "scan.e57, byte 2048" of a logical offset.
  std::string locationOf(std::uint64_t logical) const;

private:
  void check(std::uint64_t page);

  ByteSpan bytes_;
  const std::string& name_;
  std::uint64_t pages_ = 0;
  std::uint64_t xmlStart_ = 0, xmlBytes_ = 0;
  std::uint64_t checkedPage_; ///< the last one whose checksum is right
};

} // namespace imgeo::e57
