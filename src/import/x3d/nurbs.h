#pragma once
// Reads X3D's NURBS nodes (ISO/IEC 19775-1, clause 27) and turns them into polylines and triangles: NurbsCurve,
// NurbsPatchSurface, NurbsTrimmedSurface, NurbsSweptSurface and NurbsSwungSurface.

#include "import/x3d/faces.h"
#include "import/x3d/source.h"

#include <string_view>

namespace imgeo::x3d {

bool isNurbs(std::string_view element);

/// Appends the vertices and the faces or lines of a node for which isNurbs holds. Patches have normals and texture
/// coordinates; swept and swung surfaces have texture coordinates alone. Returns the largest distance between geometry
/// and result that was measured, relative to the diagonal of the control points' box. Throws Error{malformed,
/// unsupported, limit} for invalid fields.
double addNurbs(const Source& source, pugi::xml_node node, VertexData& data, Faces& faces);

} // namespace imgeo::x3d
