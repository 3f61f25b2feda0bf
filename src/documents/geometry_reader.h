#pragma once
// ImageGeometry and BinaryGeometry elements -> descriptions.

#include "containers/geometry_description.h"
#include "documents/field_reader.h"

namespace imgeo {

/// Whether a node of this name holds a geometry of one of our encodings.
bool isGeometryNode(const char* name);

/// Reads a geometry node with its patches, in either form of docs/formats/nodes.md:
/// GeometryPatch children, or the node as its own only patch with url fields or
/// ImageTexture children. Throws Error for geometry that cannot be expressed by a Lattice.
GeometryDescription readGeometry(const DocumentText& source, const pugi::xml_node& node);

} // namespace imgeo
