#pragma once
// Equal Appearances of scenes with many shapes become one node.

#include "import/x3d/elements.h"

#include <cstddef>

namespace imgeo::x3d {

/// Scenes of at most this many Shapes keep equal Appearances apart, as their authors wrote them.
inline constexpr std::size_t maxShapesWithOwnAppearance = 10'000;

/// Replaces each Appearance that equals an earlier one by a USE of it, where the scene has more Shapes than
/// `maxShapesWithOwnAppearance`. Appearances with a DEF, or with a DEF inside, stay: scripts may use these names.
/// Returns the number of replaced nodes.
std::size_t shareAppearances(Elements& elements);

} // namespace imgeo::x3d
