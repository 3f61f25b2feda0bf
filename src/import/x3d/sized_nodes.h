#pragma once
// Reads the geometry nodes that state sizes and no vertices: Box, Sphere, Cylinder, Cone, Arc2D, ArcClose2D, Circle2D,
// Disk2D and Rectangle2D.

#include "import/x3d/faces.h"
#include "import/x3d/source.h"

#include <string_view>

namespace imgeo::x3d {

/// Whether a node of this name is one of them: a document with the node is shorter than its mesh.
bool hasOnlySizes(std::string_view element);

/// Adds the faces of such a node as pages draw it, or its polylines: then it returns Topology::lines. Throws
/// Error{malformed} for a field of another count of numbers.
Topology addSizedNode(const Source& source, pugi::xml_node node, VertexData& data, Faces& faces);

} // namespace imgeo::x3d
