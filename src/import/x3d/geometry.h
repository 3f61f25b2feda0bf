#pragma once
// X3D's geometry nodes that are moved into containers -> meshes (ISO/IEC 19775-1,
// clauses 11 and 13): IndexedFaceSet, the sets of triangles, strips and fans with
// and without index, ElevationGrid, Extrusion, IndexedLineSet, LineSet, PointSet.

#include "import/x3d/source.h"
#include "scene/mesh.h"

#include <optional>

namespace imgeo::x3d {

struct Geometry {
  Mesh mesh;
  bool solid = true;
  std::size_t fans = 0; ///< concave polygons that were cut as fans
};

/// Whether it is one of these.
bool becomesMesh(std::string_view element);

/// Nothing for every other node; an empty mesh for a node without elements. Throws
/// Error{malformed, unsupported} for one that names values which it lacks.
std::optional<Geometry> readGeometry(const Source& source, pugi::xml_node node);

} // namespace imgeo::x3d
