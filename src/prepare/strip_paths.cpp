// The ends of paths walk about by alternating links (the tunnels of Stewart,
// "Tunneling for triangle strips in continuous level-of-detail meshes", 2001, one
// link long), under simulated annealing (Kirkpatrick et al. 1983) of what the
// strip will cost.

#include "prepare/strip_paths.h"

#include "prepare/dual_graph.h"

#include <array>
#include <cmath>

namespace imgeo {

namespace {

/// xorshift64* (Marsaglia 2003, Vigna 2016): the same numbers everywhere.
class Random {
public:
  std::uint32_t bits() {
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    return static_cast<std::uint32_t>(state_ * 0x2545f4914f6cdd1du >> 32);
  }
  /// 0 .. bound - 1
  std::uint32_t below(std::size_t bound) {
    return static_cast<std::uint32_t>(std::uint64_t{bits()} * bound >> 32);
  }

private:
  std::uint64_t state_ = 0x9e3779b97f4a7c15u;
};

/// A few values without repetition.
template <std::size_t capacity> struct SmallSet {
  std::array<std::uint32_t, capacity> values{};
  std::size_t size = 0;

  bool has(std::uint32_t value) const {
    for (std::size_t i = 0; i < size; ++i)
      if (values[i] == value)
        return true;
    return false;
  }
  void add(std::uint32_t value) {
    if (!has(value))
      values[size++] = value;
  }
  const std::uint32_t* begin() const { return values.data(); }
  const std::uint32_t* end() const { return values.data() + size; }
};

/// A set of links between neighbouring triangles, at most two a triangle, which
/// make up paths (and, rarely, rings), and what they cost in indices beyond one
/// a triangle:
///  - 1 for each swap: two turns the same way, at a link between two others;
///  - 2 for each path, and 1 for each vertex where an odd number of paths have
///    their tips: paths that share a tip are joined by one repeated index, where
///    others need three. A tip is the corner opposite a path's first or last link.
/// Costs are counted twice over, to keep a link's two halves whole.
///
/// In here, side s of triangle t is 4t + s: this is the inner loop of stripping.
class Links {
public:
  Links(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> across,
        std::size_t vertexCount)
      : triangles_(corners.size() / 3), oddTips_(vertexCount) {
    for (std::uint32_t triangle = 0; triangle < triangles_.size(); ++triangle) {
      Triangle& made = triangles_[triangle];
      for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t opposite = across[3 * triangle + i];
        made.across[i] = opposite == noSide ? noSide : 4 * (opposite / 3) + opposite % 3;
        made.tips[i] = corners[3 * triangle + (i + 2) % 3];
      }
      if (made.tips[0] == made.tips[1] || made.tips[1] == made.tips[2] || made.tips[2] == made.tips[0])
        continue;
      updatePathEnds({{triangle}, 1});
    }
  }

  /// One random change, kept if it is not dearer or, now and then, if it is:
  /// where `odds` (by cost, 32-bit probabilities) let it pass.
  void step(Random& random, std::span<const std::uint64_t> odds) {
    const Change change = propose(random);
    if (change.sides.size == 0)
      return;
    int cost = -costOf(change.triangles);
    cost += toggle(change);
    cost += costOf(change.triangles);
    if (cost <= 0 ||
        (cost < static_cast<int>(odds.size()) && random.bits() < odds[static_cast<std::size_t>(cost)]))
      updatePathEnds(change.triangles);
    else
      toggle(change);
  }

  std::size_t triangleCount() const { return triangles_.size(); }
  int degree(std::uint32_t triangle) const {
    constexpr std::array<std::uint8_t, 8> bitCounts{0, 1, 1, 2, 1, 2, 2, 3};
    return bitCounts[triangles_[triangle].linked];
  }
  bool isLinked(std::uint32_t triangle, std::uint32_t i) const {
    return triangles_[triangle].linked >> i & 1;
  }

