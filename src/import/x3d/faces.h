#pragma once
// Polygons, lines or points whose corners name a value of each kind -> Mesh.

#include "scene/mesh.h"

#include <cstdint>
#include <vector>

namespace imgeo::x3d {

inline constexpr std::uint32_t none = 0xffffffff;

struct VertexData {
  std::vector<Vec3f> positions, normals;
  std::vector<Vec2f> texCoords;
  std::vector<Rgba8> colors;
  std::uint32_t colorComponents = 3;
};

/// Indices into VertexData; either all corners have an attribute or none has.
struct Corner {
  std::uint32_t position = none, normal = none, texCoord = none, color = none;
  friend bool operator==(const Corner&, const Corner&) = default;
};

struct Faces {
  Topology topology = Topology::triangles;
  std::vector<Corner> corners;
  std::vector<std::size_t> ends; ///< of each face among the corners; lines and points have as many as they need
};

/// Normals for faces without: each corner has the mean of the faces around its
/// position that are turned from its own by no more than `creaseAngle`, in radians.
void addCreasedNormals(VertexData& data, Faces& faces, double creaseAngle);

/// Each combination of values that a corner names becomes a wedge; polygons are cut
/// into triangles. `fans` counts concave polygons that were too large for that.
Mesh meshOf(const VertexData& data, const Faces& faces, std::size_t& fans);

} // namespace imgeo::x3d
