#include "import/chunks/chunked_text_ply.h"

#include "base/error.h"
#include "import/chunks/index_ranks.h"
#include "import/chunks/ply_declaration.h"
#include "import/ply/cursor.h"
#include "import/source_name.h"
#include "import/text/line_ends.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

namespace {

/// To find a vertex, so many records are passed over at most; the offsets take an eighth of a byte a vertex.
constexpr std::uint64_t verticesAnOffset = 64;

/// What is known of a face that was passed over.
struct PassedFace {
  std::uint64_t corners = 0;
  std::uint32_t texture = noPlyTexture;
};

/// Passes over a record, which is a face if `textureNumber` is one of its properties.
PassedFace passRecord(AsciiPlyCursor& cursor, const PlyElement& element, std::uint64_t number,
                      const PlyProperty* textureNumber = nullptr) {
  PassedFace face;
  cursor.beginRecord({&element, number});
  for (const PlyProperty& property : element.properties) {
    if (&property == textureNumber) {
      face.texture = plyTextureOf(cursor.scalar(property.type));
      continue;
    }
    std::uint64_t count = 1;
    if (property.isList()) {
      const double stated = cursor.scalar(*property.countType);
      if (!(stated >= 0 && stated <= static_cast<double>(cursor.bytesLeft())))
        cursor.fail(ErrorKind::truncated, fmt::format("a list of {} values is longer than the file", stated));
      count = static_cast<std::uint64_t>(stated);
    }
    cursor.skip(property.type, static_cast<std::size_t>(count));
    if (isListOfVertices(property))
      face.corners = count;
  }
  cursor.endRecord();
  return face;
}

} // namespace

ChunkedTextPly::ChunkedTextPly(SourceContent content, const std::filesystem::path& scratch, std::uint64_t chunkRecords)
    : ChunkedPlyBase(std::move(content), scratch, chunkRecords) {
  if (header().hasCarriageReturns)
    failOfCarriageReturns(name_);
  requireRecords();
  setFirstVertex(header().bodyOffset);
  findRecords();
}

void ChunkedTextPly::requireRecords() const {
  for (const PlyElement& element : header().elements)
    if (element.count > 0 && &element != &vertices() && &element != faces())
      throw Error(ErrorKind::unsupported, name_,
                  fmt::format("has elements '{}' beside its vertices and faces, and is not read piece by piece",
                              asPrintable(element.name)));
  for (const PlyProperty& property : vertices().properties)
    if (property.isList())
      throw Error(ErrorKind::unsupported, name_, "has lists in its vertices, and is not read piece by piece");
}

void ChunkedTextPly::findRecords() {
  AsciiPlyCursor cursor(bytes(), name_, header().bodyOffset);
  Chunk points{cursor.beginOfLine(), cursor.beginOfLine(), 0, 0};
  for (std::uint64_t number = 0; number < vertices().count; ++number) {
    if (faces() && number % verticesAnOffset == 0)
      vertexOffsets_.push_back(cursor.beginOfLine());
    passRecord(cursor, vertices(), number);
    points.end = cursor.beginOfLine();
    if (!faces() && (++points.records == chunkRecords() || number + 1 == vertices().count)) {
      points.elements = points.records;
      add(points);
      points = {points.end, points.end, 0, 0};
    }
  }
  facesOffset_ = cursor.beginOfLine();
  for (std::uint64_t number = 0; faces() && number < faces()->count; ++number) {
    const std::size_t begin = cursor.beginOfLine();
    const PassedFace face = passRecord(cursor, *faces(), number, textureNumber());
    addFace(begin, cursor.beginOfLine(), face.corners, face.texture);
  }
  if (faces())
    endFaces();
  setTrailingBytes(cursor.trailingBytes());
}

void ChunkedTextPly::visitAllFaces(const VisitFace& visit) const {
  AsciiPlyCursor cursor(bytes(), name_, header().bodyOffset);
  cursor.goTo(facesOffset_);
  for (std::uint64_t number = 0; number < faces()->count; ++number) {
    const std::size_t begin = cursor.beginOfLine();
    const PassedFace face = passRecord(cursor, *faces(), number, textureNumber());
    visit(begin, cursor.beginOfLine(), face.texture);
  }
}

std::string_view ChunkedTextPly::text(std::size_t begin, std::size_t end) const {
  return {reinterpret_cast<const char*>(bytes().data()) + begin, end - begin};
}

