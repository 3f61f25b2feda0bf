#include "import/chunks/chunked_text_ply.h"

#include "base/error.h"
#include "import/chunks/index_ranks.h"
#include "import/chunks/ply_declaration.h"
#include "import/ply/cursor.h"
#include "import/ply/ply.h"
#include "import/source_name.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {

namespace {

/// To find a vertex, so many records are passed over at most; the offsets take an eighth of a byte a vertex.
constexpr std::uint64_t verticesAnOffset = 64;

/// Passes over a record. Returns the corners of the face, if it is one.
std::uint64_t passRecord(AsciiPlyCursor& cursor, const PlyElement& element, std::uint64_t number) {
  std::uint64_t corners = 0;
  cursor.beginRecord({&element, number});
  for (const PlyProperty& property : element.properties) {
    std::uint64_t count = 1;
    if (property.isList()) {
      const double stated = cursor.scalar(*property.countType);
      if (!(stated >= 0 && stated <= static_cast<double>(cursor.bytesLeft())))
        cursor.fail(ErrorKind::truncated, fmt::format("a list of {} values is longer than the file", stated));
      count = static_cast<std::uint64_t>(stated);
    }
    cursor.skip(property.type, static_cast<std::size_t>(count));
    if (isListOfVertices(property))
      corners = count;
  }
  cursor.endRecord();
  return corners;
}

} // namespace

ChunkedTextPly::ChunkedTextPly(SourceContent content, std::uint64_t chunkRecords)
    : ChunkedSource(std::move(content)), header_(readPlyHeader(bytes(), name_)) {
  findElements();
  findRecords(chunkRecords);
}

void ChunkedTextPly::findElements() {
  const PlyMeshElements elements = meshElementsOf(header_, name_);
  vertices_ = elements.vertices, faces_ = elements.faces;
  setTopology(elements.topology());
  textures_.emplace(header_, faces_, name_);
  for (const PlyElement& element : header_.elements)
    if (element.count > 0 && &element != vertices_ && &element != faces_)
      throw Error(ErrorKind::unsupported, name_,
                  fmt::format("has elements '{}' beside its vertices and faces, and is not read piece by piece",
                              asPrintable(element.name)));
  for (const PlyProperty& property : vertices_->properties)
    if (property.isList())
      throw Error(ErrorKind::unsupported, name_, "has lists in its vertices, and is not read piece by piece");
}

void ChunkedTextPly::findRecords(std::uint64_t chunkRecords) {
  AsciiPlyCursor cursor(bytes(), name_, header_.bodyOffset);
  for (std::uint64_t number = 0; faces_ && number < vertices_->count; ++number) {
    if (number % verticesAnOffset == 0)
      vertexOffsets_.push_back(cursor.beginOfLine());
    passRecord(cursor, *vertices_, number);
  }
  const PlyElement& records = faces_ ? *faces_ : *vertices_;
  Chunk chunk{cursor.beginOfLine(), cursor.beginOfLine(), 0, 0};
  for (std::uint64_t number = 0; number < records.count; ++number) {
    const std::uint64_t corners = passRecord(cursor, records, number);
    chunk.elements += !faces_ ? 1 : corners >= 3 ? corners - 2 : 0;
    chunk.end = cursor.beginOfLine();
    if (++chunk.records == chunkRecords || number + 1 == records.count) {
      add(chunk);
      chunk = {chunk.end, chunk.end, 0, 0};
    }
  }
  trailingBytes_ = cursor.trailingBytes();
}

std::string_view ChunkedTextPly::text(std::size_t begin, std::size_t end) const {
  return {reinterpret_cast<const char*>(bytes().data()) + begin, end - begin};
}

void ChunkedTextPly::appendVertices(Bytes& file, const std::vector<std::uint32_t>& indices) const {
  AsciiPlyCursor cursor(bytes(), name_, header_.bodyOffset);
  std::uint64_t next = 0;
  bool hasBegun = false;
  for (const std::uint32_t index : indices) {
    if (!hasBegun || index / verticesAnOffset > next / verticesAnOffset) {
      next = index - index % verticesAnOffset;
      cursor.goTo(vertexOffsets_[static_cast<std::size_t>(index / verticesAnOffset)]);
      hasBegun = true;
    }
    for (; next < index; ++next)
      passRecord(cursor, *vertices_, next);
    const std::size_t begin = cursor.beginOfLine();
    passRecord(cursor, *vertices_, next++);
    const std::string_view line = text(begin, cursor.beginOfLine());
    file.insert(file.end(), line.begin(), line.end());
  }
}

/// Makes a file of the faces of a piece and the vertices that they use.
void ChunkedTextPly::makeFileOfFaces(Bytes& file, const Chunk& chunk) const {
  TextScanner scanner(bytes(), name_, chunk.offset);
  struct IndexWord {
    std::size_t begin, end;
    std::uint32_t index;
  };
  std::vector<IndexWord> words;
  std::vector<std::uint32_t> used;
  const auto skipWord = [&] {
    scanner.skipSpace();
    scanner.word();
  };
  for (std::uint64_t face = 0; face < chunk.records; ++face)
    for (const PlyProperty& property : faces_->properties) {
      std::uint64_t count = 1;
      if (property.isList()) {
        scanner.skipSpace();
        count = static_cast<std::uint64_t>(std::max<std::int64_t>(scanner.integerWord("an integer"), 0));
      }
      for (std::uint64_t i = 0; i < count && !scanner.atEnd(); ++i) {
        if (!isListOfVertices(property)) {
          skipWord();
          continue;
        }
        scanner.skipSpace();
        const std::size_t begin = scanner.byteOffset();
        const std::int64_t index = scanner.integerWord("an integer");
        if (index < 0)
          scanner.fail(ErrorKind::malformed, "a face names a vertex below 0");
        if (static_cast<std::uint64_t>(index) >= vertices_->count)
          scanner.fail(ErrorKind::malformed,
                       fmt::format("vertex {} is named, but there are only {}", index, vertices_->count));
        used.push_back(static_cast<std::uint32_t>(index));
        words.push_back({begin, scanner.byteOffset(), used.back()});
      }
    }
  const IndexRanks ranks(std::move(used));
  const std::string header = "ply\nformat ascii 1.0\n" + textures_->comments(chunk.number == 0) +
                             declaration(*vertices_, ranks.indices().size()) + declaration(*faces_, chunk.records) +
                             "end_header\n";
  file.assign(header.begin(), header.end());
  appendVertices(file, ranks.indices());
  std::size_t copied = chunk.offset;
  for (const IndexWord& word : words) {
    const std::string_view between = text(copied, word.begin);
    file.insert(file.end(), between.begin(), between.end());
    fmt::format_to(std::back_inserter(file), "{}", ranks.of(word.index));
    copied = word.end;
  }
  const std::string_view rest = text(copied, chunk.end);
  file.insert(file.end(), rest.begin(), rest.end());
}

Imported ChunkedTextPly::readChunk(const Chunk& chunk, const ImportOptions& options) const {
  Bytes file;
  if (faces_) {
    makeFileOfFaces(file, chunk);
  } else {
    const std::string header = "ply\nformat ascii 1.0\n" + declaration(*vertices_, chunk.records) + "end_header\n";
    file.assign(header.begin(), header.end());
    const ByteSpan points = bytesOf(chunk);
    file.insert(file.end(), points.begin(), points.end());
  }
  Imported imported = readPly(file, name_, options);
  imported.up = header_.up;
  textures_->followFirst(imported, options);
  if (chunk.number == 0)
    warnOfTrailingPlyBytes(imported.warnings, trailingBytes_);
  return imported;
}

} // namespace imgeo
