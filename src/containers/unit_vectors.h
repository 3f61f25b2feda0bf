#pragma once
// Encodes unit vectors as two integers of up to 16 bits. The octahedral encoding follows Meyer et al. 2010, with the
// precise rounding of Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors". The
// spherical encoding is that of the 2012 paper (4.1.2) and of X3DOM.

#include "base/vec.h"

#include <cstdint>

namespace imgeo {

/// Octahedral coordinates of a unit vector, 0 .. 2^bits - 2 on each axis of the octahedron's square. The number of grid
/// points is odd, so that the middle is zero and the coordinate axes are exact. Of the neighbouring grid points, the
/// one with the smallest angle is returned. `bits` is 2..16.
Vec2<std::uint32_t> octahedralFromUnit(Vec3f unit, std::uint32_t bits);

/// The unit vector of octahedral coordinates; larger values than 2^bits - 2 are clamped.
Vec3f unitFromOctahedral(Vec2<std::uint32_t> encoded, std::uint32_t bits);

/// Spherical coordinates (theta, phi) of a unit vector, each 0 .. 2^bits - 1. Theta, the angle to the z axis, is 0..pi;
/// phi, the angle around the z axis, is -pi..pi. `bits` is 1..16.
Vec2<std::uint32_t> sphericalFromUnit(Vec3f unit, std::uint32_t bits);

Vec3f unitFromSpherical(Vec2<std::uint32_t> encoded, std::uint32_t bits);

/// An upper bound of the angle, in radians, between a unit vector and the vector that it decodes to.
double octahedralErrorBound(std::uint32_t bits);
double sphericalErrorBound(std::uint32_t bits);
/// The same bound for three integers, one per axis, with a rounding step relative to the radius of the unit sphere
/// (RGB8: 2 / 255; Int8: 1 / 127; Int16: 1 / 32767).
double componentErrorBound(double step);

/// The angle between two unit vectors in radians; accurate for small angles as well.
double angleBetween(Vec3f a, Vec3f b);

} // namespace imgeo