void ChunkedTextPly::appendVertices(Bytes& file, const std::vector<std::uint32_t>& indices) const {
  AsciiPlyCursor cursor(bytes(), name_, header().bodyOffset);
  std::uint64_t next = 0;
  bool hasBegun = false;
  for (const std::uint32_t index : indices) {
    if (!hasBegun || index / verticesAnOffset > next / verticesAnOffset) {
      next = index - index % verticesAnOffset;
      cursor.goTo(vertexOffsets_[static_cast<std::size_t>(index / verticesAnOffset)]);
      hasBegun = true;
    }
    for (; next < index; ++next)
      passRecord(cursor, vertices(), next);
    const std::size_t begin = cursor.beginOfLine();
    passRecord(cursor, vertices(), next++);
    const std::string_view line = text(begin, cursor.beginOfLine());
    file.insert(file.end(), line.begin(), line.end());
  }
}

void ChunkedTextPly::makeFileOfFaces(Bytes& file, const Chunk& chunk, const FaceRange& range) const {
  TextScanner scanner(range.bytes, name_, range.begin);
  struct IndexWord {
    std::size_t begin, end;
    std::uint32_t index;
  };
  struct Face {
    std::size_t begin, end;
    std::size_t words; ///< the end of its words
  };
  std::vector<IndexWord> words;
  std::vector<Face> kept;
  const auto skipWord = [&] {
    scanner.skipSpace();
    scanner.word();
  };
  for (scanner.skipSpace(); !scanner.atEnd() && scanner.byteOffset() < range.end; scanner.skipSpace()) {
    const std::size_t begin = scanner.byteOffset(), firstWord = words.size();
    std::uint32_t texture = noPlyTexture;
    for (const PlyProperty& property : faces()->properties) {
      std::uint64_t count = 1;
      if (property.isList()) {
        scanner.skipSpace();
        count = static_cast<std::uint64_t>(std::max<std::int64_t>(scanner.integerWord("an integer"), 0));
      }
      for (std::uint64_t i = 0; i < count && !scanner.atEnd(); ++i) {
        if (&property == textureNumber()) {
          scanner.skipSpace();
          texture = plyTextureOf(static_cast<double>(scanner.integerWord("an integer")));
          continue;
        }
        if (!isListOfVertices(property)) {
          skipWord();
          continue;
        }
        scanner.skipSpace();
        const std::size_t word = scanner.byteOffset();
        const std::int64_t index = scanner.integerWord("an integer");
        if (index < 0)
          scanner.fail(ErrorKind::malformed, "a face names a vertex below 0");
        if (static_cast<std::uint64_t>(index) >= vertices().count)
          scanner.fail(ErrorKind::malformed,
                       fmt::format("vertex {} is named, but there are only {}", index, vertices().count));
        words.push_back({word, scanner.byteOffset(), static_cast<std::uint32_t>(index)});
      }
    }
    if (!range.hasOthers || texture == textureOf(chunk))
      kept.push_back({begin, scanner.byteOffset(), words.size()});
    else
      words.resize(firstWord);
  }
  std::vector<std::uint32_t> used;
  used.reserve(words.size());
  for (const IndexWord& word : words)
    used.push_back(word.index);
  const IndexRanks ranks(std::move(used));
  const std::string header = "ply\nformat ascii 1.0\n" + declaration(vertices(), ranks.indices().size()) +
                             declaration(*faces(), chunk.records) + "end_header\n";
  file.assign(header.begin(), header.end());
  appendVertices(file, ranks.indices());
  auto word = words.begin();
  const auto append = [&](std::size_t begin, std::size_t end) {
    const ByteSpan between = range.bytes.subspan(begin, end - begin);
    file.insert(file.end(), between.begin(), between.end());
  };
  for (const Face& face : kept) {
    std::size_t copied = face.begin;
    for (; word != words.begin() + static_cast<std::ptrdiff_t>(face.words); ++word) {
      append(copied, word->begin);
      fmt::format_to(std::back_inserter(file), "{}", ranks.of(word->index));
      copied = word->end;
    }
    append(copied, face.end);
    file.push_back('\n');
  }
}

void ChunkedTextPly::makeFileOfPoints(Bytes& file, const Chunk& chunk) const {
  const std::string header = "ply\nformat ascii 1.0\n" + declaration(vertices(), chunk.records) + "end_header\n";
  file.assign(header.begin(), header.end());
  const ByteSpan points = bytesOf(chunk);
  file.insert(file.end(), points.begin(), points.end());
}

} // namespace imgeo
