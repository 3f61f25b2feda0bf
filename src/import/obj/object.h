#pragma once
// The content of an OBJ file, whose indices count through the whole file, and its conversion to one mesh per object.

#include "scene/mesh.h"

#include <compare>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace imgeo {

struct ObjCorner {
  static constexpr std::uint32_t none = 0xffffffff;
  std::uint32_t position = 0, texCoord = none, normal = none;
  friend auto operator<=>(const ObjCorner&, const ObjCorner&) = default;
};

/// An object, or the subset of its elements that has one material.
struct ObjObject {
  std::string name;
  std::string material;             ///< empty: none
  std::size_t index = 0;            ///< the object's index in the file; subsets share it
  std::vector<ObjCorner> triangles; ///< three corners each
  std::vector<ObjCorner> lines;     ///< two corners each
};

struct ObjContent {
  std::vector<Vec3f> positions; ///< finite
  std::vector<Vec3f> normals;   ///< unit length
  std::vector<Vec2f> texCoords;
  std::vector<Rgba> colors; ///< per position, or empty
  std::vector<ObjObject> objects;
};

/// Converts objects to meshes.
class ObjMeshBuilder {
public:
  explicit ObjMeshBuilder(const ObjContent& content);

  /// A mesh of the triangles or of the lines of an object. Each combination of position, texture coordinate and normal
  /// becomes a wedge. If the file gives one mesh, it keeps all positions in the file's order; otherwise each mesh has
  /// the positions that it uses, in the order of first use. Normals are kept where every corner has one, texture
  /// coordinates where any corner has one.
  Mesh build(const ObjObject& object, Topology topology);

  std::size_t objectsWithPartialNormals = 0; ///< some corners have no normal, so the others were left out too

private:
  void addAllPositions(Mesh& mesh);
  std::uint32_t findOrAddWedge(Mesh& mesh, const ObjCorner& corner);

  const ObjContent& content_;
  std::vector<std::uint32_t> localPosition_; ///< index in the mesh by position of the file; none: not in the mesh yet
  bool isOnlyMesh_ = false, hasTexCoords_ = false, hasNormals_ = false;
  std::vector<std::uint32_t> firstWedge_, nextWedge_; ///< linked lists of the wedges of each local position
  std::vector<ObjCorner> wedgeKeys_;                  ///< by wedge; the position is local
  /// Wedges beyond the maximum list length, of positions with many wedges; keeps the search from taking quadratic time.
  std::map<ObjCorner, std::uint32_t> overflowWedges_;
};

} // namespace imgeo
