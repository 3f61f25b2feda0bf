#pragma once
// What the elements of a PLY file say, before it becomes a mesh.

#include "import/ply_header.h"
#include "scene/mesh.h"

#include <string>
#include <vector>

namespace imgeo {

struct PlyContent {
  bool hasVertices = false, hasFaces = false; ///< the header names the element
  std::vector<Vec3f> positions;               ///< finite
  std::vector<Vec3f> normals;                 ///< per vertex, as the file has them; or empty
  std::vector<Vec2f> texCoords;               ///< per vertex, or empty
  std::vector<Rgba8> colors;                  ///< per vertex, or empty
  bool hasAlpha = false;                      ///< some alpha is below 255

  std::vector<std::uint32_t> indices; ///< of all polygons, one after the other; all are vertices
  std::vector<std::uint32_t> sizes;   ///< corners of each polygon; empty while all are triangles
  std::vector<Vec2f> cornerTexCoords; ///< per index, or empty
  std::vector<std::string> ignored;   ///< "quality of vertex", "edge": in the file's order
  std::uint64_t facesTooSmall = 0;    ///< left out: fewer than three corners
  double largestRounding = 0;         ///< of coordinates that were double
};

/// Reads all elements behind `header`. Safe for untrusted bytes; throws Error
/// (truncated, malformed, limit) naming the record and its line or byte.
PlyContent readPlyContent(ByteSpan bytes, const PlyHeader& header, const std::string& name);

} // namespace imgeo
