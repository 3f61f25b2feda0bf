#pragma once
// Welding: equal input bits become one position, one wedge.

#include "imgeo/preparation.h"
#include "scene/mesh.h"

namespace imgeo {

/// Merges positions of equal bits (-0 counts as 0), then wedges of equal
/// position and attributes, and drops what no element references. Never merges
/// what merely quantises to the same place. Positions and wedges keep the order
/// of their first use, elements theirs.
WeldReport weld(Mesh& mesh, const DroppedElements& dropped = {});

} // namespace imgeo
