#pragma once
// Writes E57 files, for tests.

#include "base/bytes.h"
#include "import/e57/paged_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace imgeo::testing {

/// Bits, the lowest first.
class BitWriter {
public:
  void put(std::uint64_t value, std::uint32_t bits) {
    for (std::uint32_t n = 0; n < bits; ++n) {
      if (used_ % 8 == 0)
        bytes_.push_back(0);
      bytes_.back() |= static_cast<std::uint8_t>(((value >> n) & 1) << (used_ % 8));
      ++used_;
    }
  }
  const Bytes& bytes() const { return bytes_; }

private:
  Bytes bytes_;
  std::size_t used_ = 0;
};

struct TestField {
  std::string element; ///< of the prototype
  std::function<void(BitWriter&, double)> put;
};

inline TestField float64(const std::string& name) {
  return {fmt::format(R"(<{} type="Float"/>)", name),
          [](BitWriter& out, double value) { out.put(std::bit_cast<std::uint64_t>(value), 64); }};
}
inline TestField float32(const std::string& name) {
  return {fmt::format(R"(<{} type="Float" precision="single"/>)", name),
          [](BitWriter& out, double value) { out.put(std::bit_cast<std::uint32_t>(static_cast<float>(value)), 32); }};
}
inline TestField integer(const std::string& name, std::int64_t minimum, std::int64_t maximum, double scale = 1,
                         double offset = 0) {
  const auto bits = static_cast<std::uint32_t>(
      std::bit_width(static_cast<std::uint64_t>(maximum) - static_cast<std::uint64_t>(minimum)));
  const std::string scaling = scale == 1 && offset == 0
                                  ? R"(type="Integer")"
                                  : fmt::format(R"(type="ScaledInteger" scale="{}" offset="{}")", scale, offset);
  return {fmt::format(R"(<{} {} minimum="{}" maximum="{}"/>)", name, scaling, minimum, maximum),
          [=](BitWriter& out, double value) {
            const auto stored = static_cast<std::int64_t>(std::llround((value - offset) / scale));
            out.put(static_cast<std::uint64_t>(stored) - static_cast<std::uint64_t>(minimum), bits);
          }};
}
inline TestField text(const std::string& name) {
  return {fmt::format(R"(<{} type="String"/>)", name), [](BitWriter& out, double) { out.put(0x7802, 16); }};
}

struct TestScan {
  std::string elements; ///< of the scan, besides its points
  std::vector<TestField> fields;
  std::vector<std::vector<double>> points;
};

/// Writes E57 files, whose packets hold at most `packetBytes` of each bytestream, with an index packet and an empty one
/// after the first.
struct TestFile {
  std::vector<TestScan> scans;
  std::string elements; ///< of the root
  std::size_t packetBytes = 5;
  std::size_t packets = 0; ///< so many packets with a share of each bytestream in place of packetBytes, if not 0
  std::uint64_t sectionBytesLess = 0; ///< what the sections' headers leave out

  static std::uint64_t physical(std::uint64_t logical) {
    return logical / e57::pageContentBytes * e57::pageBytes + logical % e57::pageContentBytes;
  }

  static void closePacket(Bytes& out, std::size_t start) {
    while ((out.size() - start) % 4 != 0)
      out.push_back(0);
    const std::size_t length = out.size() - start - 1;
    out[start + 2] = static_cast<std::uint8_t>(length), out[start + 3] = static_cast<std::uint8_t>(length >> 8);
  }

  static void appendSmallPacket(Bytes& out, std::uint8_t type, std::size_t bytes) {
    const std::size_t start = out.size();
    out.resize(start + bytes);
    out[start] = type;
    closePacket(out, start);
  }

