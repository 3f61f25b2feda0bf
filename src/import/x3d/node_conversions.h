#pragma once
// Replaces nodes that pages do not draw by nodes that they draw, in the elements of a document: a CADPart becomes a
// Transform (the rows `converted` of x3d/node_table.h that are no prototypes).

#include "import/x3d/elements.h"

#include <map>
#include <string>

namespace imgeo::x3d {

struct NodeConversions {
  using Counts = std::map<std::string, std::size_t>;

  Counts converted; ///< "CADPart as Transform"
  Counts leftOut;   ///< "the alphaTexture of CommonSurfaceShader"
  Counts hidden;    ///< layers that their LayerSet does not draw
  Counts unbound;   ///< viewpoints, backgrounds … of layers that are not active
};

/// Converts all nodes below the document's root. Elements that the result does not contain are moved out of Scene,
/// where a USE still finds their DEF. The document must not be nested deeper than prototypes allow (x3d/prototypes.h).
NodeConversions convertNodes(Elements& elements);

} // namespace imgeo::x3d
