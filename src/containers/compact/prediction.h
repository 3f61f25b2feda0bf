#pragma once
// Predicts the position of a vertex from earlier vertices: the candidates and the slope of the surface of
// docs/formats/compact.md, "Positions". The encoder chooses among several parallelograms, after Isenburg and Cohen-Or,
// "Geometry prediction for high degree polygons", 2005, and Draco's constrained multi-parallelograms.

#include "base/vec.h"
#include "containers/compact/connectivity.h"
#include "containers/compact/header.h"

#include <array>
#include <bit>
#include <cstdint>

namespace imgeo::compact {

/// Lattice coordinates and their differences; 64 bits do not overflow.
using Vec3i64 = Vec3<std::int64_t>;

inline std::uint32_t lengthInBits(std::int64_t value) {
  return static_cast<std::uint32_t>(std::bit_width(static_cast<std::uint64_t>(value < 0 ? -value : value)));
}

inline std::int64_t largestComponent(const Vec3i64& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// The axis of the largest component, the first of equals; 2 if all are 0.
template <typename T> int dominantAxis(const Vec3<T>& v) {
  const T x = v.x < 0 ? -v.x : v.x, y = v.y < 0 ? -v.y : v.y, z = v.z < 0 ? -v.z : v.z;
  if (x == 0 && y == 0)
    return 2;
  return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

struct Candidates {
  std::array<Vec3i64, 9> positions;
  std::uint32_t count = 0;
  std::uint32_t set = 0; ///< which candidates there are besides the first, as bits

  void add(const Vec3i64& position, std::uint32_t flag) {
    positions[count++] = position;
    set += flag;
  }
  /// Adds the middle of two candidates, rounded down. Which ones there are follows from the set.
  void addMiddle(std::uint32_t a, std::uint32_t b) {
    Vec3i64 sum = positions[a] + positions[b];
    for (int axis = 0; axis < 3; ++axis)
      sum[axis] >>= 1;
    add(sum, 0);
  }
  /// A context from the distance between the first two candidates; 0: there is only one.
  std::uint32_t agreement() const {
    return count == 1 ? 0 : 1 + std::min(14u, lengthInBits(largestComponent(positions[1] - positions[0])));
  }
};

/// Predicts positions from those before them, by the connectivity of a patch.
class Predictor {
public:
  /// The arguments that are passed by reference must outlive the Predictor.
  Predictor(Version version, const Connectivity& connectivity, const std::vector<Vec3u>& positions,
            std::uint32_t positionBits)
      : version_(version), connectivity_(connectivity), positions_(positions),
        middle_(std::int64_t{1} << (positionBits - 1)) {}

  /// The candidates of a vertex; `across` is the corner opposite the edge across which a triangle introduces it, or
  /// none.
  Candidates candidatesFor(std::uint32_t vertex, std::uint32_t across) const {
    Candidates candidates;
    if (across != none) {
      addParallelograms(candidates, vertex, across);
      if (version_ != Version::one)
        addSecondRing(candidates, across);
    } else if (!connectivity_.from.empty() && connectivity_.from[vertex] != none) {
      const std::uint32_t from = connectivity_.from[vertex];
      candidates.add(at(from), 0);
      if (const std::uint32_t further = connectivity_.from[from]; further != none)
        candidates.add(beyond(from, further), 1);
    } else {
      candidates.add(vertex > 0 ? at(vertex - 1) : Vec3i64{middle_, middle_, middle_}, 0);
    }
    return candidates;
  }

private:
  Vec3i64 at(std::uint32_t vertex) const { return Vec3i64(positions_[vertex]); }
  Vec3i64 atCorner(std::uint32_t corner) const { return at(connectivity_.vertex[corner]); }
  /// As far from `vertex` as `other` is, on the other side.
  Vec3i64 beyond(std::uint32_t vertex, std::uint32_t other) const { return at(vertex) + at(vertex) - at(other); }

  void addParallelograms(Candidates& candidates, std::uint32_t vertex, std::uint32_t across) const {
    const Vec3i64 o = atCorner(across), p = atCorner(after(across)), k = atCorner(before(across));
    candidates.add(k + p - o, 0);
    if (const std::uint32_t s = connectivity_.second[vertex]; s != none)
      candidates.add(atCorner(after(s)) + atCorner(before(s)) - atCorner(s), 1);
    if (const std::uint32_t ahead = connectivity_.ahead[vertex]; ahead != none)
      candidates.add(p + at(ahead) - k, 2);
    if (const std::uint32_t behind = connectivity_.behind[vertex]; behind != none)
      candidates.add(p + p - at(behind), 4);
  }

  /// Adds points beyond the ends of the edge, seen from the neighbours of the triangle behind it, and the middles of
  /// the first three parallelograms.
  void addSecondRing(Candidates& candidates, std::uint32_t across) const {
    const std::uint32_t parallelograms = candidates.count, triangle = across / 3, o = connectivity_.vertex[across];
    if (const std::uint32_t first = connectivity_.across[triangle]; first != none && across % 3 < 2)
      candidates.add(beyond(connectivity_.vertex[triangle * 3 + 1 - across % 3], connectivity_.vertex[first]), 8);
    if (const std::uint32_t s = connectivity_.closing[triangle]; s != none) {
      const std::uint32_t a = connectivity_.vertex[after(s)], b = connectivity_.vertex[before(s)];
      if (a == o || b == o)
        candidates.add(beyond(a == o ? b : a, connectivity_.vertex[s]), 16);
    }
    if (parallelograms > 1)
      candidates.addMiddle(0, 1);
    if (parallelograms > 2) {
      candidates.addMiddle(0, 2);
      candidates.addMiddle(1, 2);
    }
  }

  Version version_;
  const Connectivity& connectivity_;
  const std::vector<Vec3u>& positions_;
  std::int64_t middle_;
};

/// Sums of triangle normals in 32-bit integers that wrap.
class NormalSums {
public:
  NormalSums(std::size_t count, std::uint32_t shift) : sums_(count), shift_(shift) {}

  const Vec3<std::int32_t>& operator[](std::size_t i) const { return sums_[i]; }

  void add(std::size_t i, const Vec3<std::int32_t>& normal) {
    for (int axis = 0; axis < 3; ++axis)
      sums_[i][axis] = wrap(bits(sums_[i][axis]) + bits(normal[axis]));
  }

  /// The cross product of two edges of a triangle, whose components are shifted right first.
  Vec3<std::int32_t> normalOf(const Vec3u& a, const Vec3u& b, const Vec3u& c) const {
    const auto edge = [&](const Vec3u& to) {
      const auto component = [&](int axis) { return bits(static_cast<std::int32_t>(to[axis] - a[axis]) >> shift_); };
      return Vec3u{component(0), component(1), component(2)};
    };
    const Vec3u e = edge(b), f = edge(c);
    return {wrap(e.y * f.z - e.z * f.y), wrap(e.z * f.x - e.x * f.z), wrap(e.x * f.y - e.y * f.x)};
  }

private:
  static std::uint32_t bits(std::int32_t value) { return static_cast<std::uint32_t>(value); }
  static std::int32_t wrap(std::uint32_t value) { return static_cast<std::int32_t>(value); }

  std::vector<Vec3<std::int32_t>> sums_;
  std::uint32_t shift_;
};

/// The surface normal at an edge, shifted right to 15 bits.
struct Slope {
  Vec3i64 normal;
  int axis = 2; ///< the dominant axis

  Slope() = default;
  Slope(const Vec3<std::int32_t>& k, const Vec3<std::int32_t>& p) {
    for (int a = 0; a < 3; ++a)
      normal[a] = static_cast<std::int32_t>(static_cast<std::uint32_t>(k[a]) + static_cast<std::uint32_t>(p[a]));
    axis = dominantAxis(normal);
    const std::uint32_t length = lengthInBits(largestComponent(normal));
    for (int a = 0; a < 3 && length > 15; ++a)
      normal[a] >>= length - 15;
  }
};

} // namespace imgeo::compact
