#include "containers/geometry.h"

#include <bit>
#include <cassert>
#include <cmath>

namespace imgeo {

const char* nameOf(Role role) {
  constexpr const char* names[] = {"index", "coord", "normal", "texCoord", "color"};
  return names[static_cast<std::size_t>(role)];
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

} // namespace

double decodeEdge(Container container, const Lattice& lattice) {
  return lattice.step * stepsAcross(container, lattice.bits);
}

Box3d decodeBox(Container container, const Lattice& lattice) {
  const double edge = decodeEdge(container, lattice);
  return {lattice.origin, lattice.origin + Vec3d{edge, edge, edge}};
}

Lattice latticeFromDecodeBox(Container container, Vec3d center, double edge, std::uint32_t bits) {
  return {center - Vec3d{edge, edge, edge} * 0.5, edge / stepsAcross(container, bits), bits};
}

} // namespace imgeo
