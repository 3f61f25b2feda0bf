#include "import/ply/frames.h"

#include "base/error.h"
#include "import/text/line_ends.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

namespace {

constexpr std::size_t readBytes = std::size_t{64} << 10;

bool isSpace(std::uint8_t byte) {
  return byte == ' ' || byte == '\n' || byte == '\r' || byte == '\t';
}

std::uint64_t integerAt(const std::uint8_t* bytes, PlyType type, PlyEncoding encoding) {
  std::uint64_t value = 0;
  const std::size_t size = byteSizeOf(type);
  for (std::size_t i = 0; i < size; ++i)
    value = value << 8 | bytes[encoding == PlyEncoding::littleEndian ? size - 1 - i : i];
  return value;
}

} // namespace

/// Reads more bytes; false at the end of the stream.
bool PlyFrameReader::fill() {
  const std::size_t before = bytes_.size();
  bytes_.resize(before + readBytes);
  const std::size_t count = source_(std::span(bytes_).subspan(before));
  bytes_.resize(before + count);
  return count > 0;
}

/// Reads until there are bytes up to `end`.
void PlyFrameReader::require(std::size_t end, const std::string& name) {
  if (end > maxFrameBytes)
    throw Error(ErrorKind::limit, name, fmt::format("the frame has more than {} bytes", maxFrameBytes));
  while (bytes_.size() < end)
    if (!fill())
      throw Error(ErrorKind::truncated, name,
                  fmt::format("the input ends within the frame, after {} bytes", bytes_.size()));
}

/// Where the next line begins. Throws where this one has more than `maxBytes`.
std::size_t PlyFrameReader::endOfLine(std::size_t begin, const std::string& name, std::size_t maxBytes) {
  for (std::size_t from = begin;;) {
    const auto found = std::find(bytes_.begin() + static_cast<std::ptrdiff_t>(from), bytes_.end(), '\n');
    if (found != bytes_.end())
      return static_cast<std::size_t>(found - bytes_.begin()) + 1;
    from = bytes_.size();
    if (from - begin > maxBytes)
      throw Error(ErrorKind::limit, name, fmt::format("a line has more than {} bytes", maxBytes));
    // The last line of a text file may lack its end.
    if (!fill())
      return bytes_.size();
  }
}

std::size_t PlyFrameReader::endOfElement(std::size_t begin, const PlyElement& element, PlyEncoding encoding,
                                         const std::string& name) {
  if (element.properties.empty())
    return begin;
  if (encoding != PlyEncoding::ascii)
    return endOfRecords(begin, element, encoding, name);
  std::size_t end = begin;
  for (std::uint64_t record = 0; record < element.count;) {
    const std::size_t line = end;
    end = endOfLine(line, name, maxHeaderBytes);
    require(end, name);
    if (end == line)
      throw Error(ErrorKind::truncated, name,
                  fmt::format("the input ends after {} of {} records of '{}'", record, element.count, element.name));
    const auto at = [&](std::size_t offset) { return bytes_.begin() + static_cast<std::ptrdiff_t>(offset); };
    if (!std::all_of(at(line), at(end), isSpace))
      ++record;
  }
  return end;
}

std::size_t PlyFrameReader::endOfRecords(std::size_t begin, const PlyElement& element, PlyEncoding encoding,
                                         const std::string& name) {
  std::size_t fixed = 0;
  for (const PlyProperty& property : element.properties)
    fixed += property.isList() ? 0 : byteSizeOf(property.type);
  if (std::ranges::none_of(element.properties, &PlyProperty::isList)) {
    if (element.count > maxFrameBytes / fixed)
      throw Error(ErrorKind::limit, name, fmt::format("the header promises {} of '{}'", element.count, element.name));
    require(begin + element.count * fixed, name);
    return begin + element.count * fixed;
  }
  std::size_t at = begin;
  for (std::uint64_t record = 0; record < element.count; ++record)
    for (const PlyProperty& property : element.properties) {
      std::uint64_t count = 1;
      if (property.isList()) {
        const std::size_t size = byteSizeOf(*property.countType);
        require(at + size, name);
        count = integerAt(bytes_.data() + at, *property.countType, encoding);
        at += size;
      }
      if (count > maxFrameBytes)
        throw Error(ErrorKind::limit, name, fmt::format("a list of '{}' promises {} values", element.name, count));
      at += count * byteSizeOf(property.type);
      require(at, name);
    }
  return at;
}

std::optional<PlyContent> PlyFrameReader::next(const std::string& name, const AttributeChoice& kept) {
  for (std::size_t spaces = 0;;) {
    spaces = static_cast<std::size_t>(std::find_if_not(bytes_.begin(), bytes_.end(), isSpace) - bytes_.begin());
    bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(spaces));
    if (!bytes_.empty())
      break;
    if (!fill())
      return {};
  }
  std::size_t headerEnd = 0;
  for (bool isInHeader = true; isInHeader;) {
    const std::size_t line = headerEnd;
    headerEnd = endOfLine(line, name, maxHeaderBytes);
    if (headerEnd > maxHeaderBytes)
      throw Error(ErrorKind::limit, name, fmt::format("the header has more than {} bytes", maxHeaderBytes));
    const std::string_view text = asText(ByteSpan(bytes_).subspan(line, headerEnd - line));
    isInHeader = headerEnd > line && !text.starts_with("end_header");
    if (line == 0 && !text.starts_with("ply"))
      throw Error(ErrorKind::malformed, name, "this is no PLY file: it does not begin with \"ply\"");
    if (line == 0 && hasPlyCarriageReturns(text))
      failOfCarriageReturns(name);
  }
  PlyHeader header = readPlyHeader(ByteSpan(bytes_).first(headerEnd), name);
  std::size_t end = header.bodyOffset;
  for (const PlyElement& element : header.elements)
    end = endOfElement(end, element, header.encoding, name);
  // What stands behind the vertices need not be read.
  const auto vertices = std::ranges::find(header.elements, "vertex", &PlyElement::name);
  if (vertices != header.elements.end())
    header.elements.erase(vertices + 1, header.elements.end());
  PlyContent content = readPlyContent(ByteSpan(bytes_).first(end), header, name, kept, Vec3d{0, 0, 0});
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(end));
  return content;
}

} // namespace imgeo
