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
/// Values of a bit that a packet, of at most 65,536 bytes, may have.
constexpr std::uint64_t maxPacketRecords = std::uint64_t{1} << 19;

/// The packets of a section.
class SectionReader {
public:
  SectionReader(PagedFile& file, const Scan& scan) : file_(file), scan_(scan) { readHeader(); }

  std::uint64_t packet() const { return packet_; } ///< the logical offset of the next packet
  void goTo(std::uint64_t packet) { packet_ = packet; }
  bool isAtEnd() const { return end_ - packet_ < packetHeaderBytes; }

  /// Reads the next packet, and calls take(field, piece) for what it has of each bytestream.
  template <typename Take> void readPacket(const Take& take) {
    std::array<std::uint8_t, packetHeaderBytes> header{};
    file_.read(packet_, header);
    const std::size_t bytes = std::size_t{loadLittle<std::uint16_t>(&header[2])} + 1;
    if (bytes < packetHeaderBytes || bytes > end_ - packet_)
      fail(packet_ + 2, fmt::format("a packet of {} bytes is not within its section", bytes));
    if (header[0] == dataPacket) {
      content_.resize(bytes);
      file_.read(packet_, content_);
      readData(take);
    } else if (header[0] != indexPacket && header[0] != emptyPacket) {
      fail(packet_, fmt::format("packets of type {} are unknown", header[0]));
    }
    packet_ += bytes;
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

  template <typename Take> void readData(const Take& take) {
    const std::size_t streams = content_.size() < dataHeaderBytes ? 0 : loadLittle<std::uint16_t>(&content_[4]);
    if (streams != scan_.fields.size())
      fail(packet_ + 4,
           fmt::format("a packet has {} bytestreams, and points have {} fields", streams, scan_.fields.size()));
    std::size_t at = dataHeaderBytes + 2 * streams;
    for (std::size_t n = 0; n < streams; ++n) {
      const std::size_t lengthAt = dataHeaderBytes + 2 * n;
      const std::size_t length = lengthAt + 2 <= content_.size() ? loadLittle<std::uint16_t>(&content_[lengthAt]) : 0;
      if (at > content_.size() || length > content_.size() - at)
        fail(packet_ + lengthAt, fmt::format("the bytestreams of a packet of {} bytes are longer", content_.size()));
      take(n, ByteSpan(content_).subspan(at, length));
      at += length;
    }
  }

  PagedFile& file_;
  const Scan& scan_;
  std::uint64_t packet_ = 0, end_ = 0; ///< logical offsets of the next packet and behind the section
  Bytes content_;                      ///< of the packet
};

/// How far a bytestream has been read, without its values.
class StreamCount {
public:
  explicit StreamCount(const Field& field) : bits_(field.type == Field::Type::text ? 0 : field.bits()) {}

  bool counts() const { return bits_ > 0; } ///< false: the number of bytes does not say that of values
  void append(ByteSpan piece) {
    bytes_ += piece.size();
    tail_.insert(tail_.end(), piece.begin(), piece.end());
    if (tail_.size() > maxPending)
      tail_.erase(tail_.begin(), tail_.end() - maxPending);
  }
  std::uint64_t values() const { return 8 * bytes_ / bits_; }

  FieldState state() const {
    if (!counts())
      return {};
    const std::uint64_t bit = values() * bits_;
    return {values(), Bytes(tail_.end() - static_cast<std::ptrdiff_t>(bytes_ - bit / 8), tail_.end()),
            static_cast<std::uint32_t>(bit % 8)};
  }

private:
  static constexpr std::ptrdiff_t maxPending = 9; ///< of a value of 64 bits that begins within a byte

  std::uint32_t bits_;
  std::uint64_t bytes_ = 0;
  Bytes tail_;
};

} // namespace

void readPackets(PagedFile& file, const Scan& scan, std::span<FieldValues* const> values, std::uint64_t firstPacket) {
  SectionReader section(file, scan);
  if (firstPacket > 0)
    section.goTo(firstPacket);
  const auto isComplete = [](const FieldValues* each) { return !each || each->isComplete(); };
  while (!std::ranges::all_of(values, isComplete)) {
    if (section.isAtEnd()) {
      std::uint64_t records = scan.recordCount;
      for (const FieldValues* each : values)
        if (each)
          records = std::min(records, each->decoded());
      throw Error(ErrorKind::truncated, file.locationOf(section.packet()),
                  fmt::format("the section of a scan's points ends after {} of {}", records, scan.recordCount));
    }
    section.readPacket([&](std::size_t field, ByteSpan piece) {
      if (values[field])
        values[field]->append(piece);
    });
  }
}

std::vector<ScanPiece> piecesOf(PagedFile& file, const Description& description, std::size_t number,
                                std::uint64_t records) {
  const Scan& scan = description.scans.at(number);
  std::vector<ScanPiece> pieces{ScanPiece::whole(description, number)};
  SectionReader section(file, scan);
  std::vector<StreamCount> streams(scan.fields.begin(), scan.fields.end());
  for (std::uint64_t fewest = 0; fewest < scan.recordCount && !section.isAtEnd();) {
    section.readPacket([&](std::size_t field, ByteSpan piece) { streams[field].append(piece); });
    fewest = scan.recordCount;
    std::uint64_t furthest = 0;
    for (const StreamCount& stream : streams)
      if (stream.counts())
        fewest = std::min(fewest, stream.values()), furthest = std::max(furthest, stream.values());
    RecordRange& last = pieces.back().range;
    if (fewest < last.first + records || furthest >= scan.recordCount)
      continue;
    last.count = furthest - last.first;
    ScanPiece next{number, {furthest, scan.recordCount - furthest}, section.packet()};
    for (const StreamCount& stream : streams)
      next.states.push_back(stream.state());
    pieces.push_back(std::move(next));
  }
  for (const ScanPiece& piece : pieces)
    if (piece.range.count > 2 * records + maxPacketRecords)
      throw Error(ErrorKind::unsupported, file.locationOf(scan.section),
                  "the fields of a scan's points are far from one another, and it is not read piece by piece");
  return pieces;
}

} // namespace imgeo::e57
