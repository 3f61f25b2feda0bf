#include "import/archive/gzip.h"

#include "base/error.h"
#include "import/source_name.h"

#include <algorithm>
#include <fmt/format.h>
#include <libdeflate.h>
#include <memory>

namespace imgeo {

namespace {

constexpr std::size_t maxDeflateRatio = 1032;
constexpr std::size_t minMemberBytes = 18;

struct FreeDecompressor {
  void operator()(libdeflate_decompressor* d) const { libdeflate_free_decompressor(d); }
};

/// The unpacked size modulo 2^32 that the last member states: exact for files of one member, a first guess for others.
std::size_t statedSize(ByteSpan bytes) {
  return bytes.size() < minMemberBytes ? 0 : loadLittle<std::uint32_t>(&bytes[bytes.size() - 4]);
}

} // namespace

std::size_t unpackedLimit(std::size_t packed) {
  return std::min(packed * maxDeflateRatio, std::max(unlimitedRatioBytes, packed * maxUnpackRatio));
}

bool isGzip(ByteSpan bytes) {
  return bytes.size() >= 2 && bytes[0] == 0x1f && bytes[1] == 0x8b;
}

void gunzipInto(const std::function<std::span<std::uint8_t>(std::size_t)>& resize, ByteSpan bytes,
                const std::string& name) {
  const std::unique_ptr<libdeflate_decompressor, FreeDecompressor> decompressor(libdeflate_alloc_decompressor());
  if (!decompressor)
    throw std::bad_alloc();

  const std::size_t limit = unpackedLimit(bytes.size());
  std::span<std::uint8_t> out = resize(std::min(limit, std::max<std::size_t>(statedSize(bytes), 1)));
  std::size_t read = 0, written = 0;
  while (read < bytes.size()) {
    const ByteSpan rest = bytes.subspan(read);
    if (!isGzip(rest)) {
      if (read > 0 && std::ranges::all_of(rest, [](std::uint8_t byte) { return byte == 0; }))
        break;
      throw Error(ErrorKind::malformed, byteLocation(name, read), "what follows here is not gzip data");
    }
    std::size_t memberRead = 0, memberWritten = 0;
    const libdeflate_result result =
        libdeflate_gzip_decompress_ex(decompressor.get(), rest.data(), rest.size(), out.data() + written,
                                      out.size() - written, &memberRead, &memberWritten);
    if (result == LIBDEFLATE_INSUFFICIENT_SPACE) {
      if (out.size() == limit)
        throw Error(ErrorKind::limit, name,
                    fmt::format("unpacks to more than {} bytes, {} times its size, which no mesh does", limit,
                                limit / bytes.size()));
      out = resize(std::min(limit, out.size() * 2));
    } else if (result != LIBDEFLATE_SUCCESS) {
      throw Error(ErrorKind::malformed, byteLocation(name, read),
                  "the gzip data that begins here is damaged or ends too early");
    } else {
      read += memberRead;
      written += memberWritten;
    }
  }
  resize(written);
}

Bytes gunzip(ByteSpan bytes, const std::string& name) {
  Bytes out;
  gunzipInto(
      [&](std::size_t size) {
        out.resize(size);
        return std::span<std::uint8_t>(out);
      },
      bytes, name);
  return out;
}

} // namespace imgeo
