#include "prepare/degenerate_elements.h"

#include "base/parallel.h"

#include <atomic>

namespace imgeo {

namespace {

/// For coordinates of n bits a difference has n + 1 bits, and a sum of two products of differences 2n + 3 bits with
/// its sign, so 64-bit integers, which are faster, suffice for 30 bits.
__extension__ using Int128 = __int128;
constexpr std::uint32_t maxBitsFor64BitIntegers = 30;

template <typename T> Vec3<T> differenceOf(Vec3u a, Vec3u b) {
  const auto difference = [](std::uint32_t x, std::uint32_t y) { return static_cast<T>(y) - static_cast<T>(x); };
  return {difference(a.x, b.x), difference(a.y, b.y), difference(a.z, b.z)};
}

template <typename T> bool hasArea(Vec3u a, Vec3u b, Vec3u c) {
  return cross(differenceOf<T>(a, b), differenceOf<T>(a, c)) != Vec3<T>{};
}

bool hasArea(Vec3u a, Vec3u b, Vec3u c, std::uint32_t bits) {
  return bits <= maxBitsFor64BitIntegers ? hasArea<std::int64_t>(a, b, c) : hasArea<Int128>(a, b, c);
}

bool hasArea(Vec3f a, Vec3f b, Vec3f c) {
  const Vec3d origin(a);
  return cross(Vec3d(b) - origin, Vec3d(c) - origin) != Vec3d{};
}

} // namespace

std::size_t countCollapsedElements(const Mesh& mesh, std::span<const Vec3u> points, std::uint32_t bits) {
  if (mesh.topology == Topology::points)
    return 0;
  std::atomic<std::size_t> collapsed = 0;
  parallelForBlocks(mesh.elementCount(), [&](std::size_t begin, std::size_t end) {
    std::size_t blockCount = 0;
    for (std::size_t element = begin; element < end; ++element) {
      const auto corner = [&](std::size_t n) {
        return mesh.wedgePositions[mesh.corners[element * cornersPerElement(mesh.topology) + n]];
      };
      const std::uint32_t a = corner(0), b = corner(1);
      if (mesh.topology == Topology::lines) {
        blockCount += points[a] == points[b] && mesh.positions[a] != mesh.positions[b];
        continue;
      }
      const std::uint32_t c = corner(2);
      blockCount += !hasArea(points[a], points[b], points[c], bits) &&
                    hasArea(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
    }
    collapsed += blockCount;
  });
  return collapsed;
}

} // namespace imgeo
