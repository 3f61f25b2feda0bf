#include "transcode/convert/precompress.h"

#include "base/file.h"
#include "base/parallel.h"
#include "content/content_coding.h"
#include "content/media_type.h"
#include "transcode/site/site_files.h"

#include <vector>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

/// Writes the encoded bytes beside the file if they are fewer. Returns the bytes that a client then loads.
std::uint64_t writeEncoded(const fs::path& file, ByteSpan bytes, ContentCoding coding) {
  const Bytes encoded = encodeContent(coding, bytes, CodingEffort::smallest);
  if (encoded.size() >= bytes.size())
    return bytes.size();
  fs::path beside = file;
  beside += codingExtension(coding);
  writeFile(beside, encoded);
  return encoded.size();
}

} // namespace

PrecompressReport precompressSite(const fs::path& site) {
  std::vector<fs::path> files;
  for (const fs::path& file : filesIn(site))
    if (mediaTypeOf(file.native()).isCompressible && fs::file_size(site / file) >= minEncodedBytes)
      files.push_back(site / file);

  std::vector<PrecompressReport> reports(files.size());
  parallelFor(files.size(), [&](std::size_t i) {
    const Bytes bytes = readFile(files[i]);
    reports[i] = {.files = 1,
                  .bytes = bytes.size(),
                  .brotliBytes = writeEncoded(files[i], bytes, ContentCoding::brotli),
                  .gzipBytes = writeEncoded(files[i], bytes, ContentCoding::gzip)};
  });

  PrecompressReport sum;
  for (const PrecompressReport& report : reports) {
    if (report.brotliBytes == report.bytes && report.gzipBytes == report.bytes)
      continue; // neither coding makes it smaller
    sum.files += report.files;
    sum.bytes += report.bytes;
    sum.brotliBytes += report.brotliBytes;
    sum.gzipBytes += report.gzipBytes;
  }
  return sum;
}

} // namespace imgeo
