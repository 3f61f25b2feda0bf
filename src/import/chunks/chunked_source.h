#pragma once
// Reads a large file of meshes or point clouds piece by piece: each piece is a small file of the same format, which
// the format's own reader reads. Files are mapped, so that memory need not hold them.
//
// Formats: PLY, binary or text, with an element 'vertex', perhaps an element 'face' behind it, and, in binary files, no
// other elements than such as are left out of a file that is read whole, all but 'face' without lists; binary STL; OBJ
// without lines; GLB; LAS; E57; PTS; XYZ; all of them also gzipped.

#include "import/chunks/source_content.h"
#include "import/import.h"

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace imgeo {

class ChunkedMesh;

/// A file whose meshes and point clouds are read in pieces. Each is a shape, or several that show the same.
class ChunkedSource {
public:
  /// Finds where the pieces begin, for which it reads the faces of PLY, OBJ, LAS, PTS, XYZ and text once. Safe for
  /// untrusted bytes. Throws Error{io, truncated, malformed} where the file cannot be read, {unsupported} with a reason
  /// where it is none of the formats above. `scratch`: where gzipped files are unpacked, and OBJ files read into
  /// arrays. `chunkRecords`: faces, or points, of a piece.
  static std::unique_ptr<ChunkedSource> open(const std::filesystem::path& path, const std::filesystem::path& scratch,
                                             std::uint64_t chunkRecords = std::uint64_t{1} << 18);
  virtual ~ChunkedSource() = default;

  std::size_t meshCount() const { return meshes_.size(); }
  ChunkedMesh mesh(std::size_t number) const;
  /// The triangles and points of all meshes.
  std::uint64_t elementCount() const;
  const std::string& name() const { return name_; } ///< the path of the file
  /// The bytes of the file, which may be packed.
  std::uint64_t fileBytes() const { return content_.fileBytes(); }

  /// The scene of the file with the warnings about what is read. Its mesh i is that of a file that is read whole where
  /// i is one of `whole`, and otherwise a part of it.
  virtual Imported readScene(const std::set<std::size_t>& whole, const ImportOptions& options) const;
  /// These meshes alone, in their order, each empty where it is left out, with warnings about them; no nodes.
  virtual Imported readMeshes(const std::set<std::size_t>& meshes, const ImportOptions& options) const;

protected:
  /// A file of one mesh.
  explicit ChunkedSource(SourceContent content, Topology topology = Topology::triangles)
      : content_(std::move(content)), name_(content_.name()) {
    beginMesh(topology);
  }

  struct Chunk {
    std::size_t offset = 0; ///< of its first record in the file
    std::size_t end = 0;
    std::uint64_t records = 0;        ///< faces, facets or points
    std::uint64_t elements = 0;       ///< triangles or points
    std::uint64_t firstElement = 0;   ///< of its mesh; set by add()
    std::size_t mesh = 0, number = 0; ///< its mesh, and its number there; set by add()
  };
  /// The mesh of a piece: see ChunkedMesh.
  virtual Imported readChunk(const Chunk& chunk, const ImportOptions& options) const = 0;

  /// The options with the folder of the file, in which its references are.
  ImportOptions besideFile(ImportOptions options) const;
  ByteSpan bytes() const { return content_.bytes(); }
  ByteSpan bytesOf(const Chunk& chunk) const { return bytes().subspan(chunk.offset, chunk.end - chunk.offset); }
  /// Adds a mesh, of which the pieces follow.
  void beginMesh(Topology topology) { meshes_.push_back({topology, {}, 0}); }
  void removeMeshes() { meshes_.clear(); }
  /// Sets that of the last mesh.
  void setTopology(Topology topology) { meshes_.back().topology = topology; }
  /// Adds a piece to the last mesh.
  void add(const Chunk& chunk) {
    Pieces& mesh = meshes_.back();
    mesh.chunks.push_back(chunk);
    mesh.chunks.back().firstElement = mesh.elements;
    mesh.chunks.back().mesh = meshes_.size() - 1;
    mesh.chunks.back().number = mesh.chunks.size() - 1;
    mesh.elements += chunk.elements;
  }

  SourceContent content_;
  std::string name_;

private:
  friend class ChunkedMesh;

  struct Pieces {
    Topology topology = Topology::triangles;
    std::vector<Chunk> chunks;
    std::uint64_t elements = 0;
  };
  std::vector<Pieces> meshes_;
};

/// A mesh, or a point cloud, of a source, which must outlive it.
class ChunkedMesh {
public:
  const ChunkedSource& source() const { return *source_; }
  std::size_t number() const { return number_; } ///< in the source
  std::size_t chunkCount() const { return pieces().chunks.size(); }
  Topology topology() const { return pieces().topology; } ///< triangles or points
  std::uint64_t elementCount() const { return pieces().elements; }
  /// The triangles or points of a piece. Polygons of n corners are n - 2 triangles.
  std::uint64_t elementsOf(std::size_t chunk) const { return pieces().chunks[chunk].elements; }
  /// The number of a piece's first triangle or point in the mesh.
  std::uint64_t firstElementOf(std::size_t chunk) const { return pieces().chunks[chunk].firstElement; }

  /// A scene of one mesh: that of a piece, which has the triangles or points of the file in their order, and warnings
  /// about what of it is not carried over. Safe to call from any thread.
  Imported read(std::size_t chunk, const ImportOptions& options) const {
    return source_->readChunk(pieces().chunks[chunk], source_->besideFile(options));
  }

private:
  friend class ChunkedSource;
  ChunkedMesh(const ChunkedSource& source, std::size_t number) : source_(&source), number_(number) {}
  const ChunkedSource::Pieces& pieces() const { return source_->meshes_[number_]; }

  const ChunkedSource* source_;
  std::size_t number_;
};

} // namespace imgeo
