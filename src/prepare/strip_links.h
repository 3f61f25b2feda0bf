#pragma once
// The links between neighbouring triangles that follow one another in a strip, and their cost.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// xorshift64* (Marsaglia 2003, Vigna 2016): the same numbers on every machine.
class XorShift64Star {
public:
  std::uint32_t bits() {
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    return static_cast<std::uint32_t>(state_ * 0x2545f4914f6cdd1du >> 32);
  }
  /// A number in 0 <= x < 1.
  float uniform() { return static_cast<float>(bits() >> 8) * 0x1p-24f; }

private:
  std::uint64_t state_ = 0x9e3779b97f4a7c15u;
};

/// A set of links between neighbouring triangles, at most two for each triangle, that forms paths and, rarely, cycles
/// in the dual graph. Its cost is the number of indices of the strip beyond one for each triangle, and is counted in
/// quarters of an index:
///  - 1 index for each swap: two turns in the same direction, at a link between two others;
///  - 2 indices for each path, and 1 for each vertex that is the tip of an odd number of paths. The tip of a path is
///    the corner opposite its first or last link. Paths that share a tip are joined by one repeated index, others by
///    three;
///  - half an index for each path, since in half of the cases its first turn has the wrong direction for the strip.
class StripLinks {
public:
  /// Begins without links. `across` is oppositeHalfEdges(corners).
  StripLinks(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> across, std::size_t vertexCount);

  /// Resamples the links around every vertex, all links of one vertex at once, with probabilities proportional to
  /// factor^cost. `factor` is 0 .. 1; lower factors make high costs less likely. Time is linear in the number of
  /// triangles.
  void resample(float factor, XorShift64Star& random);

  /// Breaks every cycle where that costs least: by removing a link, or by joining the cycle to the end of a path beside
  /// it.
  void breakCycles();

  std::size_t triangleCount() const { return triangles_.size(); }
  std::uint32_t degree(std::uint32_t triangle) const;
  bool isLinked(std::uint32_t triangle, std::uint32_t side) const { return triangles_[triangle].linked >> side & 1; }
  /// Whether both triangles at a linked side have another link, and the turns before and after the side have the same
  /// direction.
  bool isSwap(std::uint32_t triangle, std::uint32_t side) const;

private:
  struct Triangle {
    std::array<std::uint32_t, 3> across{}; ///< by side: the opposite side as 4 * triangle + side, or noHalfEdge
    std::uint32_t linked = 0;              ///< bit s: side s is linked
  };

  /// The star of a vertex: its triangles, counter-clockwise, beginning at a corner (4 * triangle + corner). An open fan
  /// is treated as if one more triangle closed it.
  struct Star {
    std::uint32_t corner = 0;
    std::uint32_t size = 0; ///< triangles, including the one that closes an open fan; at most maxStarSize
    bool isOpen = false;
  };
  static constexpr std::uint32_t maxStarSize = 24;

  class StarSampler;

  void findStars(std::span<const std::uint32_t> across);
  int toggleTip(std::uint32_t triangle);

  /// Sides to link or to unlink, and the triangles on both sides of these edges. Sides are encoded as in
  /// Triangle::across.
  struct Change {
    std::array<std::uint32_t, 2> sides{};
    std::array<std::uint32_t, 3> triangles{};
    std::uint32_t sideCount = 0, triangleCount = 0;
  };
  int costAt(const Change& change) const;
  int toggle(const Change& change);
  std::uint32_t linkedSide(std::uint32_t triangle, std::uint32_t besides) const;
  void breakCycle(std::span<const std::uint32_t> cycle);

  std::vector<Triangle> triangles_;
  std::span<const std::uint32_t> corners_;
  std::vector<std::uint8_t> oddTips_; ///< by vertex: it is the tip of an odd number of paths
  std::vector<Star> stars_;
};

} // namespace imgeo
