#include "import/archive/zip.h"

#include "base/error.h"
#include "import/archive/gzip.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace imgeo {

namespace {

constexpr std::string_view archiveSignature = "PK\3\4", entrySignature = "PK\1\2", endSignature = "PK\5\6";
constexpr std::size_t entryBytes = 46, endRecordBytes = 22, maxCommentBytes = 65535;

constexpr std::uint32_t sizeInExtraField = 0xffffffff;
constexpr std::uint16_t zip64Field = 1;

/// The unpacked size of an entry of the central directory: from its ZIP64 extra field (APPNOTE.TXT 4.5.3), whose first
/// number it is, where 32 bits are too few. A ZIP64 entry without the field is counted as more than any limit.
std::uint64_t unpackedSizeOf(ByteSpan entry) {
  const auto size = loadLittle<std::uint32_t>(&entry[24]);
  if (size != sizeInExtraField)
    return size;
  const std::size_t nameBytes = loadLittle<std::uint16_t>(&entry[28]),
                    extraBytes = loadLittle<std::uint16_t>(&entry[30]);
  if (entry.size() >= entryBytes + nameBytes + extraBytes) {
    ByteSpan extra = entry.subspan(entryBytes + nameBytes, extraBytes);
    while (extra.size() >= 4) {
      const std::size_t fieldBytes = loadLittle<std::uint16_t>(&extra[2]);
      if (loadLittle<std::uint16_t>(extra.data()) == zip64Field && fieldBytes >= 8 && extra.size() >= 12)
        return loadLittle<std::uint64_t>(&extra[4]);
      extra = extra.subspan(std::min(4 + fieldBytes, extra.size()));
    }
  }
  return std::numeric_limits<std::uint64_t>::max();
}

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
    const std::uint64_t size = unpackedSizeOf(rest);
    if (size > std::numeric_limits<std::uint64_t>::max() - sum)
      return std::numeric_limits<std::uint64_t>::max();
    sum += size;
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
