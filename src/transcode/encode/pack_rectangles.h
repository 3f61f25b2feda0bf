#pragma once
// Arranges rectangles in an image.

#include "images/resize.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace imgeo {

struct PackedRectangles {
  RasterSize size;                                              ///< of the image
  std::vector<std::pair<std::uint32_t, std::uint32_t>> corners; ///< column and row of each rectangle's first pixel
};

/// Arranges rectangles without overlap, the highest first and each as low as it can be, in an image with edges of at
/// most `maxEdge` whose area is small. Nothing where they do not fit. Deterministic.
std::optional<PackedRectangles> packRectangles(std::span<const RasterSize> rectangles, std::uint32_t maxEdge);

} // namespace imgeo
