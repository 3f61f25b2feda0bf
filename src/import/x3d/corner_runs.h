#pragma once
// Reads which corners the polygons, polylines and points of a geometry node have, of nodes that state vertices one by
// one: IndexedFaceSet, the sets of triangles, strips, fans and quadrilaterals with and without index, IndexedLineSet,
// LineSet, PointSet, TriangleSet2D, Polyline2D and Polypoint2D.

#include "import/x3d/faces.h"
#include "import/x3d/source.h"

#include <string_view>

namespace imgeo::x3d {

/// Whether a node of this name is one of them.
bool hasCornerRuns(std::string_view element);

/// Adds the polygons, lines or points of such a node. `data` has the vertices of the nodes in it; a 2D node replaces
/// them by its own, in the plane z = 0. Throws Error{malformed} for invalid fields.
void addCornerRuns(const Source& source, pugi::xml_node node, VertexData& data, Faces& faces);

/// Gives corners, which have positions alone, the other attributes of a node with one index per vertex: that of the
/// position, or of the face where the node has one value per face.
void addVertexAttributes(const Source& source, pugi::xml_node node, const VertexData& data, Faces& faces);

} // namespace imgeo::x3d
