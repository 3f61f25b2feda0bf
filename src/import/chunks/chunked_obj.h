#pragma once
// Pieces of OBJ files. Since its numbers are text, and its corners name vertices from anywhere in the file, a file is
// read once into arrays on the disk.

#include "base/scratch_array.h"
#include "import/chunks/chunked_source.h"
#include "import/obj/statements.h"

#include <optional>

namespace imgeo {

class ChunkedObj : public ChunkedSource, private ObjSink {
public:
  /// `scratch`: the folder on whose disk the arrays are, or its nearest parent that exists: 36 bytes a triangle, 12 a
  /// vertex, 16 a colour, 8 a pair of texture coordinates, 12 a normal. Throws Error{unsupported} for files of several
  /// objects or materials, or with lines, each of which is a shape, {limit} for more than 2^32 - 1 vertices.
  ChunkedObj(SourceContent content, const std::filesystem::path& scratch, std::uint64_t chunkRecords);

private:
  Imported readChunk(const Chunk& chunk, const ImportOptions& options) const override;
  void addVertex(const Vec3f& position, const Rgba* color) override;
  void addTexCoord(const Vec2f& texCoord) override;
  void addNormal(const Vec3f& normal) override;
  Vec3f positionOf(std::uint32_t index) const override { return positions_[index]; }
  void addTriangle(ObjObject& object, const std::array<ObjCorner, 3>& corners) override;
  void addLine(ObjObject& object, const std::array<ObjCorner, 2>& corners) override;

  void requireFewer(std::size_t count, const char* what) const;
  Mesh trianglesOf(const Chunk& chunk) const;
  Mesh pointsOf(const Chunk& chunk) const;
  /// Adds what is said of the whole file.
  void describe(Imported& imported, const ImportOptions& options) const;

  ScratchArray<Vec3f> positions_, normals_;
  ScratchArray<Vec2f> texCoords_;
  ScratchArray<Rgba> colors_; ///< by position, or empty
  ScratchArray<std::array<ObjCorner, 3>> triangles_;
  std::optional<std::size_t> objectIndex_; ///< of the object that has the triangles; nothing: there are none
  std::string object_, material_;          ///< its name and that of its material
  bool hasTexCoords_ = false, hasNormals_ = true, hasSomeNormals_ = false; ///< any corner, all and any
  std::vector<std::string> libraries_, warnings_;
};

} // namespace imgeo
