#pragma once
// Reads the vertices and the faces, lines or points of X3D geometry nodes (ISO/IEC 19775-1, clauses 11, 13, 14, 27 and
// 32): those of x3d/corner_runs.h, x3d/sized_nodes.h and x3d/nurbs.h, ElevationGrid and Extrusion.

#include "imgeo/preparation.h"
#include "import/x3d/faces.h"
#include "import/x3d/recordings.h"
#include "import/x3d/source.h"
#include "import/x3d/texture_coordinates.h"

#include <optional>
#include <string_view>

namespace imgeo::x3d {

struct NodeFaces {
  VertexData data;
  Faces faces;
  std::size_t furtherTexCoords = 0;                   ///< sets of texture coordinates that are left out
  std::optional<TexCoordGenerator> texCoordGenerator; ///< of the node's texture coordinates
  bool hasCreaseAngle = false;      ///< the node has a creaseAngle field, or flat faces: an angle of 0
  double defaultCreaseAngle = 0;    ///< radians
  std::optional<double> nurbsError; ///< see Geometry
};

/// Whether readNodeFaces reads nodes of this name.
bool becomesMesh(std::string_view element);

/// Empty for nodes of other names. `kept`, `moving`: see readGeometry. Throws Error{malformed, unsupported} for invalid
/// fields; corners may have indices out of range.
std::optional<NodeFaces> readNodeFaces(const Source& source, pugi::xml_node node, const AttributeChoice& kept,
                                       const MovingVertices* moving);

} // namespace imgeo::x3d
