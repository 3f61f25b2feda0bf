#pragma once
// Merges positions and wedges whose values have equal bits.

#include "imgeo/preparation.h"
#include "scene/mesh.h"

namespace imgeo {

/// Merges positions of equal bits (-0 counts as 0), then wedges of equal position and attributes, and drops positions
/// and wedges that no element references. Positions that differ are not merged, even if the lattice will make them
/// equal. Positions and wedges are put in the order of their first use; elements keep their order.
WeldReport weld(Mesh& mesh, const DroppedElements& dropped = {});

} // namespace imgeo
