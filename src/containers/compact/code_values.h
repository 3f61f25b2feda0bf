#pragma once
// Encodes and decodes texture coordinates, colours and other attributes, predicted from neighbouring wedges:
// docs/formats/compact.md. Texture coordinates follow Isenburg and Snoeyink, "Compressing texture coordinates with
// selective linear predictions", 2003, and Váša and Brunnett, "Efficient encoding of texture coordinates guided by mesh
// geometry", 2014.

#include "containers/compact/code_attributes.h"

#include <cmath>
#include <limits>

namespace imgeo::compact {

/// Floor of a quotient; the divisor is positive.
inline std::int64_t floorDivide(std::int64_t numerator, std::int64_t divisor) {
  return numerator / divisor - (numerator % divisor < 0);
}

/// Floor of a square root of 0 .. 2^53.
inline std::int64_t integerSqrt(std::int64_t square) {
  auto root = static_cast<std::int64_t>(std::sqrt(static_cast<double>(square)));
  while (root * root > square)
    --root;
  while ((root + 1) * (root + 1) <= square)
    ++root;
  return root;
}

/// The coordinates of corner c relative to the edge a -> b: `along` it and `beside` it, as fractions of the edge with
/// the denominator `unit`.
struct EdgeFrame {
  std::int64_t along = 0, beside = 0, unit = 0;

