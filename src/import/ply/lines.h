#pragma once
// Elements of text files that have one record a line, as programs write them: read
// in parts on all threads.

#include "import/ply/content.h"
#include "import/ply/records.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

/// Where the lines of a text begin. Counts them on all threads.
class LineIndex {
public:
  /// `text` must outlive the index.
  explicit LineIndex(std::string_view text);

  /// How many lines end before a byte.
  std::uint64_t lineAt(std::size_t offset) const;
  /// The byte at which a line begins, counted from 0; the text's size behind the last.
  std::size_t beginOf(std::uint64_t line) const;

private:
  std::string_view text_;
  std::vector<std::uint64_t> endsBefore_; ///< by block: lines that end before it; and all of them
};

using AsciiPlyRecords = PlyRecords<AsciiPlyCursor>;

/// Reads an element's records, or a part of them, into a content of its own.
using ReadPlyElement = std::function<void(AsciiPlyRecords&, const PlyElement&, PlyContent&)>;

/// Reads the text of a PLY file's elements in parts, wherever `read`, which is called
/// for each part from any thread, finds exactly one record on each line.
class PlyLineReader {
public:
  /// `bytes` and `name` must outlive the reader.
  PlyLineReader(ByteSpan bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  /// Reads the records of `element`, which begin at the cursor, and moves it behind them; what it
  /// appends is what `read` would have appended at once. False where they are few, are not one a
  /// line, or have a fault: then nothing has changed, and who reads them in turn finds it.
  bool read(AsciiPlyCursor& cursor, const PlyElement& element, PlyContent& content, const ReadPlyElement& read);

private:
  const LineIndex& lines();

  ByteSpan bytes_;
  const std::string& name_;
  std::optional<LineIndex> lines_;
};

} // namespace imgeo
