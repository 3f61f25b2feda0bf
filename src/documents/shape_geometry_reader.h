#pragma once
// Reads the geometries of Shapes: each is read once, whichever Shapes USE it or refer to its patches.

#include "containers/geometry_description.h"
#include "documents/documents.h"
#include "documents/field_reader.h"
#include "scene/scene.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace imgeo {

class ShapeGeometryReader {
public:
  /// Appends to `geometries`. All arguments must outlive this.
  ShapeGeometryReader(const DocumentText& source, std::vector<GeometryDescription>& geometries,
                      DocumentWarnings& warnings, const ReadNodeGeometry& readNode)
      : source_(source), geometries_(geometries), warnings_(warnings), readNode_(readNode) {}

  /// Whether files may hold the geometry of a node; warns of one that they cannot hold.
  bool isInFiles(const FieldReader& fields);

  /// Reads the geometry node of a Shape, or finds the one that it USEs. Returns a Shape with its mesh, an index of
  /// `geometries`, and its field `solid`. Throws Error{malformed} for a USE of an unknown name.
  Shape read(const FieldReader& shape, const FieldReader& fields);

  /// A geometry that the document has as numbers.
  struct InDocument {
    std::optional<Shape> shape; ///< nothing: it draws nothing
  };

  /// Reads such a geometry, or the one that the element USEs. Empty where that cannot be read.
  std::optional<InDocument> readInDocument(const FieldReader& fields);

  /// Reads a geometry node outside of any Shape, to whose patches Shapes refer. Throws Error{unsupported} unless it is
  /// one of compact with one patch.
  void readShared(const FieldReader& fields);

  /// The same as read() of the geometry that the field `patch` of a Shape names: "DEF#N".
  Shape sharedPatch(const FieldReader& shape, const std::string& patch);

  /// Whether the triangles of a mesh are not lit (`lit="false"`, X3DOM).
  bool isUnlit(std::size_t mesh) const { return isUnlit_[mesh]; }

  /// Whether a mesh is its own only patch, has no DEF, and differs from the mesh `first` in nothing but the patch.
  bool isPatchLike(std::size_t mesh, std::size_t first) const;

  /// Moves the patches of all meshes behind `first`, which are the last ones, to `first`, whose box becomes `box`.
  void joinPatches(std::size_t first, const Box3d& box);

private:
  struct SharedGeometry {
    GeometryDescription geometry; ///< with patch 0
    bool solid = true;
    std::map<std::uint32_t, std::size_t> meshes; ///< patch index -> index of the geometry
  };

  const DocumentText& source_;
  std::vector<GeometryDescription>& geometries_;
  DocumentWarnings& warnings_;
  const ReadNodeGeometry& readNode_;
  std::vector<bool> isJoinable_; ///< by geometry: it is its own only patch, and has no DEF
  std::vector<bool> isUnlit_;    ///< by geometry: its triangles are not lit
  std::map<std::string, Shape> defined_;
  std::set<std::string> notInFiles_; ///< DEFs
  /// By the offset of a node in the text: see readInDocument().
  std::map<std::size_t, std::optional<InDocument>> inDocument_;
  std::map<std::string, SharedGeometry> shared_; ///< by DEF
};

} // namespace imgeo
