#pragma once
// Pieces of OBJ files. Since its numbers are text, and its corners name vertices from anywhere in the file, a file is
// read once into arrays on the disk.

#include "base/scratch_array.h"
#include "import/chunks/chunked_source.h"
#include "import/obj/statements.h"

#include <map>
#include <memory>
#include <span>
#include <utility>

namespace imgeo {

class ChunkedObj : public ChunkedSource, private ObjSink {
public:
  /// `scratch`: the folder on whose disk the arrays are, or its nearest parent that exists: 36 bytes a triangle, 12 a
  /// vertex, 16 a colour, 8 a pair of texture coordinates, 12 a normal; of several subsets 40 a triangle, and meanwhile
  /// 76. Throws Error{unsupported} for files with lines or with polygons of more than three corners
  /// whose vertices are further down, {limit} for more than 2^32 - 1 vertices.
  ChunkedObj(SourceContent content, const std::filesystem::path& scratch, std::uint64_t chunkRecords);
  Imported readScene(const std::set<std::size_t>& whole, const ImportOptions& options) const override;

private:
  /// The triangles of an object that have one material: a mesh.
  struct Subset {
    ObjObject object;            ///< without its elements
    std::uint64_t first = 0;     ///< of its triangles
    std::uint64_t count = 0;     ///< of triangles
    bool hasTexCoords = false;   ///< of any corner
    bool hasNormals = true;      ///< of all corners
    bool hasSomeNormals = false; ///< of any corner
  };

  Imported readChunk(const Chunk& chunk, const ImportOptions& options) const override;
  using Triangles = ScratchArray<std::array<ObjCorner, 3>>;

  void addVertex(const Vec3f& position, const Rgba* color) override;
  void addTexCoord(const Vec2f& texCoord) override;
  void addNormal(const Vec3f& normal) override;
  Vec3f positionOf(std::uint32_t index) const override { return positions_[index]; }
  void expectVertices() override;
  void addTriangle(ObjObject& object, const std::array<ObjCorner, 3>& corners) override;
  void addLine(ObjObject& object, const std::array<ObjCorner, 2>& corners) override;

  void requireFewer(std::size_t count, const char* what) const;
  void beginSubset(const ObjObject& object);
  /// Orders triangles by subset, and subsets as in `objects`.
  void sortTriangles(std::span<const ObjObject> objects, const std::filesystem::path& scratch);
  Mesh trianglesOf(const Subset& subset, std::uint64_t first, std::uint64_t count) const;
  Mesh pointsOf(std::uint64_t first, std::uint64_t count) const;
  void addPieces(std::uint64_t first, std::uint64_t count, std::uint64_t chunkRecords);

  ScratchArray<Vec3f> positions_, normals_;
  ScratchArray<Vec2f> texCoords_;
  ScratchArray<Rgba> colors_; ///< by position, or empty
  std::unique_ptr<Triangles> triangles_;
  std::vector<Subset> subsets_;          ///< by mesh; empty: the vertices are points
  ScratchArray<std::uint32_t> subsetOf_; ///< by triangle while the file is read, if there are several
  std::size_t current_ = 0;              ///< the subset of the last triangle
  std::map<std::pair<std::size_t, std::string>, std::size_t> subsetNumbers_; ///< by number of the object and material
  std::vector<std::string> libraries_, warnings_;
  Vec3d origin_{0, 0, 0}; ///< what has been subtracted from positions
};

} // namespace imgeo
