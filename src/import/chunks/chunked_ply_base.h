#pragma once
// What pieces of binary and of text PLY files have in common. Faces of each texture are a mesh of their own, whose
// pieces leave out what is between them in the file. Where that is much, faces are copied to the disk in the order of
// their textures.

#include "base/scratch_file.h"
#include "import/chunks/chunked_source.h"
#include "import/ply/header.h"
#include "import/ply/textures.h"

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

namespace imgeo {

class ChunkedPlyBase : public ChunkedSource {
public:
  Imported readScene(const std::set<std::size_t>& whole, const ImportOptions& options) const override;

protected:
  /// Finds the elements. `scratch`: the folder on whose disk faces may be copied, or its nearest parent that exists.
  /// `chunkRecords`: faces, or points, of a piece.
  ChunkedPlyBase(SourceContent content, std::filesystem::path scratch, std::uint64_t chunkRecords);

  /// Bytes in which the faces of a piece are.
  struct FaceRange {
    ByteSpan bytes; ///< the file, or faces in the order of their textures
    std::size_t begin = 0, end = 0;
    bool hasOthers = false; ///< whether faces of other textures are between them
  };
  using VisitFace = std::function<void(std::size_t begin, std::size_t end, std::uint32_t texture)>;

  const PlyHeader& header() const { return header_; }
  const PlyElement& vertices() const { return *vertices_; }
  const PlyElement* faces() const { return faces_; } ///< nullptr: the vertices are points
  std::uint64_t chunkRecords() const { return chunkRecords_; }
  /// Chooses the origin of all pieces from the first vertex, which begins at a byte of the file.
  void setFirstVertex(std::size_t offset);
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
  /// Makes meshes of all faces, and copies them where those of different textures alternate. Throws Error{io}.
  void endFaces();
  /// Calls visit() for all faces of the file, which have been added before.
  virtual void visitAllFaces(const VisitFace& visit) const = 0;

  /// Makes a file of points, without comments.
  virtual void makeFileOfPoints(Bytes& file, const Chunk& chunk) const = 0;
  /// Makes a file of the faces of a piece and the vertices that they use, without comments.
  virtual void makeFileOfFaces(Bytes& file, const Chunk& chunk, const FaceRange& range) const = 0;

private:
  /// Faces of one texture.
  struct Part {
    std::uint32_t texture = noPlyTexture;
    std::vector<Chunk> chunks;
    std::optional<Chunk> first; ///< its first face that has triangles
    std::uint64_t elements = 0;
    std::size_t bytes = 0;           ///< of its faces
    std::vector<std::size_t> copies; ///< where the faces of each piece begin in `copiedFaces_`, and the end
    std::size_t copyOfFirst = 0;
  };

  void makeFile(Bytes& file, const Chunk& chunk) const;
  bool alternate() const;
  void copyFaces();
  FaceRange copyOf(const Chunk& chunk) const;

  Imported readChunk(const Chunk& chunk, const ImportOptions& options) const override;
  Imported readPiece(const Chunk& chunk, const ImportOptions& options) const;
  Chunk wholeOf(std::size_t mesh) const;
  bool isReadable(std::uint32_t texture, const ImportOptions& options) const;

  PlyHeader header_;
  const PlyElement* vertices_ = nullptr;
  const PlyElement* faces_ = nullptr;
  std::filesystem::path scratch_;
  std::uint64_t chunkRecords_;
  std::unique_ptr<ScratchFile> copiedFaces_; ///< in the order of their textures, where they alternate
  Vec3d origin_{0, 0, 0};                    ///< what is subtracted from positions
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
