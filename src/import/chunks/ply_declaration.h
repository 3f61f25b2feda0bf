#pragma once
// Headers of the pieces of PLY files.

#include "import/ply/header.h"

#include <string>

namespace imgeo {

/// The lines that declare an element of another count.
std::string declaration(const PlyElement& element, std::uint64_t count);

/// Whether a property of faces has the indices of their vertices.
inline bool isListOfVertices(const PlyProperty& property) {
  return property.isList() && (property.name == "vertex_indices" || property.name == "vertex_index");
}

} // namespace imgeo
