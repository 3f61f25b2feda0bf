#pragma once
// Normals through a palette of 256 directions, stored as the colour table of an
// image: the option that the 2012 paper left unexplored (7.1). The browser
// expands the table, so that a reader sees an ordinary RGB normal image.

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

/// The 256 directions that stand best for these unit normals: k-means on the
/// sphere (Dhillon & Modha 2001) from evenly spread directions, the table sorted
/// so that neighbouring directions have near indices. Deterministic.
NormalPalette normalPalette(std::span<const Vec3f> normals);

} // namespace imgeo
