#include "containers/stored_coords.h"

#include "base/error.h"
#include "base/shortest_decimal.h"
#include "containers/encodings.h"
#include "containers/grid.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

namespace imgeo {

namespace {

constexpr double floatRounding = 0x1p-24; ///< maximum relative error of single precision

double longestOf(Vec3d size) {
  return std::max({size.x, size.y, size.z});
}

double largestMagnitude(const Box3d& box) {
  double largest = 0;
  for (int axis = 0; axis < 3 && !box.empty(); ++axis)
    largest = std::max({largest, std::abs(box.min[axis]), std::abs(box.max[axis])});
  return largest;
}

bool isFloat(const GeometryDescription& geometry) {
  return hasElementTypes(geometry.encoding) && geometry.coordType == ElementType::float32;
}

} // namespace

std::uint32_t coordBytes(Encoding encoding, std::uint32_t bits) {
  assert(bits >= 1 && bits <= 32);
  const std::uint32_t bytes = (bits + 7) / 8;
  return !hasElementTypes(encoding) ? bytes : std::bit_ceil(bytes);
}

ElementType unsignedTypeOf(std::uint32_t bytes) {
  assert(bytes == 1 || bytes == 2 || bytes == 4);
  return bytes == 1 ? ElementType::uint8 : bytes == 2 ? ElementType::uint16 : ElementType::uint32;
}

bool holdsLattice(ElementType type, std::uint32_t bits) {
  if (bits < 8)
    return false;
  return type == ElementType::float32 ? bits <= 24 || bits == sourceBits : bits <= 8 * byteSizeOf(type);
}

StoredCoords storedCoords(Encoding encoding, ElementType type, std::uint32_t bits) {
  const std::uint32_t largest = UINT32_MAX >> (32 - bits);
  if (!hasElementTypes(encoding)) {
    const std::uint32_t stored = 8 * coordBytes(encoding, bits);
    return {stored - bits, 0, std::ldexp(1.0, static_cast<int>(stored)) - 1, largest};
  }
  assert(type != ElementType::float32 && holdsLattice(type, bits));
  const std::uint32_t width = 8 * byteSizeOf(type);
  if (isUnsigned(type))
    return {width - bits, 0, maximumOf(type), largest};
  if (bits == width)
    return {0, -(std::int64_t{1} << (width - 1)), maximumOf(type), largest};
  return {width - 1 - bits, -(std::int64_t{1} << (width - 2)), maximumOf(type), largest};
}

std::uint32_t loadCoord(std::int64_t value, const StoredCoords& stored, const std::string& location) {
  const std::int64_t shifted = value - stored.bias;
  const std::int64_t q = shifted >> stored.shift;
  if (shifted < 0 || q > stored.largest || q << stored.shift != shifted)
    throw Error(ErrorKind::malformed, location, "a coordinate has more bits than the node's positionBits");
  return static_cast<std::uint32_t>(q);
}

namespace {

double stepsTo(double value, int axis, const Lattice& lattice) {
  return std::round((value - lattice.origin[axis]) / lattice.step);
}

} // namespace

bool isInside(Vec3f position, const Lattice& lattice) {
  for (int axis = 0; axis < 3; ++axis) {
    const double value = position[axis], steps = stepsTo(value, axis, lattice);
    // Rounding to single precision may move a point on the border of the lattice outside.
    const double slack = 1 + std::abs(value) * (2 * floatRounding) / lattice.step;
    if (!std::isfinite(value) || steps < -slack || steps > lattice.maximum() + slack)
      return false;
  }
  return true;
}

Vec3u nearestPoint(Vec3f position, const Lattice& lattice, const std::string& location) {
  if (!isInside(position, lattice))
    throw Error(ErrorKind::malformed, location, "vertices lie far outside of the box that the node states");
  Vec3u nearest;
  for (int axis = 0; axis < 3; ++axis)
    nearest[axis] =
        static_cast<std::uint32_t>(std::clamp<double>(stepsTo(position[axis], axis, lattice), 0, lattice.maximum()));
  return nearest;
}

DecodeFields decodeFields(const GeometryDescription& geometry) {
  const Lattice& lattice = geometry.lattice;
  if (isFloat(geometry)) {
    const double edge = lattice.step * lattice.maximum();
    const double half = lattice.bits == sourceBits ? edge / 2 : edge;
    return {lattice.origin + Vec3d{edge, edge, edge} * 0.5, {half, half, half}};
  }
  if (geometry.grid == GridKind::heightMap)
    return heightMapBox(lattice, heightMapSize(geometry));
  const StoredCoords stored = storedCoords(geometry.encoding, geometry.coordType, lattice.bits);
  const Vec3d unit = lattice.stretch * std::ldexp(lattice.step, -static_cast<int>(stored.shift));
  const Vec3d zero = lattice.origin - unit * static_cast<double>(stored.bias), size = unit * stored.maximum;
  const bool isZeroAtCorner = !hasElementTypes(geometry.encoding) || isUnsigned(geometry.coordType);
  return {isZeroAtCorner ? zero + size * 0.5 : zero, size};
}

std::optional<DecodeFields> quantizationCube(const Box3d& box) {
  if (box.empty() || !(box.longestEdge() > 0))
    return {};
  const double edge = box.longestEdge();
  return DecodeFields{box.min + Vec3d{edge, edge, edge} * 0.5, {edge, edge, edge}};
}

Lattice latticeOf(const DecodeFields& fields, Encoding encoding, ElementType type, std::uint32_t bits) {
  const double longest = longestOf(fields.size);
  if (hasElementTypes(encoding) && type == ElementType::float32) {
    const double edge = bits == sourceBits ? 2 * longest : longest;
    Lattice lattice{fields.position - Vec3d{edge, edge, edge} * 0.5, 0, bits};
    lattice.step = edge / lattice.maximum();
    return lattice;
  }
  const StoredCoords stored = storedCoords(encoding, type, bits);
  const bool isZeroAtCorner = !hasElementTypes(encoding) || isUnsigned(type);
  const Vec3d zero = isZeroAtCorner ? fields.position - fields.size * 0.5 : fields.position;
  return {zero + fields.size * (static_cast<double>(stored.bias) / stored.maximum),
          std::ldexp(longest / stored.maximum, static_cast<int>(stored.shift)),
          bits,
          {fields.size.x / longest, fields.size.y / longest, fields.size.z / longest}};
}

namespace {

/// Rounds origin and step to few decimal digits: with all digits of a double they would be a sixth of the compressed
/// document of a scene with thousands of shapes. Lattices of more than 24 bits stay exact.
Lattice inFewDigits(Lattice lattice, double edge) {
  constexpr std::uint32_t maxBits = 24;
  if (lattice.bits > maxBits || !(edge > 0))
    return lattice;
  const double tolerance = lattice.step / 1024;
  for (int axis = 0; axis < 3; ++axis)
    lattice.origin[axis] = shortestWithin(lattice.origin[axis], tolerance);
  lattice.step = shortestWithin(edge, tolerance) / lattice.maximum();
  return lattice;
}

} // namespace

Lattice latticeFor(const Box3d& box, ElementType type, std::uint32_t bits) {
  if (type != ElementType::float32 || bits != sourceBits || !(box.longestEdge() > 0))
    return inFewDigits(latticeFor(box, bits), box.longestEdge());
  return latticeOf({box.center(), box.size()}, Encoding::bg, type, bits);
}

Vec3u pointReadBack(Vec3u q, const Lattice& written, const GeometryDescription& geometry) {
  return isFloat(geometry) ? nearestPoint(Vec3f(written.point(q)), geometry.lattice, "") : q;
}

double positionErrorBound(const GeometryDescription& geometry) {
  if (geometry.grid == GridKind::heightMap) // columns and rows may be off by a thousandth of their distance
    return std::max(geometry.lattice.stretch.y, 2e-3) * geometry.lattice.step / 2;
  const double half = geometry.lattice.step / 2;
  return isFloat(geometry) ? 2 * half + largestMagnitude(geometry.box) * floatRounding : half;
}

} // namespace imgeo
