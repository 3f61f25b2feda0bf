#pragma once
// What pieces of binary and of text PLY files have in common. Faces of each texture are a mesh of their own, whose
// pieces leave out what is between them in the file.

#include "import/chunks/chunked_source.h"
#include "import/ply/header.h"
#include "import/ply/textures.h"

#include <map>
#include <mutex>
#include <optional>

namespace imgeo {

class ChunkedPlyBase : public ChunkedSource {
public:
  Imported readScene(const std::set<std::size_t>& whole, const ImportOptions& options) const override;

protected:
  /// Finds the elements. `chunkRecords`: faces, or points, of a piece.
  ChunkedPlyBase(SourceContent content, std::uint64_t chunkRecords);

  const PlyHeader& header() const { return header_; }
  const PlyElement& vertices() const { return *vertices_; }
  const PlyElement* faces() const { return faces_; } ///< nullptr: the vertices are points
  std::uint64_t chunkRecords() const { return chunkRecords_; }
  void setTrailingBytes(std::size_t bytes) { trailingBytes_ = bytes; } ///< behind the last element

  /// The property of faces that says which texture they have; nullptr: all have the same or none.
  const PlyProperty* textureNumber() const { return textureNumber_; }
  /// The texture of the faces of a piece, where there is such a property.
  std::uint32_t textureOf(const Chunk& chunk) const {
    return parts_.empty() ? noPlyTexture : parts_[chunk.mesh].texture;
  }
  /// Adds a face of the file, in their order. `texture`: its textureNumber(), noPlyTexture without that. Throws
  /// Error{unsupported} where there are more textures than are read piece by piece.
  void addFace(std::size_t begin, std::size_t end, std::uint64_t corners, std::uint32_t texture);
  /// Makes meshes of all faces.
  void endFaces();

  /// Makes a file of the faces of a piece and the vertices that they use, or of points, without comments.
  virtual void makeFile(Bytes& file, const Chunk& chunk) const = 0;

private:
  /// Faces of one texture.
  struct Part {
    std::uint32_t texture = noPlyTexture;
    std::vector<Chunk> chunks;
    std::optional<Chunk> first; ///< its first face that has triangles
    std::uint64_t elements = 0;
  };

  Imported readChunk(const Chunk& chunk, const ImportOptions& options) const override;
  Imported readPiece(const Chunk& chunk, const ImportOptions& options) const;
  Chunk wholeOf(std::size_t mesh) const;
  bool isReadable(std::uint32_t texture, const ImportOptions& options) const;

  PlyHeader header_;
  const PlyElement* vertices_ = nullptr;
  const PlyElement* faces_ = nullptr;
  std::uint64_t chunkRecords_;
  std::size_t trailingBytes_ = 0;
  bool hasTextures_ = false; ///< images that faces have
  const PlyProperty* textureNumber_ = nullptr;
  std::map<std::uint32_t, Part> partsByTexture_; ///< while faces are added; noPlyTexture is the largest number
  Part* lastPart_ = nullptr;
  std::vector<Part> parts_; ///< by mesh
  mutable std::mutex mutex_;
  mutable std::map<std::uint32_t, bool> isReadable_; ///< by texture
};

} // namespace imgeo
