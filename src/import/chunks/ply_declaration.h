#pragma once
// Headers of the pieces of PLY files.

#include "import/ply/header.h"
#include "scene/mesh.h"

#include <string>

namespace imgeo {

/// The lines that declare an element of another count.
std::string declaration(const PlyElement& element, std::uint64_t count);

/// The elements of a PLY file whose faces, or points, are read piece by piece.
struct PlyMeshElements {
  const PlyElement* vertices = nullptr; ///< of the header, which must outlive them
  const PlyElement* faces = nullptr;    ///< nullptr: the file is a cloud of its vertices

  Topology topology() const { return faces ? Topology::triangles : Topology::points; }
};

/// Throws Error{unsupported} for files that have no vertices, faces before them, or edges or strips, {limit} for too
/// many vertices, {malformed} where faces have not one list of whole numbers 'vertex_indices'; all name `name`.
PlyMeshElements meshElementsOf(const PlyHeader& header, const std::string& name);

/// Whether a property of faces has the indices of their vertices.
inline bool isListOfVertices(const PlyProperty& property) {
  return property.isList() && (property.name == "vertex_indices" || property.name == "vertex_index");
}

} // namespace imgeo
