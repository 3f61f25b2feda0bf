// Blocked Gibbs sampling (Geman and Geman, "Stochastic relaxation, Gibbs distributions, and the Bayesian restoration of
// images", 1984) with vertex stars as blocks. The spokes of a star, which are the edges at its centre, form a cyclic
// chain in which the cost of a spoke depends on its two neighbours. So all spokes can be sampled at once by forward
// filtering and backward sampling (Carter and Kohn, "On Gibbs sampling for state space models", 1994).

#include "prepare/strip_links.h"

#include "prepare/half_edges.h"

#include <algorithm>

namespace imgeo {

namespace {

// In quarters of an index.
constexpr std::uint32_t endCost = 5, swapCost = 4, oddCost = 4;

constexpr std::array<std::uint8_t, 8> bitCounts{0, 1, 1, 2, 1, 2, 2, 3};

constexpr std::uint32_t after(std::uint32_t side) {
  return side == 2 ? 0 : side + 1;
}
constexpr std::uint32_t before(std::uint32_t side) {
  return side == 0 ? 2 : side - 1;
}

/// By the bits of a triangle's linked sides, and a side: 1 where the triangle's other link is at the side after it, 2
/// at the side before; 0 where the side is not linked or the only linked one.
constexpr std::uint8_t turns[8][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {1, 2, 0},
                                      {0, 0, 0}, {2, 0, 1}, {0, 1, 2}, {0, 0, 0}};

/// State of a triangle of a star apart from its two spokes. Its outer side is not linked, or is linked to a triangle
/// whose path ends there or continues at the side after or before it; or the triangle is missing, since the fan is
/// open.
enum Outer : std::uint8_t { outerFree, outerLinked, outerTurnsAfter, outerTurnsBefore, noTriangle, outerKinds };

bool hasOuterLink(std::uint32_t outer) {
  return outer != outerFree;
}

/// values[cost] is factor^cost.
struct Powers {
  explicit Powers(float factor) {
    float power = 1;
    for (float& value : values) {
      value = power;
      power *= factor;
    }
  }
  std::array<float, 32> values;
};

/// The weights of all states of a triangle and of a spoke, for one factor.
struct WeightTables {
  explicit WeightTables(float factor) {
    const Powers powers(factor);
    for (std::uint32_t outer = 0; outer < outerKinds; ++outer)
      for (std::uint32_t spokes = 0; spokes < 4; ++spokes)
        ofTriangle[outer][spokes] = triangleWeight(powers, outer, spokes & 1, spokes >> 1);
    for (std::uint32_t kind = 0; kind < 8; ++kind)
      for (std::uint32_t links = 0; links < 8; ++links)
        ofSpoke[kind][links] = powers.values[spokeCost(kind & 1, kind >> 1 & 1, kind >> 2, links)];
    odd = powers.values[oddCost];
  }

  /// Weight of a triangle: the path ends that it forms, and a swap at its outer side. 0: not allowed. `first` and
  /// `second` are 1 if its first and second spoke are linked.
  static float triangleWeight(const Powers& powers, std::uint32_t outer, std::uint32_t first, std::uint32_t second) {
    if (outer == noTriangle)
      return first + second == 0 ? 1.0f : 0.0f;
    const std::uint32_t degree = first + second + hasOuterLink(outer);
    if (degree > 2)
      return 0;
    const bool isSwap = degree == 2 && ((outer == outerTurnsAfter && first) || (outer == outerTurnsBefore && second));
    return powers.values[endCost * (2 - degree) + (isSwap ? swapCost : 0)];
  }

  /// Cost of a spoke: a swap there, or an odd number of tips at its outer vertex. `areOthersOdd`: the number of tips of
  /// other paths there is odd. Bits of `links`: the previous spoke, the spoke itself and the next one.
  static std::uint32_t spokeCost(bool hasPreviousOuter, bool hasNextOuter, std::uint32_t areOthersOdd,
                                 std::uint32_t links) {
    const bool previous = links & 1, here = links >> 1 & 1, next = links >> 2 & 1;
    if (here) {
      const int previousTurn = previous ? 1 : hasPreviousOuter ? 2 : 0, nextTurn = hasNextOuter ? 1 : next ? 2 : 0;
      const bool isSwap = previousTurn != 0 && nextTurn != 0 && previousTurn != nextTurn;
      return (isSwap ? swapCost : 0) + (areOthersOdd ? oddCost : 0);
    }
    const std::uint32_t tips = (previous && !hasPreviousOuter) + (next && !hasNextOuter);
    return (areOthersOdd + tips) % 2 * oddCost;
  }

