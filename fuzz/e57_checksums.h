#pragma once
// Checksums of changed E57 files.

#include "import/e57/paged_file.h"

#include <algorithm>

namespace imgeo::fuzz {

/// The bytes with right checksums, without which no change behind the header would reach the reader.
inline Bytes withChecksums(ByteSpan bytes) {
  Bytes repaired(bytes.begin(), bytes.end());
  for (std::size_t page = 0; page + e57::pageBytes <= repaired.size(); page += e57::pageBytes) {
    Bytes sum;
    appendBig(sum, e57::crc32c(ByteSpan(repaired).subspan(page, e57::pageContentBytes)));
    std::ranges::copy(sum, repaired.begin() + static_cast<std::ptrdiff_t>(page + e57::pageContentBytes));
  }
  return repaired;
}

} // namespace imgeo::fuzz
