#include "import/chunks/chunked_ply.h"

#include "base/error.h"
#include "import/chunks/index_ranks.h"
#include "import/chunks/ply_declaration.h"
#include "import/source_name.h"
#include "import/text/text_scanner.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

namespace {

/// The bytes of a record of an element without lists; nothing for others.
std::optional<std::size_t> recordBytesOf(const PlyElement& element) {
  std::size_t size = 0;
  for (const PlyProperty& property : element.properties) {
    if (property.isList())
      return std::nullopt;
    size += byteSizeOf(property.type);
  }
  return size;
}

} // namespace

ChunkedPly::ChunkedPly(SourceContent content, const std::filesystem::path& scratch, std::uint64_t chunkRecords)
    : ChunkedPlyBase(std::move(content), scratch, chunkRecords) {
  findElements();
  if (faces())
    findFaces();
  else
    findPoints();
}

void ChunkedPly::findElements() {
  std::size_t offset = header().bodyOffset;
  for (const PlyElement& element : header().elements) {
    if (&element == faces())
      break;
    if (&element == &vertices())
      verticesOffset_ = offset, vertexBytes_ = recordBytesOf(element).value_or(0);
    offset = endOf(element, offset);
  }
  setFirstVertex(verticesOffset_);
  facesOffset_ = offset;
  setTrailingBytes(bytes().size() - offset); // unless faces follow
}

/// The end of an element without lists that begins at `offset`.
std::size_t ChunkedPly::endOf(const PlyElement& element, std::size_t offset) const {
  const std::optional<std::size_t> recordBytes = element.count > 0 ? recordBytesOf(element) : 0;
  if (!recordBytes)
    throw Error(
        ErrorKind::unsupported, name_,
        fmt::format("has lists in its elements '{}', and is not read piece by piece", asPrintable(element.name)));
  if (*recordBytes > 0 && element.count > (bytes().size() - offset) / *recordBytes)
    throw Error(ErrorKind::truncated, name_,
                fmt::format("the header promises {} of '{}', {} bytes each, but only {} bytes are left", element.count,
                            asPrintable(element.name), *recordBytes, bytes().size() - offset));
  return *recordBytes > 0 ? offset + *recordBytes * static_cast<std::size_t>(element.count) : offset;
}

/// The header of a file of some vertices and faces. Of other elements it has the name alone, so that the reader of
/// whole files warns of them.
std::string ChunkedPly::pieceHeader(std::uint64_t vertexCount, std::uint64_t faceCount) const {
  std::string text =
      fmt::format("ply\nformat binary_{}_endian 1.0\n", header().encoding == PlyEncoding::bigEndian ? "big" : "little");
  for (const PlyElement& element : header().elements)
    if (&element == &vertices())
      text += declaration(element, vertexCount);
    else if (&element == faces())
      text += declaration(element, faceCount);
    else if (element.name == "face")
      text += declaration(element, 0);
    else if (element.count > 0)
      text += fmt::format("element {} 1\n", element.name);
  return text + "end_header\n";
}

std::uint64_t ChunkedPly::integerAt(const std::uint8_t* from, PlyType type) const {
  std::uint64_t value = 0;
  const std::size_t size = byteSizeOf(type);
  for (std::size_t i = 0; i < size; ++i)
    value = value << 8 | from[header().encoding == PlyEncoding::bigEndian ? i : size - 1 - i];
  const bool isSigned = type == PlyType::int8 || type == PlyType::int16 || type == PlyType::int32;
  const std::uint8_t highest = from[header().encoding == PlyEncoding::bigEndian ? 0 : size - 1];
  if (isSigned && highest >= 0x80)
    return UINT64_MAX; // negative, which no count and no index is
  return value;
}

void ChunkedPly::appendInteger(Bytes& out, std::uint64_t value, PlyType type) const {
  const std::size_t size = byteSizeOf(type);
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t byte = header().encoding == PlyEncoding::bigEndian ? size - 1 - i : i;
    out.push_back(static_cast<std::uint8_t>(value >> (8 * byte)));
  }
}

ChunkedPly::Face ChunkedPly::faceAt(ByteSpan bytes, std::size_t offset, std::uint64_t number) const {
  const auto require = [&](std::uint64_t count, std::size_t size) {
    if (count > (bytes.size() - offset) / size)
      throw Error(ErrorKind::truncated, byteLocation(name_, offset),
                  fmt::format("the file ends within face {} of {}", number + 1, faces()->count));
  };
  Face face;
  for (const PlyProperty& property : faces()->properties) {
    std::uint64_t count = 1;
    if (property.isList()) {
      require(1, byteSizeOf(*property.countType));
      if (!isInteger(*property.countType))
        throw Error(ErrorKind::malformed, name_, "a list of 'face' has a count of a type that has fractions");
      count = integerAt(bytes.data() + offset, *property.countType);
      offset += byteSizeOf(*property.countType);
    }
    require(count, byteSizeOf(property.type));
    if (&property == textureNumber())
      face.texture =
          static_cast<std::uint32_t>(integerAt(bytes.data() + offset, property.type)); // below 0: noPlyTexture
    if (isListOfVertices(property))
      face.corners = count;
    offset += static_cast<std::size_t>(count) * byteSizeOf(property.type);
  }
  face.end = offset;
  return face;
}

