#pragma once
// Shapes that draw several kinds of elements (triangles, lines, points), which are several shapes in all other formats.

#include "documents/documents.h"

namespace imgeo {

/// Makes each such Shape a Group of its name, of a Shape for each kind, with geometries of one kind each and otherwise
/// the same. The first of these geometries has the index of the one that they replace.
void splitMixedGeometries(SceneDocument& document);

} // namespace imgeo