  float ofTriangle[outerKinds][4];
  float ofSpoke[8][8]; ///< by the first three arguments of spokeCost as bits, then by its `links`
  float odd;
};

} // namespace

/// Samples the spokes of one star. Spoke i is between triangles i - 1 and i. In a number that holds the states of
/// several spokes, bit 0 is the state of the first.
class StripLinks::StarSampler {
public:
  StarSampler(StripLinks& links, const Star& star) : links_(links), size_(star.size) {
    std::uint32_t at = star.corner;
    const std::uint32_t count = size_ - star.isOpen;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t index = at / 4, firstSide = at % 4, secondSide = before(firstSide), outer = after(firstSide);
      const Triangle& triangle = links_.triangles_[index];
      links_.toggleTip(index); // removes its tip; run() adds the new one
      triangleIndices_[i] = index;
      firstSpokeSides_[i] = firstSide;
      outers_[i] = outerFree;
      if (triangle.linked >> outer & 1) {
        const std::uint32_t opposite = triangle.across[outer];
        outers_[i] = static_cast<Outer>(outerLinked + turns[links_.triangles_[opposite / 4].linked][opposite % 4]);
      }
      farOdd_[i] = links_.oddTips_[links_.corners_[3 * index + outer]];
      at = triangle.across[secondSide];
    }
    if (star.isOpen) {
      const std::uint32_t last = triangleIndices_[count - 1];
      outers_[count] = noTriangle;
      farOdd_[count] = links_.oddTips_[links_.corners_[3 * last + before(firstSpokeSides_[count - 1])]];
    }
    count_ = count;
    center_ = links_.corners_[3 * (star.corner / 4) + star.corner % 4];
  }

  void run(const WeightTables& tables, XorShift64Star& random) {
    weigh(tables);
    sumForward();
    if (sampleBackward(links_.oddTips_[center_], tables.odd, random))
      write();
    for (std::uint32_t i = 0; i < count_; ++i)
      links_.toggleTip(triangleIndices_[i]);
  }

private:
  /// weights_[i][l] is the weight of spoke i and triangle i; bits of l: spokes i - 1, i and i + 1.
  void weigh(const WeightTables& tables) {
    for (std::uint32_t i = 0; i < size_; ++i) {
      const std::uint32_t previous = i == 0 ? size_ - 1 : i - 1;
      const float* spoke =
          tables.ofSpoke[hasOuterLink(outers_[previous]) | hasOuterLink(outers_[i]) << 1 | farOdd_[i] << 2];
      const float* triangle = tables.ofTriangle[outers_[i]];
      for (std::uint32_t l = 0; l < 8; ++l)
        weights_[i][l] = spoke[l] * triangle[l >> 1];
      // A triangle whose outer side alone is linked has its tip at the centre.
      isTipAtCenter_[i] = outers_[i] != outerFree && outers_[i] != noTriangle;
    }
  }

  /// sums_[i][p][s][lane] is the sum of the weights of all states of the spokes before i, given that spokes i - 1 and i
  /// are s, the number of tips at the centre has parity p, and spokes 0 and 1 are `lane`.
  void sumForward() {
    for (auto& row : sums_[1])
      for (auto& lanes : row)
        lanes = {};
    for (std::uint32_t lane = 0; lane < 4; ++lane)
      sums_[1][0][lane][lane] = 1;
    for (std::uint32_t i = 1; i + 1 < size_; ++i)
      for (std::uint32_t p = 0; p < 2; ++p)
        for (std::uint32_t s = 0; s < 4; ++s) {
          const std::uint32_t from = p ^ (s == 0 && isTipAtCenter_[i]);
          const std::uint32_t here = s & 1;
          const Lanes &free = sums_[i][from][here << 1], &linked = sums_[i][from][here << 1 | 1];
          const float freeWeight = weights_[i][s << 1], linkedWeight = weights_[i][s << 1 | 1];
          for (std::uint32_t lane = 0; lane < 4; ++lane)
            sums_[i + 1][p][s][lane] = free[lane] * freeWeight + linked[lane] * linkedWeight;
        }
  }