  /// Whether both triangles at a linked side have another link and the turns
  /// before and after it go the same way.
  bool isSwap(std::uint32_t triangle, std::uint32_t i) const { return isSwap(4 * triangle + i); }

private:
  struct Triangle {
    std::array<std::uint32_t, 3> across{}; ///< by side
    std::array<std::uint32_t, 3> tips{};   ///< by side: the corner opposite
    std::uint32_t pathEndAt = noSide;      ///< its place in pathEnds_, if it is there
    std::uint8_t linked = 0;               ///< a bit for each side
  };

  /// Sides to link or unlink, and the triangles on both hands of them.
  struct Change {
    SmallSet<3> sides;
    SmallSet<4> triangles;

    void add(std::uint32_t side, std::uint32_t opposite) {
      if (sides.has(opposite))
        return;
      sides.add(side);
      triangles.add(side / 4);
      triangles.add(opposite / 4);
    }
  };

  static std::uint32_t after(std::uint32_t side) { return side % 4 == 2 ? side - 2 : side + 1; }
  static std::uint32_t before(std::uint32_t side) { return side % 4 == 0 ? side + 2 : side - 1; }
  std::uint32_t across(std::uint32_t side) const { return triangles_[side / 4].across[side % 4]; }
  bool isLinked(std::uint32_t side) const { return isLinked(side / 4, side % 4); }
  bool isSwap(std::uint32_t side) const {
    const std::uint32_t opposite = across(side);
    if (degree(side / 4) < 2 || degree(opposite / 4) < 2)
      return false;
    return isLinked(after(side)) != isLinked(after(opposite));
  }

  Change propose(Random& random) {
    Change change;
    const std::uint32_t bits = random.bits();
    // Half of the time an end of a path moves on, else anything may happen.
    const bool anywhere = bits & 1 || pathEnds_.empty();
    const std::uint32_t triangle =
        anywhere ? random.below(triangles_.size()) : pathEnds_[random.below(pathEnds_.size())];
    const std::uint32_t side = 4 * triangle + (bits >> 8) % 3;
    const std::uint32_t opposite = across(side);
    if (opposite == noSide)
      return change;
    if (isLinked(side)) {
      if (anywhere && isSwap(side))
        change.add(side, opposite);
      return change;
    }
    change.add(side, opposite);
    // A triangle that has two links gives up one of them.
    const auto release = [&](std::uint32_t gained, bool theOneAfter) {
      if (degree(gained / 4) < 2)
        return;
      const std::uint32_t lost = theOneAfter ? after(gained) : before(gained);
      change.add(lost, across(lost));
    };
    release(side, bits & 2);
    release(opposite, bits & 4);
    return change;
  }

  int costOf(const SmallSet<4>& triangles) const {
    int cost = 0;
    for (const std::uint32_t triangle : triangles) {
      if (degree(triangle) < 2) {
        cost += 2 * (2 - degree(triangle));
        continue;
      }
      for (std::uint32_t side = 4 * triangle; side < 4 * triangle + 3; ++side)
        if (isLinked(side) && isSwap(side))
          cost += triangles.has(across(side) / 4) ? 1 : 2;
    }
    return cost;
  }

  /// Links and unlinks; returns what the tips then cost more.
  int toggle(const Change& change) {
    int cost = 0;
    for (const std::uint32_t triangle : change.triangles)
      cost += toggleTip(triangle);
    for (const std::uint32_t side : change.sides)
      for (const std::uint32_t half : {side, across(side)}) {
        std::uint8_t& linked = triangles_[half / 4].linked;
        linked = static_cast<std::uint8_t>(linked ^ 1u << half % 4);
      }
    for (const std::uint32_t triangle : change.triangles)
      cost += toggleTip(triangle);
    return cost;
  }

  int toggleTip(std::uint32_t triangle) {
    if (degree(triangle) != 1)
      return 0;
    const Triangle& end = triangles_[triangle];
    const std::uint32_t tip = end.tips[end.linked / 2]; // bits 1, 2, 4 are sides 0, 1, 2
    oddTips_[tip] = !oddTips_[tip];
    return oddTips_[tip] ? 2 : -2;
  }

