#pragma once
// Unit vectors in two bytes or two 16-bit words. Octahedral after Meyer et al.
// 2010, with the precise rounding of Cigolle et al. 2014, "A Survey of Efficient
// Representations for Independent Unit Vectors"; spherical as the 2012 paper
// (4.1.2) and X3DOM have it.

#include "base/vec.h"

#include <cstdint>

namespace imgeo {

/// Octahedral coordinates of a unit vector on a grid of 2^bits - 1 points an axis,
/// so that the axes themselves are exact: 0 .. 2^bits - 2, the middle is zero.
/// Takes the neighbouring grid point with the smallest angle. `bits` is 2..16.
Vec2<std::uint32_t> octahedralFromUnit(Vec3f unit, std::uint32_t bits);

/// The unit vector of octahedral coordinates; values above 2^bits - 2 count as that.
Vec3f unitFromOctahedral(Vec2<std::uint32_t> encoded, std::uint32_t bits);

/// (theta, phi) of a unit vector as two integers of `bits` bits (1..16): theta from
/// the z axis, 0..pi over 0 .. 2^bits - 1; phi around it from -pi, likewise to +pi.
Vec2<std::uint32_t> sphericalFromUnit(Vec3f unit, std::uint32_t bits);

Vec3f unitFromSpherical(Vec2<std::uint32_t> encoded, std::uint32_t bits);

/// The largest angle, in radians, between a unit vector and what comes back of it
/// through each encoding: a bound, not a measurement.
double octahedralErrorBound(std::uint32_t bits);
double sphericalErrorBound(std::uint32_t bits);
/// The same for one signed or unsigned integer an axis with this rounding step in
/// units of the unit sphere (RGB8: 2 / 255; Int8: 1 / 127; Int16: 1 / 32767).
double componentErrorBound(double step);

/// The angle between two unit vectors in radians, exact for small angles too.
double angleBetween(Vec3f a, Vec3f b);

} // namespace imgeo
