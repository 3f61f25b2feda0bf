#pragma once
// PopGeometry: X3DOM's geometry of nested levels (Limper et al., "The POP Buffer: Rapid Progressive Clustering by
// Geometry Quantization", 2013). docs/formats/x3dom-geometry.md describes its files.

#include "containers/patch_reader.h"
#include "import/x3d/source.h"
#include "scene/mesh.h"

namespace imgeo::x3d {

/// The mesh of a PopGeometry with all its levels, at full precision. Safe for untrusted bytes: levels whose sizes
/// differ from their files throw Error{truncated, malformed}; types of numbers that X3DOM does not read throw
/// Error{unsupported}; more than 16 levels throw Error{limit}. Each names the line of the node or of the level, or what
/// `fetch` throws for a file.
Mesh readPopGeometry(const Source& source, pugi::xml_node node, const FetchFile& fetch);

} // namespace imgeo::x3d
