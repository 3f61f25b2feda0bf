#include "containers/geometry.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

namespace imgeo {

const char* nameOf(Role role) {
  constexpr const char* names[] = {"index", "coord", "normal", "texCoord", "color"};
  return names[static_cast<std::size_t>(role)];
}

const char* nameOf(Primitive primitive) {
  constexpr const char* names[] = {"POINTS", "LINES", "LINESTRIP", "TRIANGLES", "TRIANGLESTRIP"};
  return names[static_cast<std::size_t>(primitive)];
}

const char* nameOf(NormalEncoding encoding) {
  constexpr const char* names[] = {"rgb", "octahedral", "spherical", "palette"};
  return names[static_cast<std::size_t>(encoding)];
}

const char* nameOf(ElementType type) {
  constexpr const char* names[] = {"Int8", "Uint8", "Int16", "Uint16", "Int32", "Uint32", "Float32"};
  return names[static_cast<std::size_t>(type)];
}

std::uint32_t byteSizeOf(ElementType type) {
  constexpr std::uint32_t sizes[] = {1, 1, 2, 2, 4, 4, 4};
  return sizes[static_cast<std::size_t>(type)];
}

std::uint32_t coordBytes(Container container, std::uint32_t bits) {
  assert(bits >= 1 && bits <= 32);
  const std::uint32_t bytes = (bits + 7) / 8;
  return container == Container::sig ? bytes : std::bit_ceil(bytes);
}

std::uint32_t coordShift(Container container, std::uint32_t bits) {
  return 8 * coordBytes(container, bits) - bits;
}

namespace {

/// Lattice steps across the decode box: (256^bytes - 1) / 2^shift.
double stepsAcross(Container container, std::uint32_t bits) {
  return std::ldexp(std::ldexp(1.0, static_cast<int>(8 * coordBytes(container, bits))) - 1,
                    -static_cast<int>(coordShift(container, bits)));
}

/// The lattice that has its `steps`-th point at the far end of a box.
Lattice latticeOver(Vec3d origin, Vec3d size, double steps, std::uint32_t bits) {
  const double longest = std::max({size.x, size.y, size.z});
  return {origin, longest / steps, bits, {size.x / longest, size.y / longest, size.z / longest}};
}

} // namespace

Reference normalInCoords(const Reference& coord) {
  return {coord.url, coord.first + 6, coord.stride != 0 ? coord.stride : 8};
}

bool hasNormalsInCoords(const GeometryDescription& geometry) {
  return geometry.container == Container::bg && geometry.normalEncoding == NormalEncoding::spherical &&
         geometry.normalType == ElementType::uint8 && byteSizeOf(geometry.coordType) == 2 &&
         std::ranges::all_of(geometry.patches, [](const PatchDescription& patch) {
           return patch.coord.size() == 1 && patch.normal == normalInCoords(patch.coord[0]);
         });
}

bool isUnsigned(ElementType type) {
  return type == ElementType::uint8 || type == ElementType::uint16 || type == ElementType::uint32;
}

double maximumOf(ElementType type) {
  constexpr double maxima[] = {127, 255, 32767, 65535, 2147483647, 4294967295, 1};
  return maxima[static_cast<std::size_t>(type)];
}

double decodeEdge(Container container, const Lattice& lattice) {
  return lattice.step * stepsAcross(container, lattice.bits);
}

Box3d decodeBox(Container container, const Lattice& lattice) {
  const double edge = decodeEdge(container, lattice);
  return {lattice.origin, lattice.origin + Vec3d{edge, edge, edge}};
}

Lattice latticeFromDecodeBox(Container container, Vec3d center, Vec3d size, std::uint32_t bits) {
  return latticeOver(center - size * 0.5, size, stepsAcross(container, bits), bits);
}

Lattice latticeFromTypedBox(ElementType type, Vec3d center, Vec3d size) {
  if (type == ElementType::float32) {
    const double longest = std::max({size.x, size.y, size.z});
    const Vec3d reach{longest, longest, longest};
    return latticeOver(center - reach, reach * 2, UINT32_MAX, 32);
  }
  assert(!isUnsigned(type));
  const std::uint32_t bits = 8 * byteSizeOf(type);
  const double maximum = maximumOf(type);
  return latticeOver(center - size * ((maximum + 1) / maximum), size, maximum, bits);
}

DecodeFields decodeFields(const GeometryDescription& geometry) {
  const Lattice& lattice = geometry.lattice;
  const bool typed = geometry.container == Container::bg && !isUnsigned(geometry.coordType);
  if (typed && geometry.coordType == ElementType::float32) {
    const double half = lattice.step * UINT32_MAX / 2;
    const Vec3d size{half, half, half};
    return {lattice.origin + size, size};
  }
  const double maximum = maximumOf(geometry.coordType);
  const double edge = typed ? lattice.step * maximum : decodeEdge(geometry.container, lattice);
  const Vec3d size = lattice.stretch * edge;
  return {lattice.origin + size * (typed ? (maximum + 1) / maximum : 0.5), size};
}

} // namespace imgeo