  /// Samples the spokes; false where all weights are 0.
  bool sampleBackward(std::uint32_t centerOdd, float oddWeight, XorShift64Star& random) {
    const std::uint32_t last = size_ - 1;
    std::array<float, 32> ends{}; // by parity, the last two spokes and the first two
    float total = 0;
    for (std::uint32_t n = 0; n < 32; ++n) {
      const std::uint32_t lane = n & 3, s = n >> 2 & 3, p = n >> 4;
      const std::uint32_t first = lane & 1, second = lane >> 1, lastSpoke = s >> 1;
      const bool tipOfLast = lastSpoke == 0 && first == 0 && isTipAtCenter_[last];
      const bool tipOfFirst = lane == 0 && isTipAtCenter_[0];
      const bool isOdd = (centerOdd + p + tipOfLast + tipOfFirst) % 2;
      ends[n] = sums_[last][p][s][lane] * weights_[last][s | first << 2] *
                weights_[0][lastSpoke | first << 1 | second << 2] * (isOdd ? oddWeight : 1);
      total += ends[n];
    }
    if (!(total > 0))
      return false;
    float rest = total * random.uniform();
    std::uint32_t picked = 32;
    for (std::uint32_t n = 0; n < 32 && (picked == 32 || rest >= 0); ++n)
      if (ends[n] > 0) {
        picked = n;
        rest -= ends[n];
      }
    const std::uint32_t lane = picked & 3;
    std::uint32_t s = picked >> 2 & 3, p = picked >> 4;
    spokes_[last] = s >> 1;
    spokes_[last - 1] = s & 1;
    for (std::uint32_t i = last - 1; i >= 1; --i) {
      const std::uint32_t from = p ^ (s == 0 && isTipAtCenter_[i]);
      const std::uint32_t here = s & 1;
      const float free = sums_[i][from][here << 1][lane] * weights_[i][s << 1];
      const float linked = sums_[i][from][here << 1 | 1][lane] * weights_[i][s << 1 | 1];
      const std::uint32_t sampled = random.uniform() * (free + linked) >= free;
      spokes_[i - 1] = sampled;
      s = here << 1 | sampled;
      p = from;
    }
    return true;
  }

  void write() {
    for (std::uint32_t i = 0; i < count_; ++i) {
      const std::uint32_t firstSide = firstSpokeSides_[i];
      const std::uint32_t next = i + 1 == size_ ? 0 : i + 1;
      links_.triangles_[triangleIndices_[i]].linked = spokes_[i] << firstSide | spokes_[next] << before(firstSide) |
                                                      std::uint32_t{outers_[i] != outerFree} << after(firstSide);
    }
  }

  using Lanes = std::array<float, 4>;

  StripLinks& links_;
  std::uint32_t size_, count_, center_;
  std::array<std::uint32_t, maxStarSize> triangleIndices_; ///< indices of the triangles
  std::array<std::uint32_t, maxStarSize> firstSpokeSides_; ///< by triangle: the side that is its first spoke
  std::array<std::uint8_t, maxStarSize> outers_;           ///< by triangle: Outer
  std::array<std::uint8_t, maxStarSize> farOdd_; ///< by spoke: tips of other paths at its outer vertex are odd
  std::array<bool, maxStarSize> isTipAtCenter_;
  std::array<std::array<float, 8>, maxStarSize> weights_;
  Lanes sums_[maxStarSize][2][4];
  std::array<std::uint32_t, maxStarSize> spokes_;
};

StripLinks::StripLinks(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> across,
                       std::size_t vertexCount)
    : triangles_(corners.size() / 3), corners_(corners), oddTips_(vertexCount) {
  for (std::uint32_t side = 0; side < corners.size(); ++side)
    triangles_[side / 3].across[side % 3] =
        across[side] == noHalfEdge ? noHalfEdge : 4 * (across[side] / 3) + across[side] % 3;
  findStars(across);
}

/// Walks around each vertex by opposite half-edges: half-edge 3t + s begins at corner s of triangle t; the previous
/// triangle around that corner is across this half-edge, the next one across the half-edge that ends there.
void StripLinks::findStars(std::span<const std::uint32_t> across) {
  std::vector<bool> isFound(corners_.size());
  for (std::uint32_t corner = 0; corner < corners_.size(); ++corner) {
    if (isFound[corner])
      continue;
    std::uint32_t first = corner;
    while (across[first] != noHalfEdge && nextHalfEdge(across[first]) != corner)
      first = nextHalfEdge(across[first]);
    const bool isOpen = across[first] == noHalfEdge;
    Star star{4 * (first / 3) + first % 3, isOpen, isOpen};
    for (std::uint32_t at = first; at != noHalfEdge && !isFound[at]; at = across[previousHalfEdge(at)]) {
      isFound[at] = true;
      ++star.size;
    }
    if (star.size >= 3 && star.size <= maxStarSize)
      stars_.push_back(star);
  }
}

void StripLinks::resample(float factor, XorShift64Star& random) {
  const WeightTables tables(factor);
  for (const Star& star : stars_)
    StarSampler(*this, star).run(tables, random);
}

std::uint32_t StripLinks::degree(std::uint32_t triangle) const {
  return bitCounts[triangles_[triangle].linked];
}

bool StripLinks::isSwap(std::uint32_t triangle, std::uint32_t side) const {
  const std::uint32_t opposite = triangles_[triangle].across[side];
  return (turns[triangles_[triangle].linked][side] ^ turns[triangles_[opposite / 4].linked][opposite % 4]) == 3;
}

