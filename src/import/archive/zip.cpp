#include "import/archive/zip.h"

#include "base/error.h"
#include "import/archive/gzip.h"

#include <algorithm>
#include <fmt/format.h>
#include <libdeflate.h>
#include <limits>
#include <memory>
#include <new>

namespace imgeo {

namespace {

constexpr std::string_view archiveSignature = "PK\3\4", entrySignature = "PK\1\2", endSignature = "PK\5\6";
constexpr std::size_t entryBytes = 46, endRecordBytes = 22, maxCommentBytes = 65535, headerBytes = 30;
constexpr std::uint16_t stored = 0, deflated = 8;

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

bool isZip(ByteSpan bytes) {
  return asText(bytes).starts_with(archiveSignature);
}

void refuseZipBomb(ByteSpan bytes, const std::string& name) {
  if (!isZip(bytes))
    return;
  const std::uint64_t unpacked = unpackedZipBytes(bytes), limit = unpackedLimit(bytes.size());
  if (unpacked > limit)
    throw Error(
        ErrorKind::limit, name,
        fmt::format("unpacks to {} bytes, {} times its size, which no model does", unpacked, unpacked / bytes.size()));
}

Bytes unpackZip(ByteSpan bytes, const std::string& name) {
  const Error damage(ErrorKind::malformed, name, "is a damaged ZIP archive, or one without a file");
  refuseZipBomb(bytes, name);
  const ByteSpan entry = bytes.subspan(directoryOf(bytes));
  if (entry.size() < entryBytes || !asText(entry).starts_with(entrySignature))
    throw damage;
  const auto method = loadLittle<std::uint16_t>(&entry[10]);
  const auto packedBytes = loadLittle<std::uint32_t>(&entry[20]), unpackedBytes = loadLittle<std::uint32_t>(&entry[24]),
             headerAt = loadLittle<std::uint32_t>(&entry[42]);
  if ((method != stored && method != deflated) || packedBytes == sizeInExtraField || unpackedBytes == sizeInExtraField)
    throw Error(ErrorKind::unsupported, name,
                "is a ZIP archive whose file is neither stored nor deflated, or too large");
  if (headerAt > bytes.size() || bytes.size() - headerAt < headerBytes)
    throw damage;
  const ByteSpan header = bytes.subspan(headerAt);
  const std::size_t packedAt =
      headerBytes + loadLittle<std::uint16_t>(&header[26]) + loadLittle<std::uint16_t>(&header[28]);
  if (!isZip(header) || header.size() < packedAt || header.size() - packedAt < packedBytes)
    throw damage;
  const ByteSpan packed = header.subspan(packedAt, packedBytes);
  if (method == stored)
    return {packed.begin(), packed.end()};
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> decompressor(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  if (!decompressor)
    throw std::bad_alloc();
  Bytes file(unpackedBytes);
  if (libdeflate_deflate_decompress(decompressor.get(), packed.data(), packed.size(), file.data(), file.size(),
                                    nullptr) != LIBDEFLATE_SUCCESS)
    throw damage;
  return file;
}

} // namespace imgeo
