#include "import/e57/paged_file.h"

#include "import/source_name.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <limits>

namespace imgeo::e57 {

namespace {

constexpr std::size_t headerBytes = 48;

/// tables[k][b]: the sum of byte b followed by k zero bytes.
constexpr auto crcTables() {
  constexpr std::uint32_t reversedPolynomial = 0x82f63b78;
  std::array<std::array<std::uint32_t, 256>, 8> tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t sum = byte;
    for (int bit = 0; bit < 8; ++bit)
      sum = (sum & 1) != 0 ? (sum >> 1) ^ reversedPolynomial : sum >> 1;
    tables[0][byte] = sum;
  }
  for (std::size_t k = 1; k < tables.size(); ++k)
    for (std::size_t byte = 0; byte < 256; ++byte)
      tables[k][byte] = (tables[k - 1][byte] >> 8) ^ tables[0][tables[k - 1][byte] & 0xff];
  return tables;
}

} // namespace

std::uint32_t crc32c(ByteSpan bytes) {
  static constexpr auto tables = crcTables();
  std::uint32_t sum = ~0u;
  for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
    const std::uint32_t low = loadLittle<std::uint32_t>(bytes.data()) ^ sum;
    const auto high = loadLittle<std::uint32_t>(&bytes[4]);
    sum = tables[7][low & 0xff] ^ tables[6][(low >> 8) & 0xff] ^ tables[5][(low >> 16) & 0xff] ^ tables[4][low >> 24] ^
          tables[3][high & 0xff] ^ tables[2][(high >> 8) & 0xff] ^ tables[1][(high >> 16) & 0xff] ^
          tables[0][high >> 24];
  }
  for (const std::uint8_t byte : bytes)
    sum = (sum >> 8) ^ tables[0][(sum ^ byte) & 0xff];
  return ~sum;
}

PagedFile::PagedFile(ByteSpan bytes, const std::string& name)
    : bytes_(bytes), name_(name), checkedPage_(std::numeric_limits<std::uint64_t>::max()) {
  if (!asText(bytes).starts_with("ASTM-E57"))
    throw Error(ErrorKind::malformed, byteLocation(name, 0), "the file does not begin with the signature of E57");
  if (bytes.size() < headerBytes)
    throw Error(ErrorKind::truncated, name, "the file is too short for an E57 file's header");
  const auto major = loadLittle<std::uint32_t>(&bytes[8]), minor = loadLittle<std::uint32_t>(&bytes[12]);
  if (major != 1)
    throw Error(ErrorKind::unsupported, byteLocation(name, 8),
                fmt::format("E57 {}.{} is not read, only 1.0", major, minor));
  const auto stated = loadLittle<std::uint64_t>(&bytes[16]), page = loadLittle<std::uint64_t>(&bytes[40]);
  if (page != pageBytes)
    throw Error(ErrorKind::malformed, byteLocation(name, 40),
                fmt::format("pages of {} bytes are not those of E57, which have 1024", page));
  if (stated == 0 || stated % pageBytes != 0)
    throw Error(ErrorKind::malformed, byteLocation(name, 16),
                fmt::format("a file of {} bytes does not consist of pages of 1024", stated));
  if (stated > bytes.size())
    throw Error(ErrorKind::truncated, byteLocation(name, 16),
                fmt::format("the header promises a file of {} bytes, but it has {}", stated, bytes.size()));
  pages_ = stated / pageBytes;
  check(0);
  xmlStart_ = logicalOf(loadLittle<std::uint64_t>(&bytes[24]), "the header's offset of the XML section");
  xmlBytes_ = loadLittle<std::uint64_t>(&bytes[32]);
  if (xmlBytes_ > logicalBytes() - xmlStart_)
    throw Error(ErrorKind::truncated, byteLocation(name, 32),
                fmt::format("the header promises an XML section of {} bytes, but {} follow", xmlBytes_,
                            logicalBytes() - xmlStart_));
}

std::uint64_t PagedFile::logicalOf(std::uint64_t physical, const std::string& what) const {
  const std::uint64_t page = physical / pageBytes, within = physical % pageBytes;
  if (page >= pages_ || within >= pageContentBytes)
    throw Error(ErrorKind::malformed, name_,
                fmt::format("{}, {}, is {}", what, physical,
                            page >= pages_ ? "behind the file's last byte" : "within a page's checksum"));
  return page * pageContentBytes + within;
}

std::string PagedFile::locationOf(std::uint64_t logical) const {
  return byteLocation(name_, logical / pageContentBytes * pageBytes + logical % pageContentBytes);
}

void PagedFile::check(std::uint64_t page) {
  if (page == checkedPage_)
    return;
  const ByteSpan content = bytes_.subspan(page * pageBytes, pageContentBytes);
  if (crc32c(content) != loadBig<std::uint32_t>(content.data() + pageContentBytes))
    throw Error(ErrorKind::malformed, byteLocation(name_, page * pageBytes + pageContentBytes),
                "a page's checksum is not that of its bytes");
  checkedPage_ = page;
}

void PagedFile::read(std::uint64_t logical, std::span<std::uint8_t> out) {
  if (logical > logicalBytes() || out.size() > logicalBytes() - logical)
    throw Error(ErrorKind::truncated, locationOf(std::min(logical, logicalBytes())),
                fmt::format("{} bytes are promised, but the file has {} from here on", out.size(),
                            logicalBytes() - std::min(logical, logicalBytes())));
  while (!out.empty()) {
    const std::uint64_t page = logical / pageContentBytes, within = logical % pageContentBytes;
    check(page);
    const std::size_t count = std::min<std::size_t>(out.size(), pageContentBytes - within);
    std::ranges::copy(bytes_.subspan(page * pageBytes + within, count), out.begin());
    out = out.subspan(count);
    logical += count;
  }
}

} // namespace imgeo::e57
