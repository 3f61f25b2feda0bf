#pragma once
// Reads ImageGeometry and BinaryGeometry elements into descriptions.

#include "containers/geometry_description.h"
#include "documents/field_reader.h"

#include <cstdint>
#include <optional>
#include <string>

namespace imgeo {

/// Whether a node of this name holds a geometry of one of our encodings.
bool isGeometryNode(const char* name);

/// The draws of a node's `primType` and `vertexCount`. One draw of 0 stands for all vertices or indices that there are.
std::vector<Draw> readDraws(const FieldReader& fields);

/// Why no file holds a geometry: its coordinates are a live stream, or one of its images a movie or a canvas. Nothing
/// where files may hold it.
std::optional<std::string> reasonGeometryIsNotInFiles(const DocumentText& source, const pugi::xml_node& node);

/// Reads a geometry node with its patches, in either form of docs/formats/nodes.md: GeometryPatch children, or one
/// patch in url fields or ImageTexture children of the node itself. Throws Error for geometry that a Lattice cannot
/// express. A list of operators that cannot be read is a warning or, without `warnings`, an Error{malformed}.
GeometryDescription readGeometry(const DocumentText& source, const pugi::xml_node& node, DocumentWarnings* warnings);

/// Whether only the front of a geometry node's triangles is visible. What operators have folded is visible from both
/// sides.
bool readSolid(const FieldReader& fields);

/// The field `patch` of a Shape, "DEF#N".
struct PatchName {
  std::string geometry; ///< the DEF of the geometry node
  std::uint32_t index = 0;
};

/// Empty for text of another form.
std::optional<PatchName> parsePatchName(const std::string& text);

} // namespace imgeo
