#pragma once
// Which neighbouring triangles follow one another in strips, and what that costs.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// xorshift64* (Marsaglia 2003, Vigna 2016): the same numbers everywhere.
class XorShift64Star {
public:
  std::uint32_t bits() {
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    return static_cast<std::uint32_t>(state_ * 0x2545f4914f6cdd1du >> 32);
  }
  /// 0 .. 1
  float share() { return static_cast<float>(bits() >> 8) * 0x1p-24f; }

private:
  std::uint64_t state_ = 0x9e3779b97f4a7c15u;
};

/// A set of links between neighbouring triangles, at most two a triangle, which
/// make up paths (and, rarely, rings), and what they cost in indices beyond one
/// a triangle, counted in quarters:
///  - 1 for each swap: two turns the same way, at a link between two others;
///  - 2 for each path and 1 for each vertex where an odd number of paths have
///    their tips: paths that share a tip are joined by one repeated index, where
///    others need three. A tip is the corner opposite a path's first or last link.
///    Another half for each path, whose first turn is as likely as not the wrong one.
class StripLinks {
public:
  /// No links yet. `across` is oppositeHalfEdges(corners).
  StripLinks(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> across, std::size_t vertexCount);

  /// Draws the links around every vertex anew, all those of one vertex at once and
  /// as likely as factor^cost each; `factor` is 0 .. 1, and the lower it is, the fewer dear
  /// ones there are. Time is linear in the number of triangles.
  void redraw(float factor, XorShift64Star& random);

  /// Opens every ring where that costs least: at a link, or by leading a path that ends beside
  /// it all around it.
  void openRings();

  std::size_t triangleCount() const { return triangles_.size(); }
  std::uint32_t degree(std::uint32_t triangle) const;
  bool isLinked(std::uint32_t triangle, std::uint32_t side) const { return triangles_[triangle].linked >> side & 1; }
  /// Whether both triangles at a linked side have another link and the turns
  /// before and after it go the same way.
  bool isSwap(std::uint32_t triangle, std::uint32_t side) const;

private:
  struct Triangle {
    std::array<std::uint32_t, 3> across{}; ///< by side: 4 * triangle + side, or noHalfEdge
    std::uint32_t linked = 0;              ///< a bit for each side
  };

  /// The triangles around a vertex, counter-clockwise, from this corner (4 * triangle
  /// + corner) on. An open fan stands as if one more closed it.
  struct Star {
    std::uint32_t corner = 0;
    std::uint32_t size = 0; ///< triangles, the one that closes a fan included; at most mostAround
    bool isOpen = false;
  };
  static constexpr std::uint32_t mostAround = 24;

  class StarDraw;

  void findStars(std::span<const std::uint32_t> across);
  int toggleTip(std::uint32_t triangle);

  /// Sides to link or to unlink, and the triangles at both hands of them. Sides are
  /// named as in Triangle::across.
  struct Change {
    std::array<std::uint32_t, 2> sides{};
    std::array<std::uint32_t, 3> triangles{};
    std::uint32_t sideCount = 0, triangleCount = 0;
  };
  int costAt(const Change& change) const;
  int toggle(const Change& change);
  std::uint32_t linkedSide(std::uint32_t triangle, std::uint32_t besides) const;
  void openRing(std::span<const std::uint32_t> ring);

  std::vector<Triangle> triangles_;
  std::span<const std::uint32_t> corners_;
  std::vector<std::uint8_t> oddTips_; ///< by vertex: an odd number of tips lie there
  std::vector<Star> stars_;
};

} // namespace imgeo