  EdgeFrame(const Vec3u& a, const Vec3u& b, const Vec3u& c) {
    Vec3i64 e = Vec3i64(b) - Vec3i64(a), f = Vec3i64(c) - Vec3i64(a);
    const std::uint32_t length = lengthInBits(std::max(largestComponent(e), largestComponent(f)));
    for (int axis = 0; axis < 3 && length > 12; ++axis) {
      e[axis] >>= length - 12;
      f[axis] >>= length - 12;
    }
    unit = dot(e, e);
    along = dot(e, f);
    beside = integerSqrt(unit * dot(f, f) - along * along);
  }
};

template <typename Coder> class ValueCoder {
public:
  /// `values` are the source of an encoder; a decoder fills them.
  ValueCoder(Coder& coder, const Surface& surface, const AttributeType& type, std::vector<Value>& values)
      : coder_(coder), surface_(surface), type_(type), maximum_((1 << type.bits) - 1), values_(values) {}

  void run() {
    const Wedges& wedges = surface_.wedges;
    std::vector<bool> repeats(wedges.count());
    if (surface_.hasSeams())
      repeats = codeRepeats(coder_, surface_, values_);
    std::uint32_t latest = 0;
    for (std::uint32_t wedge = 0; wedge < wedges.count(); ++wedge) {
      if (repeats[wedge]) {
        values_[wedge] = values_[wedges.previous[wedge]];
        continue;
      }
      const ValueCandidates candidates = candidatesFor(wedge);
      std::uint32_t choice = 0;
      if constexpr (Coder::encodes)
        choice = cheapest(candidates, latest, values_[wedge]);
      choice = codeChoice(coder_, candidates, latest, choice);
      codeValue(coder_, candidates.values[choice], values_[wedge]);
      latest = choice;
    }
  }

private:
  struct ValueCandidates {
    std::array<Value, 3> values;
    std::uint32_t count = 0;

    void add(const Value& value) { values[count++] = value; }
    /// 0: one candidate; 1: two from an edge; 2: the parallelogram as well.
    std::uint32_t set() const { return count - 1; }
  };

  ValueCandidates candidatesFor(std::uint32_t wedge) const {
    const Wedges& wedges = surface_.wedges;
    const std::uint32_t corner = wedges.corner[wedge];
    std::uint32_t a = none, b = none; // the neighbours whose values are known
    if (surface_.topology == Topology::triangles) {
      a = knownAt(after(corner), wedge);
      b = knownAt(before(corner), wedge);
    } else if (surface_.topology == Topology::lines && corner % 2 == 1) {
      a = knownAt(corner - 1, wedge);
    }
    ValueCandidates candidates;
    if (a != none && b != none) {
      if (type_.kind == AttributeKind::texCoord)
        addSides(candidates, wedge, a, b);
      else
        candidates.add(combine([&](std::uint32_t i) { return (values_[a][i] + values_[b][i]) >> 1; }));
      addParallelogram(candidates, corner, a, b);
    } else if (a != none || b != none) {
      candidates.add(values_[a != none ? a : b]);
    } else {
      candidates.add(wedge > 0 ? values_[wedge - 1] : combine([&](std::uint32_t) { return 1 << (type_.bits - 1); }));
    }
    return candidates;
  }

  std::uint32_t knownAt(std::uint32_t corner, std::uint32_t wedge) const {
    const std::uint32_t neighbour = surface_.wedges.ofCorner[corner];
    return neighbour < wedge ? neighbour : none;
  }

  template <typename Component> Value combine(Component component) const {
    Value value;
    for (std::uint32_t i = 0; i < type_.components; ++i)
      value[i] = component(i);
    return value;
  }

  /// Adds two candidates: the triangle keeps its shape in texture space, on one side of its edge or on the other.
  void addSides(ValueCandidates& candidates, std::uint32_t wedge, std::uint32_t a, std::uint32_t b) const {
    const auto positionOf = [&](std::uint32_t w) { return surface_.positions[surface_.wedges.vertex[w]]; };
    const EdgeFrame frame(positionOf(a), positionOf(b), positionOf(wedge));
    const std::int64_t u = values_[b][0] - values_[a][0], v = values_[b][1] - values_[a][1];
    for (const std::int64_t beside : {frame.beside, -frame.beside}) {
      if (frame.unit == 0) {
        candidates.add(values_[a]);
        continue;
      }
      const auto moved = [&](std::int64_t from, std::int64_t by) {
        const std::int64_t to = from + floorDivide(2 * by + frame.unit, 2 * frame.unit);
        return static_cast<std::int32_t>(std::clamp<std::int64_t>(to, 0, maximum_));
      };
      candidates.add(
          {{moved(values_[a][0], frame.along * u - beside * v), moved(values_[a][1], frame.along * v + beside * u)}});
    }
  }

  /// Adds the candidate of the parallelogram if the attribute continues across the triangle's first edge.
  void addParallelogram(ValueCandidates& candidates, std::uint32_t corner, std::uint32_t a, std::uint32_t b) const {
    if (corner % 3 != 2)
      return;
    const std::uint32_t across = surface_.connectivity.across[corner / 3];
    const std::vector<std::uint32_t>& ofCorner = surface_.wedges.ofCorner;
    if (across != none && ofCorner[after(across)] == b && ofCorner[before(across)] == a)
      candidates.add(
          combine([&](std::uint32_t i) { return values_[a][i] + values_[b][i] - values_[ofCorner[across]][i]; }));
  }

  std::uint32_t cheapest(const ValueCandidates& candidates, std::uint32_t latest, Value value) {
    std::uint32_t best = 0;
    std::uint32_t minCost = std::numeric_limits<std::uint32_t>::max();
    for (std::uint32_t i = 0; i < candidates.count && candidates.count > 1; ++i) {
      CostMeter meter(coder_, minCost);
      codeChoice(meter, candidates, latest, i);
      codeValue(meter, candidates.values[i], value);
      if (meter.cost() < minCost)
        minCost = meter.cost(), best = i;
    }
    return best;
  }

  template <typename C>
  static std::uint32_t codeChoice(C& coder, const ValueCandidates& candidates, std::uint32_t latest,
                                  std::uint32_t choice) {
    const std::size_t models = attributeModels::choice + (candidates.set() * 4 + latest) * 2;
    std::uint32_t i = 0;
    while (i + 1 < candidates.count && !coder.bit(models + i, i == choice))
      ++i;
    return i;
  }

  template <typename C> void codeValue(C& coder, const Value& guess, Value& value) const {
    static constexpr std::uint32_t colorOrder[] = {1, 0, 2, 3}, plainOrder[] = {0, 1, 2, 3};
    const bool isColor = type_.kind == AttributeKind::color;
    std::int32_t green = 0;
    std::uint32_t length = 0;
    for (std::uint32_t j = 0; j < type_.components; ++j) {
      const std::uint32_t i = (isColor ? colorOrder : plainOrder)[j];
      std::int32_t expected = std::clamp(guess[i], 0, maximum_);
      if (isColor && (j == 1 || j == 2))
        expected += green;
      const std::size_t models =
          j == 0 ? attributeModels::first : attributeModels::second + numberModels * (31 * (j - 1) + length);
      const SignedNumber residual = codeSigned(coder, models, value[i] - expected);
      length = residual.length;
      if (j == 0)
        green = residual.value;
      value[i] = expected + residual.value;
      coder.require(value[i] >= 0 && value[i] <= maximum_, "an attribute lies outside of its range");
    }
  }

  Coder& coder_;
  const Surface& surface_;
  AttributeType type_;
  std::int32_t maximum_;
  std::vector<Value>& values_;
};

} // namespace imgeo::compact
