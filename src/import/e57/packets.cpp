#include "import/e57/packets.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace imgeo::e57 {

namespace {

constexpr std::uint8_t pointSection = 1;
enum PacketType : std::uint8_t { indexPacket, dataPacket, emptyPacket };
constexpr std::size_t sectionHeaderBytes = 32, packetHeaderBytes = 4, dataHeaderBytes = 6;

class SectionReader {
public:
  SectionReader(PagedFile& file, const Scan& scan, std::span<FieldValues* const> values)
      : file_(file), scan_(scan), values_(values) {}

  void read() {
    readHeader();
    while (!isComplete()) {
      if (end_ - packet_ < packetHeaderBytes)
        throw Error(
            ErrorKind::truncated, file_.locationOf(packet_),
            fmt::format("the section of a scan's points ends after {} of {}", completeRecords(), scan_.recordCount));
      readPacket();
    }
  }

private:
  [[noreturn]] void fail(std::uint64_t logical, const std::string& message) const {
    throw Error(ErrorKind::malformed, file_.locationOf(logical), message);
  }

  void readHeader() {
    std::array<std::uint8_t, sectionHeaderBytes> header{};
    file_.read(scan_.section, header);
    if (header[0] != pointSection)
      fail(scan_.section, fmt::format("a section of type {} cannot be that of a scan's points, 1", header[0]));
    const auto bytes = loadLittle<std::uint64_t>(&header[8]);
    if (bytes > file_.logicalBytes() - scan_.section)
      throw Error(
          ErrorKind::truncated, file_.locationOf(scan_.section + 8),
          fmt::format("a section of {} bytes is promised, but {} follow", bytes, file_.logicalBytes() - scan_.section));
    end_ = scan_.section + bytes;
    packet_ = file_.logicalOf(loadLittle<std::uint64_t>(&header[16]), "the offset of a section's packets");
    if (packet_ < scan_.section + sectionHeaderBytes || packet_ > end_)
      fail(scan_.section + 16, "the packets of a scan's points are not within their section");
  }

  bool isComplete() const {
    return std::ranges::all_of(values_, [](const FieldValues* values) { return !values || values->isComplete(); });
  }

  std::uint64_t completeRecords() const {
    std::uint64_t records = scan_.recordCount;
    for (const FieldValues* values : values_)
      if (values)
        records = std::min(records, values->size());
    return records;
  }

  void readPacket() {
    std::array<std::uint8_t, packetHeaderBytes> header{};
    file_.read(packet_, header);
    const std::size_t bytes = std::size_t{loadLittle<std::uint16_t>(&header[2])} + 1;
    if (bytes < packetHeaderBytes || bytes > end_ - packet_)
      fail(packet_ + 2, fmt::format("a packet of {} bytes is not within its section", bytes));
    if (header[0] == dataPacket) {
      content_.resize(bytes);
      file_.read(packet_, content_);
      readData();
    } else if (header[0] != indexPacket && header[0] != emptyPacket) {
      fail(packet_, fmt::format("packets of type {} are unknown", header[0]));
    }
    packet_ += bytes;
  }

  void readData() {
    const std::size_t streams = content_.size() < dataHeaderBytes ? 0 : loadLittle<std::uint16_t>(&content_[4]);
    if (streams != values_.size())
      fail(packet_ + 4, fmt::format("a packet has {} bytestreams, and points have {} fields", streams, values_.size()));
    std::size_t at = dataHeaderBytes + 2 * streams;
    for (std::size_t n = 0; n < streams; ++n) {
      const std::size_t lengthAt = dataHeaderBytes + 2 * n;
      const std::size_t length = lengthAt + 2 <= content_.size() ? loadLittle<std::uint16_t>(&content_[lengthAt]) : 0;
      if (at > content_.size() || length > content_.size() - at)
        fail(packet_ + lengthAt, fmt::format("the bytestreams of a packet of {} bytes are longer", content_.size()));
      if (values_[n])
        values_[n]->append(ByteSpan(content_).subspan(at, length));
      at += length;
    }
  }

  PagedFile& file_;
  const Scan& scan_;
  std::span<FieldValues* const> values_;
  std::uint64_t packet_ = 0, end_ = 0; ///< logical offsets of the next packet and behind the section
  Bytes content_;                      ///< of the packet
};

} // namespace

void readPackets(PagedFile& file, const Scan& scan, std::span<FieldValues* const> values) {
  SectionReader(file, scan, values).read();
}

} // namespace imgeo::e57
