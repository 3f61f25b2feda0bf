#pragma once
// The objects of an OBJ file, whose vertices are numbered through the whole
// file, and the mesh of each.

#include "scene/mesh.h"

#include <compare>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace imgeo {

struct ObjCorner {
  static constexpr std::uint32_t kNone = 0xffffffff;
  std::uint32_t position = 0, texCoord = kNone, normal = kNone;
  friend auto operator<=>(const ObjCorner&, const ObjCorner&) = default;
};

/// An object, or the part of it that has one material.
struct ObjObject {
  std::string name;
  std::string material;             ///< empty: none
  std::size_t number = 0;           ///< of the object in the file
  std::vector<ObjCorner> triangles; ///< three corners each
  std::vector<ObjCorner> lines;     ///< two corners each
};

struct ObjContent {
  std::vector<Vec3f> positions; ///< finite
  std::vector<Vec3f> normals;   ///< unit length
  std::vector<Vec2f> texCoords;
  std::vector<Rgba8> colors; ///< per position, or empty
  std::vector<ObjObject> objects;
};

/// Makes meshes of objects one after the other.
class ObjMeshBuilder {
public:
  explicit ObjMeshBuilder(const ObjContent& content);

  /// The triangles or the lines of an object. Each combination of position, texture
  /// coordinate and normal becomes a wedge. A file's only mesh keeps all positions
  /// in the file's order; of several, each takes those that it names, in the order
  /// of their first use. Normals are kept where every corner has one, texture
  /// coordinates where any has.
  Mesh build(const ObjObject& object, Topology topology);

  std::size_t partlyNormals = 0; ///< objects whose normals were left out: some corners have none

private:
  void addAllPositions(Mesh& mesh);
  std::uint32_t wedge(Mesh& mesh, const ObjCorner& corner);

  const ObjContent& content_;
  std::vector<std::uint32_t> localPosition_; ///< by the file's; kNone: not in this mesh
  bool isOnlyMesh_ = false, hasTexCoords_ = false, hasNormals_ = false;
  std::vector<std::uint32_t> firstWedge_, nextWedge_; ///< the wedges of each local position, as a list
  std::vector<ObjCorner> wedgeKeys_;
  /// Of positions that have many: those beyond their lists, which would take a time that grows with the
  /// square.
  std::map<ObjCorner, std::uint32_t> crowded_;
};

} // namespace imgeo
