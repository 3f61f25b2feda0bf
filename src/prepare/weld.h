#pragma once
// Welding: equal input bits become one position, one wedge.

#include "scene/mesh.h"

namespace imgeo {

struct WeldReport {
  std::size_t mergedPositions = 0; ///< positions whose bits another position already had
  std::size_t mergedWedges = 0;
  std::size_t unreferencedPositions = 0; ///< dropped: no element uses them
  std::size_t degenerateElements = 0;    ///< kept: two corners at one position
  std::size_t duplicateElements = 0;     ///< kept: same corners in the same cyclic order
};

/// Merges positions of equal bits (-0 counts as 0), then wedges of equal
/// position and attributes, and drops what no element references. Never merges
/// what merely quantises to the same place. Positions and wedges keep the order
/// of their first use.
WeldReport weld(Mesh& mesh);

} // namespace imgeo
