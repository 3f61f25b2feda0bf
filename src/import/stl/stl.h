#pragma once
// STL, binary and ASCII: each ASCII solid is a shape. Each corner gets a position of its own (prepare/weld joins them);
// facet normals are not read, since the winding determines them.

#include "import/import.h"

namespace imgeo {

/// True where the size equals that of the facets that a binary header counts, or the text begins with "solid".
bool isStl(ByteSpan bytes);
Imported readStl(ByteSpan bytes, const std::string& name, const ImportOptions& options);

} // namespace imgeo
