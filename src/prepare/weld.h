#pragma once
// Welding: equal input bits become one position, one wedge.

#include "scene/mesh.h"

namespace imgeo {

/// Elements that add nothing to see; otherwise they are kept.
struct DroppedElements {
  bool degenerate = false; ///< two corners at one position
  bool repeated = false;   ///< the same corners in the same cyclic order as an earlier element
};

struct WeldReport {
  std::size_t mergedPositions = 0; ///< positions whose bits another position already had
  std::size_t mergedWedges = 0;
  std::size_t unreferencedPositions = 0; ///< dropped: no element that is kept uses them
  std::size_t degenerateElements = 0;    ///< found, kept or dropped
  std::size_t duplicateElements = 0;     ///< found, kept or dropped, as elements that repeat an earlier one
};

/// Merges positions of equal bits (-0 counts as 0), then wedges of equal
/// position and attributes, and drops what no element references. Never merges
/// what merely quantises to the same place. Positions and wedges keep the order
/// of their first use, elements theirs.
WeldReport weld(Mesh& mesh, const DroppedElements& dropped = {});

} // namespace imgeo
