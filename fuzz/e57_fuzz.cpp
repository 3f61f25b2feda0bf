#include "import/e57/paged_file.h"

#include "import_check.h"

#include <algorithm>

namespace {

/// The bytes with right checksums, without which no change behind the header would reach the reader.
imgeo::Bytes withChecksums(imgeo::ByteSpan bytes) {
  using namespace imgeo;
  Bytes repaired(bytes.begin(), bytes.end());
  for (std::size_t page = 0; page + e57::pageBytes <= repaired.size(); page += e57::pageBytes) {
    Bytes sum;
    appendBig(sum, e57::crc32c(ByteSpan(repaired).subspan(page, e57::pageContentBytes)));
    std::ranges::copy(sum, repaired.begin() + static_cast<std::ptrdiff_t>(page + e57::pageContentBytes));
  }
  return repaired;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  imgeo::fuzz::importOrRefuse({data, size}, "fuzz.e57");
  return imgeo::fuzz::importOrRefuse(withChecksums({data, size}), "fuzz.e57");
}
