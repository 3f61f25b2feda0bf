#pragma once
// STL, binary and ASCII: each ASCII solid is a shape. Each corner gets a position of its own (prepare/weld merges equal
// ones); facet normals are not read, since the winding determines them.

#include "import/import.h"

namespace imgeo {

/// Whether the text begins with "solid", or the size of the file fits the number of facets in a binary header.
bool isStl(ByteSpan bytes);
Imported readStl(ByteSpan bytes, const std::string& name, const ImportOptions& options);

} // namespace imgeo