  void updatePathEnds(const SmallSet<4>& triangles) {
    for (const std::uint32_t triangle : triangles) {
      const bool isEnd = degree(triangle) < 2;
      std::uint32_t& at = triangles_[triangle].pathEndAt;
      if (isEnd && at == noSide) {
        at = static_cast<std::uint32_t>(pathEnds_.size());
        pathEnds_.push_back(triangle);
      } else if (!isEnd && at != noSide) {
        triangles_[pathEnds_.back()].pathEndAt = at;
        pathEnds_[at] = pathEnds_.back();
        pathEnds_.pop_back();
        at = noSide;
      }
    }
  }

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> pathEnds_; ///< triangles with fewer than two links
  std::vector<std::uint8_t> oddTips_;   ///< by vertex: an odd number of tips lie there
};

/// Cools from where paths form freely to where hardly anything dearer passes.
void anneal(Links& links) {
  constexpr double hot = 2.0, cold = 0.3; // in indices
  constexpr std::size_t stages = 64, stepsPerTriangle = 100;
  Random random;
  for (std::size_t stage = 0; stage < stages; ++stage) {
    const double temperature =
        hot * std::pow(cold / hot, static_cast<double>(stage) / static_cast<double>(stages - 1));
    std::array<std::uint64_t, 24> odds{};
    for (std::size_t cost = 0; cost < odds.size(); ++cost)
      odds[cost] =
          static_cast<std::uint64_t>(std::exp(-0.5 * static_cast<double>(cost) / temperature) * 0x1p32);
    for (std::size_t i = links.triangleCount() * stepsPerTriangle / stages; i > 0; --i)
      links.step(random, odds);
  }
}

/// Reads the paths off the links, rings cut open.
class PathReader {
public:
  PathReader(const Links& links, std::span<const std::uint32_t> corners,
             std::span<const std::uint32_t> across)
      : links_(links), corners_(corners), across_(across), read_(links.triangleCount()) {}

  StripPaths run() && {
    for (std::uint32_t triangle = 0; triangle < read_.size(); ++triangle)
      if (links_.degree(triangle) < 2 && !isDegenerate(triangle))
        read(triangle, noSide);
    for (std::uint32_t triangle = 0; triangle < read_.size(); ++triangle)
      if (links_.degree(triangle) == 2 && !read_[triangle]) {
        const std::uint32_t cut = cutOf(triangle);
        read(cut / 3, cut);
      }
    return std::move(paths_);
  }

private:
  bool isDegenerate(std::uint32_t triangle) const {
    const std::uint32_t* c = &corners_[3 * std::size_t{triangle}];
    return c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
  }

  /// The linked side of a triangle that is not `entered`, or else noSide.
  std::uint32_t otherLink(std::uint32_t triangle, std::uint32_t entered) const {
    for (std::uint32_t i = 0; i < 3; ++i)
      if (3 * triangle + i != entered && links_.isLinked(triangle, i))
        return 3 * triangle + i;
    return noSide;
  }

  /// The side behind which to cut the ring of a triangle: a swap, if it has one.
  std::uint32_t cutOf(std::uint32_t triangle) const {
    const std::uint32_t start = otherLink(triangle, noSide);
    std::uint32_t side = start;
    do {
      if (links_.isSwap(side / 3, side % 3))
        break;
      const std::uint32_t entered = across_[side];
      side = otherLink(entered / 3, entered);
    } while (side != start);
    return across_[side];
  }

  /// The path from `triangle` away from its side `entered`.
  void read(std::uint32_t triangle, std::uint32_t entered) {
    if (read_[triangle])
      return;
    for (;;) {
      read_[triangle] = true;
      const std::uint32_t left = otherLink(triangle, entered);
      paths_.sides.push_back(left != noSide ? left : entered != noSide ? sideAfter(entered) : 3 * triangle);
      if (left == noSide || read_[across_[left] / 3])
        break;
      entered = across_[left];
      triangle = entered / 3;
    }
    paths_.ends.push_back(static_cast<std::uint32_t>(paths_.sides.size()));
  }

  const Links& links_;
  std::span<const std::uint32_t> corners_, across_;
  std::vector<bool> read_;
  StripPaths paths_;
};

} // namespace

StripPaths findStripPaths(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> across,
                          std::size_t vertexCount) {
  Links links(corners, across, vertexCount);
  anneal(links);
  return PathReader(links, corners, across).run();
}

} // namespace imgeo
