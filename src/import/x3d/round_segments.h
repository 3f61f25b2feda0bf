#pragma once

namespace imgeo::x3d {

/// Segments of a full circle, in round solids and in a plane: steps of 7.5 degrees.
/// web/src/tessellate/solids.ts and geometry2d.ts have the same.
inline constexpr int roundSegments = 48;

} // namespace imgeo::x3d
