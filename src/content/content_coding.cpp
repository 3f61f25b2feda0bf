#include "content/content_coding.h"

#include <algorithm>
#include <brotli/encode.h>
#include <cassert>
#include <cctype>
#include <libdeflate.h>
#include <memory>
#include <new>
#include <optional>

namespace imgeo {

namespace {

/// Levels of the libraries. The fast ones suit the first request of a large scene's HTML and come within a few percent
/// of the slowest ones there; on typed arrays brotli's slowest level halves what its fast one leaves.
struct Levels {
  int brotli, gzip;
};

constexpr Levels levelsOf(CodingEffort effort) {
  return effort == CodingEffort::fast ? Levels{.brotli = 5, .gzip = 6} : Levels{.brotli = 11, .gzip = 12};
}

struct FreeCompressor {
  void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
};

Bytes gzip(ByteSpan bytes, int level) {
  const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(libdeflate_alloc_compressor(level));
  if (!compressor)
    throw std::bad_alloc();
  Bytes out(libdeflate_gzip_compress_bound(compressor.get(), bytes.size()));
  out.resize(libdeflate_gzip_compress(compressor.get(), bytes.data(), bytes.size(), out.data(), out.size()));
  assert(!out.empty());
  return out;
}

Bytes brotli(ByteSpan bytes, int level) {
  std::size_t size = BrotliEncoderMaxCompressedSize(bytes.size());
  Bytes out(size);
  if (!BrotliEncoderCompress(level, BROTLI_DEFAULT_WINDOW, BROTLI_DEFAULT_MODE, bytes.size(), bytes.data(), &size,
                             out.data()))
    throw std::bad_alloc();
  out.resize(size);
  return out;
}

/// Removes the text up to the first `separator` from `rest` and returns it without surrounding blanks.
std::string_view takeUntil(std::string_view& rest, char separator) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  std::string_view token = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  while (!token.empty() && (token.front() == ' ' || token.front() == '\t'))
    token.remove_prefix(1);
  while (!token.empty() && (token.back() == ' ' || token.back() == '\t'))
    token.remove_suffix(1);
  return token;
}

/// "q=0.5" in thousandths, 0..1000; nothing if malformed.
std::optional<int> parseQuality(std::string_view text) {
  if (text.size() < 3 || text.size() > 7 || (text[0] != 'q' && text[0] != 'Q') || text[1] != '=')
    return std::nullopt;
  if ((text[2] != '0' && text[2] != '1') || (text.size() > 3 && text[3] != '.'))
    return std::nullopt;
  int quality = (text[2] - '0') * 1000, digitValue = 100;
  for (std::size_t i = 4; i < text.size(); ++i, digitValue /= 10) {
    if (text[i] < '0' || text[i] > '9')
      return std::nullopt;
    quality += (text[i] - '0') * digitValue;
  }
  return std::min(quality, 1000);
}

bool equalsIgnoringCase(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

} // namespace

std::string_view codingName(ContentCoding coding) {
  switch (coding) {
  case ContentCoding::brotli:
    return "br";
  case ContentCoding::gzip:
    return "gzip";
  case ContentCoding::identity:
    break;
  }
  return "identity";
}

std::string_view codingExtension(ContentCoding coding) {
  switch (coding) {
  case ContentCoding::brotli:
    return ".br";
  case ContentCoding::gzip:
    return ".gz";
  case ContentCoding::identity:
    break;
  }
  return "";
}

ContentCoding chooseCoding(std::string_view acceptEncoding) {
  std::optional<int> statedBrotli, statedGzip, statedIdentity, statedAny;
  while (!acceptEncoding.empty()) {
    std::string_view item = takeUntil(acceptEncoding, ',');
    const std::string_view name = takeUntil(item, ';');
    const std::optional<int> quality = item.empty() ? 1000 : parseQuality(takeUntil(item, ';'));
    if (!quality)
      continue;
    if (equalsIgnoringCase(name, "br"))
      statedBrotli = quality;
    else if (equalsIgnoringCase(name, "gzip") || equalsIgnoringCase(name, "x-gzip"))
      statedGzip = quality;
    else if (equalsIgnoringCase(name, "identity"))
      statedIdentity = quality;
    else if (name == "*")
      statedAny = quality;
  }
  const int otherQuality = statedAny.value_or(0);
  const int brotliQuality = statedBrotli.value_or(otherQuality), gzipQuality = statedGzip.value_or(otherQuality);
  // Identity is allowed if the client does not name it; any coding that the client names comes before it.
  const int identityQuality = statedIdentity.value_or(1);
  if (brotliQuality > 0 && brotliQuality >= gzipQuality && brotliQuality >= identityQuality)
    return ContentCoding::brotli;
  if (gzipQuality > 0 && gzipQuality >= identityQuality)
    return ContentCoding::gzip;
  return ContentCoding::identity;
}

Bytes encodeContent(ContentCoding coding, ByteSpan bytes, CodingEffort effort) {
  switch (coding) {
  case ContentCoding::brotli:
    return brotli(bytes, levelsOf(effort).brotli);
  case ContentCoding::gzip:
    return gzip(bytes, levelsOf(effort).gzip);
  case ContentCoding::identity:
    break;
  }
  return {bytes.begin(), bytes.end()};
}

} // namespace imgeo
