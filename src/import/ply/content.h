#pragma once
// The data of a PLY file before conversion to meshes.

#include "import/import.h"
#include "import/ply/header.h"
#include "scene/mesh.h"

#include <optional>
#include <string>
#include <vector>

namespace imgeo {

struct PlyContent {
  std::vector<Vec3f> positions; ///< finite
  VertexAttributes attributes;  ///< normals not normalised; all other values are finite

  std::vector<std::uint32_t> indices;  ///< vertex indices of all polygons in order; in range
  std::vector<std::uint32_t> sizes;    ///< corner count of each polygon; empty while all are 3
  std::vector<Vec2f> cornerTexCoords;  ///< per index, finite; or empty
  std::vector<std::uint32_t> textures; ///< 'texnumber' of each polygon, noPlyTexture without; or empty
  std::vector<std::uint32_t> edges;    ///< two vertex indices each

  std::vector<std::string> namedAttributes; ///< names of further attributes, kept or not
  std::vector<std::string> ignored;         ///< "'quality' of 'vertex'", "element 'camera'": in the file's order
  std::uint64_t facesTooSmall = 0;          ///< left out: fewer than three corners
  std::uint64_t colorsClamped = 0;          ///< colour channels outside the range of their type
  std::uint64_t trailingBytes = 0;          ///< after the last element
  Vec3d origin{0, 0, 0};                    ///< what has been subtracted from positions
  double maxRounding = 0;                   ///< the largest rounding error of double-precision coordinates

  std::size_t polygonCount() const { return sizes.empty() ? indices.size() / 3 : sizes.size(); }
  void noteIgnored(const PlyElement& element, const PlyProperty& property);
  /// Appends an element that was read in chunks, and frees each chunk.
  void append(std::vector<PlyContent>& chunks);

private:
  void append(const PlyContent& chunk);
};

/// Reads all elements after `header`. Safe for untrusted bytes; throws Error (truncated, malformed, limit) naming the
/// record and its line or byte.
/// `origin`: see ImportOptions.
PlyContent readPlyContent(ByteSpan bytes, const PlyHeader& header, const std::string& name, const AttributeChoice& kept,
                          const std::optional<Vec3d>& origin);

/// What readPlyContent() subtracts by default from the positions of a file whose first vertex begins at `offset`.
Vec3d plyOriginOf(ByteSpan bytes, const PlyHeader& header, std::size_t offset, const std::string& name);

} // namespace imgeo