  void appendSection(Bytes& out, const TestScan& scan) const {
    const std::size_t start = out.size();
    out.resize(start + 32);
    out[start] = 1;
    std::vector<BitWriter> streams(scan.fields.size());
    for (const std::vector<double>& point : scan.points)
      for (std::size_t field = 0; field < streams.size(); ++field)
        scan.fields[field].put(streams[field], point[field]);
    bool isFirst = true;
    const auto beginOf = [&](const BitWriter& stream, std::size_t number) {
      const std::size_t size = stream.bytes().size();
      return packets > 0 ? size * std::min(number, packets) / packets : std::min(number * packetBytes, size);
    };
    for (std::size_t number = 0;
         std::ranges::any_of(streams, [&](const BitWriter& s) { return beginOf(s, number) < s.bytes().size(); });
         ++number) {
      const std::size_t packet = out.size();
      out.insert(out.end(), {1, 0, 0, 0});
      appendLittle(out, static_cast<std::uint16_t>(streams.size()));
      const auto pieceOf = [&](const BitWriter& stream) {
        const std::size_t begin = beginOf(stream, number);
        return ByteSpan(stream.bytes()).subspan(begin, beginOf(stream, number + 1) - begin);
      };
      for (const BitWriter& stream : streams)
        appendLittle(out, static_cast<std::uint16_t>(pieceOf(stream).size()));
      for (const BitWriter& stream : streams)
        out.insert(out.end(), pieceOf(stream).begin(), pieceOf(stream).end());
      closePacket(out, packet);
      if (isFirst) {
        appendSmallPacket(out, 0, 32);
        appendSmallPacket(out, 2, 8);
      }
      isFirst = false;
    }
    Bytes header;
    appendLittle(header, std::uint64_t{out.size() - start - sectionBytesLess});
    appendLittle(header, physical(start + 32));
    std::ranges::copy(header, out.begin() + static_cast<std::ptrdiff_t>(start + 8));
  }

  Bytes file(const std::function<void(std::string&)>& editXml = {}) const {
    Bytes content(48);
    std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<e57Root type=\"Structure\" "
                      "xmlns=\"http://www.astm.org/COMMIT/E57/2010-e57-v1.0\">" +
                      elements + "<data3D type=\"Vector\">";
    for (const TestScan& scan : scans) {
      content.resize((content.size() + 3) / 4 * 4);
      const std::uint64_t section = content.size();
      appendSection(content, scan);
      std::string prototype;
      for (const TestField& field : scan.fields)
        prototype += field.element;
      xml += fmt::format(R"(<vectorChild type="Structure">{}<points type="CompressedVector" fileOffset="{}" )"
                         R"(recordCount="{}"><prototype type="Structure">{}</prototype><codecs type="Vector"/>)"
                         R"(</points></vectorChild>)",
                         scan.elements, physical(section), scan.points.size(), prototype);
    }
    xml += "</data3D></e57Root>\n";
    if (editXml)
      editXml(xml);
    const std::uint64_t xmlStart = content.size();
    content.insert(content.end(), xml.begin(), xml.end());
    content.resize((content.size() + e57::pageContentBytes - 1) / e57::pageContentBytes * e57::pageContentBytes);
    Bytes header;
    for (const char c : std::string("ASTM-E57"))
      header.push_back(static_cast<std::uint8_t>(c));
    appendLittle(header, std::uint32_t{1}), appendLittle(header, std::uint32_t{0});
    for (const std::uint64_t number : {std::uint64_t{content.size() / e57::pageContentBytes * e57::pageBytes},
                                       physical(xmlStart), std::uint64_t{xml.size()}, std::uint64_t{e57::pageBytes}})
      appendLittle(header, number);
    std::ranges::copy(header, content.begin());
    return paged(content);
  }

  static Bytes paged(const Bytes& content) {
    Bytes file;
    for (std::size_t at = 0; at < content.size(); at += e57::pageContentBytes) {
      const ByteSpan page = ByteSpan(content).subspan(at, e57::pageContentBytes);
      file.insert(file.end(), page.begin(), page.end());
      appendBig(file, e57::crc32c(page));
    }
    return file;
  }
};

inline std::vector<TestField> cartesian() {
  return {float64("cartesianX"), float64("cartesianY"), float64("cartesianZ")};
}

inline TestFile fileOf(std::vector<TestField> fields, std::vector<std::vector<double>> points) {
  return {.scans = {{.elements = "", .fields = std::move(fields), .points = std::move(points)}}, .elements = ""};
}

} // namespace imgeo::testing
