#include "import/archive/zip.h"

#include "base/error.h"
#include "import/archive/gzip.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

namespace {

constexpr std::string_view archiveSignature = "PK\3\4", entrySignature = "PK\1\2", endSignature = "PK\5\6";
constexpr std::size_t entryBytes = 46, endRecordBytes = 22, maxCommentBytes = 65535;

/// The offset of the central directory; the size of the archive where there is none.
std::size_t directoryOf(ByteSpan bytes) {
  const std::size_t tail = std::min(bytes.size(), endRecordBytes + maxCommentBytes);
  const std::size_t at = asText(bytes.last(tail)).rfind(endSignature);
  if (at == std::string_view::npos || tail - at < endRecordBytes)
    return bytes.size();
  return std::min<std::size_t>(loadLittle<std::uint32_t>(bytes.last(tail).subspan(at + 16).data()), bytes.size());
}

} // namespace

std::uint64_t unpackedZipBytes(ByteSpan bytes) {
  std::uint64_t sum = 0;
  ByteSpan rest = bytes.subspan(directoryOf(bytes));
  while (rest.size() >= entryBytes && asText(rest).starts_with(entrySignature)) {
    // For sizes beyond 32 bits (ZIP64) this field is 0xffffffff, which exceeds the limit of archives below 40 MiB. The
    // memory limit of the child process bounds larger ones.
    sum += loadLittle<std::uint32_t>(&rest[24]);
    const std::size_t nameBytes = std::size_t{loadLittle<std::uint16_t>(&rest[28])} +
                                  loadLittle<std::uint16_t>(&rest[30]) + loadLittle<std::uint16_t>(&rest[32]);
    rest = rest.subspan(std::min(entryBytes + nameBytes, rest.size()));
  }
  return sum;
}

void refuseZipBomb(ByteSpan bytes, const std::string& name) {
  if (!asText(bytes).starts_with(archiveSignature))
    return;
  const std::uint64_t unpacked = unpackedZipBytes(bytes), limit = unpackedLimit(bytes.size());
  if (unpacked > limit)
    throw Error(
        ErrorKind::limit, name,
        fmt::format("unpacks to {} bytes, {} times its size, which no model does", unpacked, unpacked / bytes.size()));
}

} // namespace imgeo
