#pragma once
// The normal image of a patch, as each encoding has it: docs/formats/sig-classic.md.

#include "containers/classic/layout.h"
#include "containers/geometry_description.h"
#include "containers/png/png.h"

namespace imgeo {

/// The image of a patch's normals. RGB and palette: of the size of the record
/// images. Pairs: gray, two halves of which the upper holds the first numbers.
/// Texels behind the last record repeat it. Throws Error{limit} for pairs of more
/// records than half of the largest image holds.
Image normalImage(const IndexedPatch& patch, NormalEncoding encoding, ImageSize records);

/// The unit normal of an RGB texel; (0, 0, 1) for one without length.
Vec3f normalOf(const std::uint8_t* texel);

/// The largest angle between a patch's normals and what a palette image says, in radians.
double paletteErrorOf(const IndexedPatch& patch, const Image& image);

} // namespace imgeo