void ChunkedPly::findFaces() {
  std::size_t offset = facesOffset_;
  for (std::uint64_t number = 0; number < faces()->count; ++number) {
    const Face face = faceAt(bytes(), offset, number);
    addFace(offset, face.end, face.corners, face.texture);
    offset = face.end;
  }
  endFaces();
  for (const PlyElement* element = faces() + 1; element != header().elements.data() + header().elements.size();
       ++element)
    offset = endOf(*element, offset);
  setTrailingBytes(bytes().size() - offset);
}

void ChunkedPly::visitAllFaces(const VisitFace& visit) const {
  std::size_t offset = facesOffset_;
  for (std::uint64_t number = 0; number < faces()->count; ++number) {
    const Face face = faceAt(bytes(), offset, number);
    visit(offset, face.end, face.texture);
    offset = face.end;
  }
}

void ChunkedPly::findPoints() {
  for (std::uint64_t first = 0; first < vertices().count; first += chunkRecords()) {
    const std::uint64_t records = std::min(chunkRecords(), vertices().count - first);
    const std::size_t offset = verticesOffset_ + vertexBytes_ * static_cast<std::size_t>(first);
    add({offset, offset + vertexBytes_ * static_cast<std::size_t>(records), records, records});
  }
}

/// Calls visit(offset, type) for each index of a vertex in the face at `offset`. Returns its end.
template <typename Visit> std::size_t ChunkedPly::visitIndices(ByteSpan bytes, std::size_t offset, Visit visit) const {
  for (const PlyProperty& property : faces()->properties) {
    std::uint64_t count = 1;
    if (property.isList()) {
      count = integerAt(bytes.data() + offset, *property.countType);
      offset += byteSizeOf(*property.countType);
    }
    for (std::uint64_t i = 0; i < count && isListOfVertices(property); ++i)
      visit(offset + static_cast<std::size_t>(i) * byteSizeOf(property.type), property.type);
    offset += static_cast<std::size_t>(count) * byteSizeOf(property.type);
  }
  return offset;
}

/// Calls visit(offset), which returns the end of the face, for each face of a piece.
template <typename Visit> void ChunkedPly::visitFaces(const Chunk& chunk, const FaceRange& range, Visit visit) const {
  for (std::size_t offset = range.begin; offset < range.end;) {
    const Face face = range.hasOthers ? faceAt(range.bytes, offset, 0) : Face{};
    offset = !range.hasOthers || face.texture == textureOf(chunk) ? visit(offset) : face.end;
  }
}

void ChunkedPly::makeFileOfFaces(Bytes& file, const Chunk& chunk, const FaceRange& range) const {
  const std::uint8_t* from = range.bytes.data();
  std::vector<std::uint32_t> used;
  used.reserve(3 * chunk.records);
  visitFaces(chunk, range, [&](std::size_t face) {
    return visitIndices(range.bytes, face, [&](std::size_t offset, PlyType type) {
      const std::uint64_t index = integerAt(from + offset, type);
      if (index >= vertices().count)
        throw Error(ErrorKind::malformed, byteLocation(name_, offset),
                    index == UINT64_MAX
                        ? fmt::format("a face names a vertex below 0")
                        : fmt::format("vertex {} is named, but there are only {}", index, vertices().count));
      used.push_back(static_cast<std::uint32_t>(index));
    });
  });
  const IndexRanks ranks(std::move(used));
  const std::string header = pieceHeader(ranks.indices().size(), chunk.records);
  file.assign(header.begin(), header.end());
  file.reserve(file.size() + ranks.indices().size() * vertexBytes_ + (range.hasOthers ? 0 : range.end - range.begin));
  for (const std::uint32_t index : ranks.indices()) {
    const std::uint8_t* vertex = bytes().data() + verticesOffset_ + std::size_t{index} * vertexBytes_;
    file.insert(file.end(), vertex, vertex + vertexBytes_);
  }
  visitFaces(chunk, range, [&](std::size_t face) {
    std::size_t copied = face;
    const auto copyTo = [&](std::size_t offset) {
      file.insert(file.end(), from + copied, from + offset);
      copied = offset;
    };
    const std::size_t end = visitIndices(range.bytes, face, [&](std::size_t offset, PlyType type) {
      copyTo(offset);
      appendInteger(file, ranks.of(static_cast<std::uint32_t>(integerAt(from + offset, type))), type);
      copied += byteSizeOf(type);
    });
    copyTo(end);
    return end;
  });
}

void ChunkedPly::makeFileOfPoints(Bytes& file, const Chunk& chunk) const {
  const std::string header = pieceHeader(chunk.records, 0);
  file.assign(header.begin(), header.end());
  const ByteSpan points = bytesOf(chunk);
  file.insert(file.end(), points.begin(), points.end());
}

} // namespace imgeo
