#pragma once
// Turns the geometry nodes of x3d/node_faces.h into meshes.

#include "imgeo/preparation.h"
#include "import/x3d/recordings.h"
#include "import/x3d/source.h"
#include "scene/mesh.h"

#include <optional>

namespace imgeo::x3d {

struct Geometry {
  Mesh mesh;
  bool solid = true;
  std::size_t fans = 0; ///< concave polygons that were cut as fans
  /// Largest measured distance between a NURBS node and the mesh, relative to the diagonal of its control points' box.
  std::optional<double> nurbsError;
  std::size_t furtherTexCoords = 0;                 ///< sets of texture coordinates after the first, which are left out
  std::vector<std::uint32_t> points, normalNumbers; ///< by wedge, of vertices that move: numbers of their values
  std::optional<double> creaseAngle; ///< of vertices that move, where normals follow their faces; radians
  std::string approximatedTexCoords; ///< the mode of a TextureCoordinateGenerator that is approximated; else empty
};

/// Empty for nodes of other names; an empty mesh for a node without faces, lines or points. Of a MultiTextureCoordinate
/// it reads the first set, and those of the others whose name is in `kept`; the depths of a FogCoordinate become the
/// attribute fogDepthName, if that is in `kept`. Polygons without texture coordinates that a Shape shows with a texture
/// get X3D's default ones. With `moving` it has the positions and normals of their first keys,
/// and wedges that stay apart when the vertices move. Throws Error{malformed, unsupported} for invalid fields and
/// indices out of range.
std::optional<Geometry> readGeometry(const Source& source, pugi::xml_node node, const AttributeChoice& kept,
                                     const MovingVertices* moving = nullptr);

} // namespace imgeo::x3d
