#pragma once
// Quantises normals to a palette of 256 directions, which is stored as the colour table of an image: an option that
// the 2012 paper left unexplored (7.1). The browser expands the table, so that readers get an ordinary RGB normal
// image.

#include "base/vec.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

struct NormalPalette {
  std::array<Rgba8, 256> colors{};   ///< byte = round((n + 1) * 127.5), alpha 255
  std::vector<std::uint8_t> indices; ///< one per normal
};

/// Chooses 256 directions for unit normals: k-means on the sphere (Dhillon & Modha 2001), starting from evenly spread
/// directions. The table is sorted so that neighbouring directions have near indices. Deterministic.
NormalPalette normalPalette(std::span<const Vec3f> normals);

} // namespace imgeo
