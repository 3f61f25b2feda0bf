#pragma once
// X3D in XML encoding. The geometry nodes of x3d/geometry.h become meshes; every other element is a node that the
// output keeps as it is. Prototype instances are expanded (x3d/prototypes.h). The file that an Inline names is read
// too: its nodes are the Inline's children.

#include "import/import.h"
#include "import/x3d/elements.h"

namespace imgeo {

/// True where the first 4 KiB are markup with an <X3D> element, and no page (x3d/page.h).
bool isX3d(ByteSpan bytes);
Imported readX3d(ByteSpan bytes, const std::string& name, const ImportOptions& options);

namespace x3d {

/// Reads a document of either encoding; `bytes` are the text that it was parsed from.
Imported readElements(Elements elements, ByteSpan bytes, const std::string& name, const ImportOptions& options);

} // namespace x3d

} // namespace imgeo
