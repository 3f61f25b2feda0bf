#pragma once
// Shapes that name the same files in geometry nodes of their own: X3DOM's pages repeat the node in each instance.

#include "documents/documents.h"

namespace imgeo {

/// Makes shapes whose geometries are equal share the first of them, and removes the others.
void shareEqualGeometries(SceneDocument& document);

} // namespace imgeo
