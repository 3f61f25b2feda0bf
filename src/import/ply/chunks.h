#pragma once
// Reads elements of PLY text files in parallel chunks where every line holds one record, as in most files.

#include "import/ply/content.h"
#include "import/ply/records.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

/// Finds the lines of a text by number. Counts line ends on all threads.
class LineIndex {
public:
  /// `text` must outlive the index.
  explicit LineIndex(std::string_view text);

  /// The number of lines that end before a byte.
  std::uint64_t lineAt(std::size_t offset) const;
  /// The byte at which a line (counted from 0) begins; the text's size for lines after the last.
  std::size_t beginOf(std::uint64_t line) const;

private:
  std::string_view text_;
  std::vector<std::uint64_t> endsBefore_; ///< lines that end before each block; the last entry counts all
};

using AsciiPlyRecords = PlyRecords<AsciiPlyCursor>;

/// Reads a chunk of an element's records into a content of its own.
using ReadPlyElement = std::function<void(AsciiPlyRecords&, const PlyElement&, PlyContent&)>;

/// Reads elements of a PLY text file in chunks on all threads, where every line holds exactly one record.
class PlyChunkReader {
public:
  /// `bytes` and `name` must outlive the reader.
  PlyChunkReader(ByteSpan bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  /// Reads the records of `element`, which begin at the cursor, by calling `read` for each chunk on any thread. Appends
  /// what one call of `read` for all records would append, and moves the cursor after them. Returns false, with
  /// nothing changed, where the records are few, are not one a line, or contain an error; the caller then reads them
  /// serially and reports the error.
  bool read(AsciiPlyCursor& cursor, const PlyElement& element, PlyContent& content, const ReadPlyElement& read);

private:
  const LineIndex& lines();

  ByteSpan bytes_;
  const std::string& name_;
  std::optional<LineIndex> lines_;
};

} // namespace imgeo
