#include "import/ply/chunks.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <cstring>

namespace imgeo {

namespace {

constexpr std::size_t blockBytes = std::size_t{1} << 18;
constexpr std::uint64_t recordsPerChunk = 1 << 14;

std::uint64_t countLineEnds(std::string_view text) {
  return static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n'));
}

} // namespace

LineIndex::LineIndex(std::string_view text) : text_(text) {
  const std::size_t blockCount = (text.size() + blockBytes - 1) / blockBytes;
  endsBefore_.resize(blockCount + 1);
  parallelFor(blockCount, [&](std::size_t block) {
    endsBefore_[block + 1] = countLineEnds(text.substr(block * blockBytes, blockBytes));
  });
  for (std::size_t block = 0; block < blockCount; ++block)
    endsBefore_[block + 1] += endsBefore_[block];
}

std::uint64_t LineIndex::lineAt(std::size_t offset) const {
  const std::size_t block = offset / blockBytes;
  return endsBefore_[block] + countLineEnds(text_.substr(block * blockBytes, offset % blockBytes));
}

std::size_t LineIndex::beginOf(std::uint64_t line) const {
  if (line == 0)
    return 0;
  if (line > endsBefore_.back())
    return text_.size();
  // The block in which the preceding line ends.
  const auto found = std::lower_bound(endsBefore_.begin(), endsBefore_.end(), line) - 1;
  std::size_t at = static_cast<std::size_t>(found - endsBefore_.begin()) * blockBytes;
  for (std::uint64_t ended = *found; ended < line; ++ended)
    at = text_.find('\n', at) + 1;
  return at;
}

const LineIndex& PlyChunkReader::lines() {
  if (!lines_)
    lines_.emplace(asText(bytes_));
  return *lines_;
}

bool PlyChunkReader::read(AsciiPlyCursor& cursor, const PlyElement& element, PlyContent& content,
                          const ReadPlyElement& read) {
  if (element.count < 2 * recordsPerChunk || element.properties.empty() || element.count > cursor.bytesLeft())
    return false;
  const std::uint64_t first = lines().lineAt(cursor.beginOfLine());
  const std::size_t end = lines().beginOf(first + element.count);
  const std::size_t chunkCount = (element.count + recordsPerChunk - 1) / recordsPerChunk;
  std::vector<PlyContent> chunks(chunkCount);
  std::atomic<bool> isOnePerLine = true;
  parallelFor(chunkCount, [&](std::size_t i) {
    if (!isOnePerLine)
      return;
    const std::uint64_t from = i * recordsPerChunk, to = std::min<std::uint64_t>(element.count, from + recordsPerChunk);
    PlyElement chunk = element;
    chunk.count = to - from;
    const std::size_t chunkEnd = i + 1 == chunkCount ? end : lines_->beginOf(first + to);
    AsciiPlyRecords records(AsciiPlyCursor(bytes_.first(chunkEnd), name_, lines_->beginOf(first + from)));
    try {
      read(records, chunk, chunks[i]);
      if (records.trailingBytes() > 0)
        isOnePerLine = false;
    } catch (const Error&) {
      isOnePerLine = false;
    }
  });
  if (!isOnePerLine)
    return false;
  content.append(chunks);
  cursor.goTo(end);
  return true;
}

} // namespace imgeo
