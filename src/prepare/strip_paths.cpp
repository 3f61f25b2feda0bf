// The ends of paths walk about by alternating links (the tunnels of Stewart,
// "Tunneling for triangle strips in continuous level-of-detail meshes", 2001, one
// link long), under simulated annealing (Kirkpatrick et al. 1983) of what the
// strip will cost.

#include "prepare/strip_paths.h"

#include "prepare/dual_graph.h"

#include <array>
#include <bit>
#include <cmath>
#include <utility>

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
class Links {
public:
  Links(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> across,
        std::size_t vertexCount)
      : corners_(corners), across_(across), linked_(corners.size() / 3),
        pathEndAt_(corners.size() / 3, noSide), oddTips_(vertexCount) {
    for (std::uint32_t triangle = 0; triangle < linked_.size(); ++triangle)
      if (!isDegenerate(triangle))
        updatePathEnds({{triangle}, 1});
  }

  /// One random change, kept if it is not dearer or, now and then, if it is:
  /// where `odds` (per unit of cost, 32-bit probabilities) let it pass.
  void step(Random& random, std::span<const std::uint64_t> odds) {
    const Change change = propose(random);
    if (change.sides.size == 0)
      return;
    std::int64_t cost = -costOf(change.triangles);
    toggle(change);
    cost += costOf(change.triangles) + std::exchange(tipCost_, 0);
    const bool kept = cost <= 0 || (cost < static_cast<std::int64_t>(odds.size()) &&
                                    random.bits() < odds[static_cast<std::size_t>(cost)]);
    if (kept) {
      updatePathEnds(change.triangles);
    } else {
      toggle(change);
      tipCost_ = 0;
    }
  }

  std::span<const std::uint32_t> across() const { return across_; }
  std::size_t triangleCount() const { return linked_.size(); }
  int degree(std::uint32_t triangle) const { return std::popcount(linked_[triangle]); }
  bool isLinked(std::uint32_t side) const { return linked_[side / 3] >> side % 3 & 1; }

  bool isDegenerate(std::uint32_t triangle) const {
    const std::uint32_t* c = &corners_[3 * std::size_t{triangle}];
    return c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
  }

  /// Whether both triangles at a linked side have another link and the turns
  /// before and after it go the same way.
  bool isSwap(std::uint32_t side) const {
    const std::uint32_t opposite = across_[side];
    if (degree(side / 3) < 2 || degree(opposite / 3) < 2)
      return false;
    return isLinked(sideAfter(side)) != isLinked(sideAfter(opposite));
  }

private:
  /// Sides to link or unlink, and the triangles on both hands of them.
  struct Change {
    SmallSet<3> sides;
    SmallSet<4> triangles;

    void add(std::uint32_t side, std::uint32_t opposite) {
      if (sides.has(opposite))
        return;
      sides.add(side);
      triangles.add(side / 3);
      triangles.add(opposite / 3);
    }
  };

  Change propose(Random& random) {
    Change change;
    const std::uint32_t bits = random.bits();
    // Half of the time an end of a path moves on, else anything may happen.
    const bool anywhere = bits & 1 || pathEnds_.empty();
    const std::uint32_t side = anywhere ? random.below(across_.size())
                                        : 3 * pathEnds_[random.below(pathEnds_.size())] + (bits >> 8) % 3;
    if (across_[side] == noSide)
      return change;
    if (isLinked(side)) {
      if (anywhere && isSwap(side))
        change.add(side, across_[side]);
      return change;
    }
    change.add(side, across_[side]);
    // A triangle that has two links gives up one of them.
    const auto release = [&](std::uint32_t gained, bool after) {
      if (degree(gained / 3) < 2)
        return;
      const std::uint32_t lost = after ? sideAfter(gained) : sideBefore(gained);
      change.add(lost, across_[lost]);
    };
    release(side, bits & 2);
    release(across_[side], bits & 4);
    return change;
  }

  std::int64_t costOf(const SmallSet<4>& triangles) const {
    std::int64_t cost = 0;
    for (const std::uint32_t triangle : triangles) {
      cost += 2 * (2 - degree(triangle));
      for (std::uint32_t side = 3 * triangle; side < 3 * triangle + 3; ++side)
        if (isLinked(side) && isSwap(side))
          cost += triangles.has(across_[side] / 3) ? 1 : 2;
    }
    return cost;
  }

