#pragma once
// Turns polygons, lines or points with separate indices for each attribute into a Mesh.

#include "scene/mesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace imgeo::x3d {

inline constexpr std::uint32_t none = 0xffffffff;

struct VertexData {
  std::vector<Vec3f> positions, normals;
  std::vector<Vec2f> texCoords;
  std::vector<std::vector<Vec2f>> furtherTexCoords; ///< sets beside the first, with the same indices
  std::vector<std::string> texCoordMappings;        ///< names of all sets; empty for a single one
  std::vector<Rgba> colors;
  std::uint32_t colorComponents = 3;
  /// By position; the last values are those of all further positions too.
  std::vector<NamedAttribute> pointAttributes;
};

/// Indices into VertexData. Either all corners have an attribute or none has.
struct Corner {
  std::uint32_t position = none, normal = none, texCoord = none, color = none;
  friend bool operator==(const Corner&, const Corner&) = default;
};

struct Faces {
  Topology topology = Topology::triangles;
  std::vector<Corner> corners;
  std::vector<std::size_t> ends; ///< the end of each face among the corners; unused for lines and points
};

/// Replaces polylines by single lines.
void breakIntoLines(Faces& faces);

/// Each face around a position is compared with each other one: TypeScript has the same limit
/// (web/src/tessellate/creasedNormals.ts).
inline constexpr std::size_t maxComparedFaces = 1024;

/// Adds normals by crease angle: the normal of a corner is the normalised sum of the unit normals of those faces around
/// its position whose normals differ from its own face's by at most `creaseAngle` radians; where more than
/// `maxComparedFaces` meet, that of its own face, unless the angle is pi or more. Faces without area add nothing; a
/// corner whose sum is zero gets (0, 0, 1).
/// web/src/tessellate/creasedNormals.ts gives the same; vectors/tessellation/creaseNormals.json tests both.
void addCreaseNormals(VertexData& data, Faces& faces, double creaseAngle);

/// Each distinct combination of indices becomes a wedge; polygons are triangulated. Adds to `fans` the number of
/// concave polygons that became fans because they are too large, and to `wedges`, if given, the indices of each wedge.
Mesh meshOf(const VertexData& data, const Faces& faces, std::size_t& fans, std::vector<Corner>* wedges = nullptr);

} // namespace imgeo::x3d
