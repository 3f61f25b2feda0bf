#pragma once
// Reads ImageGeometry and BinaryGeometry elements into descriptions.

#include "containers/geometry_description.h"
#include "documents/field_reader.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace imgeo {

/// Whether a node of this name holds a geometry of one of our encodings.
bool isGeometryNode(const char* name);

/// The draws of a node's `primType` and `vertexCount`. One draw of 0 stands for all vertices or indices that there are.
/// As in pages, a draw without a primType that we know is one of triangles, with a warning of `lenient` or an Error.
std::vector<Draw> readDraws(const FieldReader& fields, const FieldReader& lenient);

/// Why no file holds a geometry: its coordinates or indices are a live stream, a movie or a canvas. Nothing where files
/// may hold it.
std::optional<std::string> reasonGeometryIsNotInFiles(const DocumentText& source, const pugi::xml_node& node);

/// Reads a geometry node with its patches, in either form of docs/formats/nodes.md: GeometryPatch children, or one
/// patch in url fields or ImageTexture children of the node itself. Throws Error for geometry that a Lattice cannot
/// express. A list of operators that cannot be read, and images beyond those that an attribute can have, are left out
/// with a warning or, without `warnings`, an Error{malformed}.
GeometryDescription readGeometry(const DocumentText& source, const pugi::xml_node& node, DocumentWarnings* warnings);

/// Whether only the front of a geometry node's triangles is visible. What operators have folded is visible from both
/// sides.
bool readSolid(const FieldReader& fields);

} // namespace imgeo
