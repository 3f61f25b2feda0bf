#pragma once
// The sizes of geometry that pages draw from its few numbers: boxes, spheres, cones, cylinders and flat figures.

#include "import/x3d/source.h"

namespace imgeo::x3d {

/// Throws Error{malformed} where a node states a negative size, or another count of numbers than the field has. Sizes
/// of zero, which X3D forbids (ISO/IEC 19775-1, clauses 13 and 14), pass: authors write flat boxes with them. Does
/// nothing for other nodes.
void checkSizes(const Source& source, pugi::xml_node node);

} // namespace imgeo::x3d
