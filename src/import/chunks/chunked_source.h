#pragma once
// Reads a large file of a mesh or a point cloud piece by piece: each piece is a small file of the same format, which
// the format's own reader reads. Files are mapped, so that memory need not hold them.
//
// Formats: PLY, binary or text, with an element 'vertex', perhaps an element 'face' behind it, and, in binary files, no
// other elements than such as are left out of a file that is read whole, all but 'face' without lists; binary STL; OBJ
// of one object and material; GLB of one primitive; LAS; E57 and PTS of one scan; all of them also gzipped.

#include "import/chunks/source_content.h"
#include "import/import.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace imgeo {

/// A file whose triangles, or points, are read in pieces.
class ChunkedSource {
public:
  /// Finds where the pieces begin, for which it reads the faces of PLY, OBJ, LAS, PTS and text once. Safe for untrusted
  /// bytes. Throws Error{io, truncated, malformed} where the file cannot be read, {unsupported} with a reason where it
  /// is none of the formats above. `scratch`: where gzipped files are unpacked, and OBJ files read into
  /// arrays. `chunkRecords`: faces, or points, of a
  /// piece.
  static std::unique_ptr<ChunkedSource> open(const std::filesystem::path& path, const std::filesystem::path& scratch,
                                             std::uint64_t chunkRecords = std::uint64_t{1} << 18);
  virtual ~ChunkedSource() = default;

  std::size_t chunkCount() const { return chunks_.size(); }
  Topology topology() const { return topology_; } ///< triangles or points
  /// The triangles or points of a piece. Polygons of n corners are n - 2 triangles.
  std::uint64_t elementsOf(std::size_t chunk) const { return chunks_[chunk].elements; }
  std::uint64_t elementCount() const { return elementCount_; }
  /// The number of a piece's first triangle or point in the file.
  std::uint64_t firstElementOf(std::size_t chunk) const { return chunks_[chunk].firstElement; }
  const std::string& name() const { return name_; } ///< the path of the file
  /// The bytes of the file, which may be packed.
  std::uint64_t fileBytes() const { return content_.fileBytes(); }

  /// The mesh of a piece, which has the triangles or points of the file in their order, and warnings about what of it
  /// is not carried over. Safe to call from any thread.
  virtual Imported read(std::size_t chunk, const ImportOptions& options) const = 0;

protected:
  explicit ChunkedSource(SourceContent content, Topology topology = Topology::triangles)
      : content_(std::move(content)), name_(content_.name()), topology_(topology) {}

  struct Chunk {
    std::size_t offset = 0; ///< of its first record in the file
    std::size_t end = 0;
    std::uint64_t records = 0;      ///< faces, facets or points
    std::uint64_t elements = 0;     ///< triangles or points
    std::uint64_t firstElement = 0; ///< set by add()
  };
  ByteSpan bytes() const { return content_.bytes(); }
  ByteSpan bytesOf(const Chunk& chunk) const { return bytes().subspan(chunk.offset, chunk.end - chunk.offset); }
  void add(const Chunk& chunk) {
    chunks_.push_back(chunk);
    chunks_.back().firstElement = elementCount_;
    elementCount_ += chunk.elements;
  }

  SourceContent content_;
  std::string name_;
  Topology topology_;
  std::vector<Chunk> chunks_;
  std::uint64_t elementCount_ = 0;
};

} // namespace imgeo