/// Adds the tip of a triangle with exactly one link to its vertex, or removes it. Returns the change of cost.
int StripLinks::toggleTip(std::uint32_t triangle) {
  const std::uint32_t linked = triangles_[triangle].linked;
  if (bitCounts[linked] != 1)
    return 0;
  std::uint8_t& isOdd = oddTips_[corners_[3 * triangle + before(linked / 2)]]; // bits 1, 2, 4 are sides 0, 1, 2
  isOdd ^= 1;
  return isOdd ? int{oddCost} : -int{oddCost};
}

/// Cost of the path ends and swaps at the triangles of a change, without tips.
int StripLinks::costAt(const Change& change) const {
  int cost = 0;
  const auto isIn = [&](std::uint32_t triangle, std::uint32_t count) {
    return std::find(change.triangles.begin(), change.triangles.begin() + count, triangle) !=
           change.triangles.begin() + count;
  };
  for (std::uint32_t i = 0; i < change.triangleCount; ++i) {
    const std::uint32_t triangle = change.triangles[i];
    cost += int{endCost} * (2 - static_cast<int>(degree(triangle)));
    for (std::uint32_t side = 0; side < 3; ++side) // a link between two triangles of the change counts once
      if (isLinked(triangle, side) && isSwap(triangle, side) && !isIn(triangles_[triangle].across[side] / 4, i))
        cost += swapCost;
  }
  return cost;
}

/// Links or unlinks the sides of a change. Returns the change of the cost of tips.
int StripLinks::toggle(const Change& change) {
  int cost = 0;
  for (std::uint32_t i = 0; i < change.triangleCount; ++i)
    cost += toggleTip(change.triangles[i]);
  for (std::uint32_t i = 0; i < change.sideCount; ++i)
    for (const std::uint32_t half : {change.sides[i], triangles_[change.sides[i] / 4].across[change.sides[i] % 4]})
      triangles_[half / 4].linked ^= 1u << half % 4;
  for (std::uint32_t i = 0; i < change.triangleCount; ++i)
    cost += toggleTip(change.triangles[i]);
  return cost;
}

/// The linked side of a triangle other than `besides`, or noHalfEdge.
std::uint32_t StripLinks::linkedSide(std::uint32_t triangle, std::uint32_t besides) const {
  for (std::uint32_t side = 4 * triangle; side < 4 * triangle + 3; ++side)
    if (side != besides && isLinked(triangle, side % 4))
      return side;
  return noHalfEdge;
}

void StripLinks::breakCycles() {
  std::vector<bool> isSeen(triangles_.size());
  std::vector<std::uint32_t> sides; // of the triangles of a path or cycle: the side that leads to the next triangle
  const auto walk = [&](std::uint32_t triangle) {
    sides.clear();
    for (std::uint32_t entered = noHalfEdge; !isSeen[triangle];) {
      isSeen[triangle] = true;
      const std::uint32_t side = linkedSide(triangle, entered);
      if (side == noHalfEdge)
        break;
      sides.push_back(side);
      entered = triangles_[triangle].across[side % 4];
      triangle = entered / 4;
    }
  };
  for (std::uint32_t triangle = 0; triangle < triangles_.size(); ++triangle)
    if (degree(triangle) < 2)
      walk(triangle);
  for (std::uint32_t triangle = 0; triangle < triangles_.size(); ++triangle)
    if (!isSeen[triangle]) {
      walk(triangle);
      breakCycle(sides);
    }
}

/// `cycle` has the side of each triangle that leads to the next one.
void StripLinks::breakCycle(std::span<const std::uint32_t> cycle) {
  Change best;
  int bestCost = 0;
  const auto consider = [&](const Change& change) {
    int cost = -costAt(change);
    cost += toggle(change);
    cost += costAt(change);
    toggle(change);
    if (best.sideCount == 0 || cost < bestCost)
      bestCost = cost, best = change;
  };
  for (const std::uint32_t side : cycle) {
    const std::uint32_t triangle = side / 4, next = triangles_[triangle].across[side % 4];
    consider({{side}, {triangle, next / 4}, 1, 2});
    for (const auto& [joined, other] : {std::pair(triangle, next / 4), std::pair(next / 4, triangle)})
      for (std::uint32_t free = 0; free < 3; ++free) {
        const std::uint32_t beside = triangles_[joined].across[free];
        if (!isLinked(joined, free) && beside != noHalfEdge && degree(beside / 4) < 2)
          consider({{side, beside}, {joined, other, beside / 4}, 2, 3});
      }
  }
  toggle(best);
}

} // namespace imgeo
