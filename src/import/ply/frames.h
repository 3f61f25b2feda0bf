#pragma once
// Frames of vertices: PLY files that follow one another, as a program writes them into a pipe.

#include "import/ply/content.h"

#include <functional>
#include <optional>

namespace imgeo {

/// Cuts a stream of bytes into PLY files and reads the vertices of each. A file is read when its last byte has arrived:
/// nothing of the next one is needed. In text files each record is one line. White space between files is skipped.
class PlyFrameReader {
public:
  /// Fills a part of a buffer and returns its size, 0 at the end of the stream. May throw.
  using Source = std::function<std::size_t(std::span<std::uint8_t>)>;

  static constexpr std::size_t maxHeaderBytes = std::size_t{64} << 10;
  static constexpr std::size_t maxFrameBytes = std::size_t{1} << 30;

  explicit PlyFrameReader(Source source) : source_(std::move(source)) {}

  /// Reads the vertices of the next file; nothing at the end of the stream. `name` is that of the file, for messages,
  /// and `kept` the attributes that are kept. Faces and other elements behind the vertices are passed over. Safe for
  /// untrusted bytes. Throws Error (truncated, malformed, unsupported, limit).
  std::optional<PlyContent> next(const std::string& name, const AttributeChoice& kept);

private:
  bool fill();
  void require(std::size_t end, const std::string& name);
  std::size_t endOfLine(std::size_t begin, const std::string& name, std::size_t maxBytes);
  std::size_t endOfElement(std::size_t begin, const PlyElement& element, PlyEncoding encoding, const std::string& name);
  std::size_t endOfRecords(std::size_t begin, const PlyElement& element, PlyEncoding encoding, const std::string& name);

  Source source_;
  Bytes bytes_; ///< of the current file, and behind it what has been read of the next
};

} // namespace imgeo
