#pragma once
// What the elements of a PLY file say, before it becomes a mesh.

#include "import/import.h"
#include "import/ply/header.h"
#include "scene/mesh.h"

#include <string>
#include <vector>

namespace imgeo {

struct PlyContent {
  std::vector<Vec3f> positions; ///< finite
  VertexAttributes attributes;  ///< normals as the file has them; the rest is finite

  std::vector<std::uint32_t> indices; ///< of all polygons, one after the other; all are vertices
  std::vector<std::uint32_t> sizes;   ///< corners of each polygon; empty while all are triangles
  std::vector<Vec2f> cornerTexCoords; ///< per index, finite; or empty
  std::vector<std::uint32_t> edges;   ///< two vertices each

  std::vector<std::string> namedAttributes; ///< that there are, kept or not
  std::vector<std::string> ignored;         ///< "'quality' of 'vertex'", "element 'camera'": in the file's order
  std::uint64_t facesTooSmall = 0;          ///< left out: fewer than three corners
  std::uint64_t colorsClamped = 0;          ///< channels outside their type's range
  std::uint64_t trailingBytes = 0;          ///< behind the last element
  double largestRounding = 0;               ///< of coordinates that were double

  void noteIgnored(const PlyElement& element, const PlyProperty& property);
  /// Appends what has been read of an element in parts, which it gives back part by part.
  void append(std::vector<PlyContent>& parts);

private:
  void append(const PlyContent& part);
};

/// Reads all elements behind `header`. Safe for untrusted bytes; throws Error
/// (truncated, malformed, limit) naming the record and its line or byte.
PlyContent readPlyContent(ByteSpan bytes, const PlyHeader& header, const std::string& name,
                          const AttributeChoice& kept);

} // namespace imgeo
