#include "containers/normals.h"

#include "containers/encodings.h"
#include "containers/unit_vectors.h"

#include <cassert>
#include <cmath>

namespace imgeo {

bool isPair(NormalEncoding encoding) {
  return encoding == NormalEncoding::octahedral || encoding == NormalEncoding::spherical;
}

// X3DOM reads spherical coordinates as a little-endian word 256 * theta + phi, so phi is stored first.
Vec2<std::uint32_t> storeNormal(Vec3f unit, NormalEncoding encoding, std::uint32_t bits) {
  assert(isPair(encoding));
  if (encoding == NormalEncoding::octahedral)
    return octahedralFromUnit(unit, bits);
  const Vec2<std::uint32_t> angles = sphericalFromUnit(unit, bits);
  return {angles.y, angles.x};
}

Vec3f loadNormal(Vec2<std::uint32_t> stored, NormalEncoding encoding, std::uint32_t bits) {
  assert(isPair(encoding));
  return encoding == NormalEncoding::octahedral ? unitFromOctahedral(stored, bits)
                                                : unitFromSpherical({stored.y, stored.x}, bits);
}

double normalErrorBound(const GeometryDescription& geometry) {
  if (rowOf(geometry).hasMeasuredNormalError)
    return 0;
  const bool isSig = !hasElementTypes(geometry.encoding);
  const std::uint32_t bits =
      isSig ? geometry.imageBits[VertexRole::normal] : 8 * byteSizeOf(geometry.attributeTypes[VertexRole::normal]);
  switch (geometry.normalEncoding) {
  case NormalEncoding::octahedral:
    return octahedralErrorBound(bits);
  case NormalEncoding::spherical:
    return sphericalErrorBound(bits);
  case NormalEncoding::palette:
  case NormalEncoding::derived:
    return 0;
  case NormalEncoding::rgb:
    break;
  }
  if (!isSig && geometry.attributeTypes[VertexRole::normal] == ElementType::float32)
    return 2e-7; // only the rounding of single precision
  return componentErrorBound(isSig ? 2 / (std::ldexp(1.0, static_cast<int>(bits)) - 1)
                                   : 1 / maximumOf(geometry.attributeTypes[VertexRole::normal]));
}

} // namespace imgeo
