#pragma once
// What limits the images of groups of levels of detail ("chips").

#include <cstdint>

namespace imgeo {

/// Rows and columns around each chip that repeat its colours. Chips begin at multiples of it, so that two reductions by
/// a graphics card do not mix their texels.
inline constexpr std::uint32_t chipGutter = 4;
inline constexpr std::uint32_t maxChipEdge = 8192; ///< of an image of chips

/// Texels of the images of all groups for each texel of the source's image.
inline constexpr double maxChipShare = 1.5;

} // namespace imgeo
