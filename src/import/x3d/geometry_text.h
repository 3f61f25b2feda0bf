#pragma once
// The length of the text of geometry nodes, which decides what geometry stays in the document.

#include "import/x3d/source.h"

#include <cstddef>

namespace imgeo::x3d {

/// The bytes of a geometry node's text, with its child nodes, USEs resolved.
std::size_t geometryTextBytesOf(const Source& source, pugi::xml_node geometry);

/// The sum of geometryTextBytesOf over all geometry nodes with vertices that can become meshes and have at most
/// `maxBytes` each.
std::size_t smallGeometryTextBytes(const Source& source, std::size_t maxBytes);

} // namespace imgeo::x3d