  void toggle(const Change& change) {
    for (const std::uint32_t triangle : change.triangles)
      toggleTip(triangle);
    for (const std::uint32_t side : change.sides)
      for (const std::uint32_t half : {side, across_[side]})
        linked_[half / 3] = static_cast<std::uint8_t>(linked_[half / 3] ^ 1u << half % 3);
    for (const std::uint32_t triangle : change.triangles)
      toggleTip(triangle);
  }

  void toggleTip(std::uint32_t triangle) {
    if (degree(triangle) != 1)
      return;
    const auto side = 3 * triangle + static_cast<std::uint32_t>(std::countr_zero(linked_[triangle]));
    const std::uint32_t tip = corners_[sideBefore(side)];
    oddTips_[tip] = !oddTips_[tip];
    tipCost_ += oddTips_[tip] ? 2 : -2;
  }

  void updatePathEnds(const SmallSet<4>& triangles) {
    for (const std::uint32_t triangle : triangles) {
      const bool isEnd = degree(triangle) < 2;
      std::uint32_t& at = pathEndAt_[triangle];
      if (isEnd && at == noSide) {
        at = static_cast<std::uint32_t>(pathEnds_.size());
        pathEnds_.push_back(triangle);
      } else if (!isEnd && at != noSide) {
        pathEndAt_[pathEnds_.back()] = at;
        pathEnds_[at] = pathEnds_.back();
        pathEnds_.pop_back();
        at = noSide;
      }
    }
  }

  std::span<const std::uint32_t> corners_, across_;
  std::vector<std::uint8_t> linked_;     ///< by triangle: a bit for each linked side
  std::vector<std::uint32_t> pathEnds_;  ///< triangles with fewer than two links
  std::vector<std::uint32_t> pathEndAt_; ///< by triangle: its place in pathEnds_, or noSide
  std::vector<std::uint8_t> oddTips_;    ///< by vertex: an odd number of tips lie there
  std::int64_t tipCost_ = 0;             ///< of the changes to oddTips_ since it was last read
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

/// The linked side of a triangle that is not `entered`, or else noSide.
std::uint32_t otherLink(const Links& links, std::uint32_t triangle, std::uint32_t entered) {
  for (std::uint32_t side = 3 * triangle; side < 3 * triangle + 3; ++side)
    if (side != entered && links.isLinked(side))
      return side;
  return noSide;
}

/// Where to cut a ring: behind a swap, if it has one.
std::uint32_t cutOf(const Links& links, std::uint32_t triangle) {
  const std::uint32_t start = otherLink(links, triangle, noSide);
  std::uint32_t side = start;
  do {
    if (links.isSwap(side))
      break;
    const std::uint32_t entered = links.across()[side];
    side = otherLink(links, entered / 3, entered);
  } while (side != start);
  return links.across()[side];
}

class PathReader {
public:
  explicit PathReader(const Links& links) : links_(links), read_(links.triangleCount()) {}

  StripPaths run() && {
    for (std::uint32_t triangle = 0; triangle < read_.size(); ++triangle)
      if (links_.degree(triangle) < 2 && !links_.isDegenerate(triangle))
        read(triangle, noSide);
    for (std::uint32_t triangle = 0; triangle < read_.size(); ++triangle)
      if (links_.degree(triangle) == 2 && !read_[triangle]) {
        const std::uint32_t cut = cutOf(links_, triangle);
        read(cut / 3, cut);
      }
    return std::move(paths_);
  }

private:
  /// The path from `triangle` away from its side `entered`.
  void read(std::uint32_t triangle, std::uint32_t entered) {
    if (read_[triangle])
      return;
    for (;;) {
      read_[triangle] = true;
      const std::uint32_t left = otherLink(links_, triangle, entered);
      const bool isLast = left == noSide || read_[links_.across()[left] / 3];
      paths_.sides.push_back(left != noSide ? left : entered != noSide ? sideAfter(entered) : 3 * triangle);
      if (isLast)
        break;
      entered = links_.across()[left];
      triangle = entered / 3;
    }
    paths_.ends.push_back(static_cast<std::uint32_t>(paths_.sides.size()));
  }

  const Links& links_;
  std::vector<bool> read_;
  StripPaths paths_;
};

} // namespace

StripPaths findStripPaths(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> across,
                          std::size_t vertexCount) {
  Links links(corners, across, vertexCount);
  anneal(links);
  return PathReader(links).run();
}

} // namespace imgeo
