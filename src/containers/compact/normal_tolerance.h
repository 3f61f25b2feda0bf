#pragma once
// Normals that need no bytes: an encoder may store a prediction instead of a normal if the angle between the two is at
// most the largest error of rounding.

#include "containers/compact/code_normals.h"

#include <cmath>
#include <utility>
#include <vector>

namespace imgeo::compact {

class NormalTolerance {
public:
  /// `values` and `sources` are those of the wedges in coded order. Without `sources` the values are exact, and no
  /// prediction stands for another value.
  NormalTolerance(const Surface& surface, const AttributeType& type, const std::vector<Value>& values,
                  std::vector<Vec3f> sources)
      : sources_(std::move(sources)), maxSine_(std::sin(octahedronErrorBound(type.bits))) {
    if (surface.topology != Topology::triangles)
      sources_.clear();
    if (sources_.empty())
      return;
    keepShared(surface.wedges, values);
    keepBorder(surface);
  }

  /// The point that stands for the normal `value` of a wedge at the lowest cost: on the way from the prediction, which
  /// is not accepted, to the value. costOf(point) is compared among points that are accepted, and the value.
  template <typename CostOf>
  Value cheapest(std::uint32_t wedge, const OctahedronPoint& predicted, std::int64_t radius, const Value& value,
                 CostOf costOf) const {
    if (sources_.empty() || sources_[wedge] == Vec3f{})
      return value;
    const auto at = [&](int axis) { return std::int64_t{value[static_cast<std::uint32_t>(axis)]}; };
    OctahedronPoint point = predicted;
    point.isNegative = at(point.axis) < 0;
    const std::int64_t u = at(point.u), v = at(point.v);
    // A value far from its prediction is rare, and points near to the prediction are not accepted then.
    if (std::abs(u - predicted.atU) > farthest || std::abs(v - predicted.atV) > farthest)
      return value;
    Value best = value;
    auto minCost = costOf(value);
    const std::int64_t stepU = u < predicted.atU ? -1 : 1, stepV = v < predicted.atV ? -1 : 1;
    for (point.atU = predicted.atU;; point.atU += stepU) {
      for (point.atV = predicted.atV;; point.atV += stepV) {
        if (std::abs(point.atU) + std::abs(point.atV) <= radius) {
          const Value candidate = valueOf(point, radius);
          if (const auto cost = costOf(candidate); cost < minCost && accepts(wedge, candidate))
            minCost = cost, best = candidate;
        }
        if (point.atV == v)
          break;
      }
      if (point.atU == u)
        break;
    }
    return best;
  }

  /// Whether a prediction, a point of the octahedron, may stand for the normal of a wedge.
  bool accepts(std::uint32_t wedge, const Value& predicted) const {
    if (sources_.empty())
      return false;
    // The sine, unlike the cosine, is precise for small angles.
    const Vec3d direction = directionOf(predicted), source(sources_[wedge]);
    return dot(direction, source) > 0 &&
           length(cross(direction, source)) <= maxSine_ * length(direction) * length(source);
  }

private:
  /// Wedges of a vertex whose normals differ and round to the same value share it: they keep that value.
  void keepShared(const Wedges& wedges, const std::vector<Value>& values) {
    std::vector<std::uint32_t> first(values.size()); // the first wedge in a row of wedges that repeat a value
    for (std::uint32_t wedge = 0; wedge < first.size(); ++wedge) {
      const std::uint32_t previous = wedges.previous[wedge];
      const bool repeats = previous != none && values[wedge] == values[previous];
      first[wedge] = repeats ? first[previous] : wedge;
      if (repeats && sources_[wedge] != sources_[previous])
        sources_[first[wedge]] = {};
    }
  }

  /// Vertices at the border of a patch are also vertices of its neighbour, which predicts another normal. Both keep the
  /// rounded one, so that no edge is seen there.
  void keepBorder(const Surface& surface) {
    const std::vector<std::uint32_t>& vertex = surface.connectivity.vertex;
    // Around an inner vertex each neighbour follows it in one triangle and precedes it in another: their sum is 0.
    std::vector<std::uint32_t> sums(surface.positions.size());
    const auto mixed = [](std::uint32_t index) { return (index + 1) * (0x9e3779b1u ^ index << 15); };
    for (std::size_t first = 0; first < vertex.size(); first += 3)
      for (std::size_t i = 0; i < 3; ++i)
        sums[vertex[first + i]] += mixed(vertex[first + (i + 1) % 3]) - mixed(vertex[first + (i + 2) % 3]);
    for (std::uint32_t wedge = 0; wedge < sources_.size(); ++wedge)
      if (sums[surface.wedges.vertex[wedge]] != 0)
        sources_[wedge] = {};
  }

  static constexpr std::int64_t farthest = 8; ///< steps of an axis

  std::vector<Vec3f> sources_; ///< zero: a normal whose value is kept
  double maxSine_;             ///< of the largest angle
};

} // namespace imgeo::compact
