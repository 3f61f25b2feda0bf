#pragma once
// The images of the vertex attributes of a patch, for each encoding and precision: docs/formats/sig-classic.md.

#include "containers/classic/layout.h"
#include "containers/geometry_description.h"
#include "containers/png/png.h"

#include <vector>

namespace imgeo {

/// Makes the images of an attribute that the patch has, most significant bytes first, with the bits of
/// GeometryDescription::imageBits. They have the size of record images, except pairs of 8-bit numbers: these are the
/// halves of one gray image, the first numbers in the upper half. Texels after the last record repeat it. Throws
/// Error{limit} for pairs of 8 bits of more records than half of the largest image holds.
std::vector<Image> attributeImages(VertexRole role, const IndexedPatch& patch, const GeometryDescription& geometry,
                                   ImageSize records);

/// The unit normal of three numbers of `bits` bits; (0, 0, 1) for a zero vector.
Vec3f normalOf(const Vec3u& stored, std::uint32_t bits);

/// The maximum angle, in radians, between a patch's normals and those of a palette image.
double paletteErrorOf(const IndexedPatch& patch, const Image& image);

} // namespace imgeo
