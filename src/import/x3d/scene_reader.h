#pragma once
// The scene graph of an X3D document: nodes whose geometry becomes a mesh, Transforms and Groups are read; every other
// element is a node that keeps its fields as text.

#include "import/import.h"
#include "import/references.h"
#include "import/x3d/source.h"

namespace imgeo::x3d {

/// Reads a document whose prototypes are expanded and whose nodes are converted (node_conversions.h).
Imported readSceneGraph(const Source& source, const References& references, const ImportOptions& options);

} // namespace imgeo::x3d
