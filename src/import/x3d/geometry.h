#pragma once
// Turns X3D geometry nodes into meshes (ISO/IEC 19775-1, clauses 11 and 13): IndexedFaceSet, the sets of triangles,
// strips and fans with and without index, ElevationGrid, Extrusion, IndexedLineSet, LineSet, PointSet.

#include "import/x3d/source.h"
#include "scene/mesh.h"

#include <optional>

namespace imgeo::x3d {

struct Geometry {
  Mesh mesh;
  bool solid = true;
  std::size_t fans = 0; ///< concave polygons that were cut as fans
};

/// Whether readGeometry converts nodes of this name.
bool becomesMesh(std::string_view element);

/// Empty for nodes of other names; an empty mesh for a node without faces, lines or points. Throws Error{malformed,
/// unsupported} for invalid fields and indices out of range.
std::optional<Geometry> readGeometry(const Source& source, pugi::xml_node node);

} // namespace imgeo::x3d
