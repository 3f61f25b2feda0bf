#include "import/archive/zip.h"

#include "base/error.h"
#include "import/archive/gzip.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

namespace {

constexpr std::string_view archive = "PK\3\4", entry = "PK\1\2", endOfDirectory = "PK\5\6";
constexpr std::size_t entryBytes = 46, endBytes = 22, maxCommentBytes = 65535;

/// The offset of the central directory; the size of the archive where there is none.
std::size_t directoryOf(ByteSpan bytes) {
  const std::size_t tail = std::min(bytes.size(), endBytes + maxCommentBytes);
  const std::size_t at = asText(bytes.last(tail)).rfind(endOfDirectory);
  if (at == std::string_view::npos || tail - at < endBytes)
    return bytes.size();
  return std::min<std::size_t>(loadLittle<std::uint32_t>(bytes.last(tail).subspan(at + 16).data()), bytes.size());
}

} // namespace

std::uint64_t unpackedZipBytes(ByteSpan bytes) {
  std::uint64_t sum = 0;
  ByteSpan rest = bytes.subspan(directoryOf(bytes));
  while (rest.size() >= entryBytes && asText(rest).starts_with(entry)) {
    // For sizes beyond 32 bits this field is 0xffffffff, which exceeds the limit anyway.
    sum += loadLittle<std::uint32_t>(&rest[24]);
    const std::size_t names = std::size_t{loadLittle<std::uint16_t>(&rest[28])} + loadLittle<std::uint16_t>(&rest[30]) +
                              loadLittle<std::uint16_t>(&rest[32]);
    rest = rest.subspan(std::min(entryBytes + names, rest.size()));
  }
  return sum;
}

void refuseZipBomb(ByteSpan bytes, const std::string& name) {
  if (!asText(bytes).starts_with(archive))
    return;
  const std::uint64_t unpacked = unpackedZipBytes(bytes), limit = unpackedLimit(bytes.size());
  if (unpacked > limit)
    throw Error(
        ErrorKind::limit, name,
        fmt::format("unpacks to {} bytes, {} times its size, which no model does", unpacked, unpacked / bytes.size()));
}

} // namespace imgeo
