#pragma once
// The normal image of a patch for each normal encoding: docs/formats/sig-classic.md.

#include "containers/classic/layout.h"
#include "containers/geometry_description.h"
#include "containers/png/png.h"

namespace imgeo {

/// Makes the image of a patch's normals. RGB and palette images have the size of record images. Images of pairs are
/// gray; the upper half holds the first numbers. Texels after the last record repeat it. Throws Error{limit} for pairs
/// of more records than half of the largest image holds.
Image normalImage(const IndexedPatch& patch, NormalEncoding encoding, ImageSize records);

/// The unit normal of an RGB texel; (0, 0, 1) for a zero vector.
Vec3f normalOf(const std::uint8_t* texel);

/// The maximum angle, in radians, between a patch's normals and those of a palette image.
double paletteErrorOf(const IndexedPatch& patch, const Image& image);

} // namespace imgeo
