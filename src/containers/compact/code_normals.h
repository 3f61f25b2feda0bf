#pragma once
// Encodes and decodes normals as residuals to the normals of the decoded surface, in integers, so that all decoders
// return the same bits: docs/formats/compact.md, "Normals".

#include "containers/compact/code_attributes.h"
#include "containers/compact/number_costs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace imgeo::compact {

/// A point of the octahedron |x| + |y| + |z| = radius: two coordinates are rounded, and the dominant one follows from
/// them.
struct OctahedronPoint {
  int axis = 2, u = 0, v = 1; ///< the dominant axis, the next, the one after
  std::int64_t atU = 0, atV = 0;
  bool isNegative = false; ///< on the dominant axis
};

/// The point in a direction; (0, 0, 1) for a zero vector.
inline OctahedronPoint octahedronPoint(const Vec3i64& direction, std::int64_t radius) {
  OctahedronPoint point;
  point.axis = dominantAxis(direction);
  point.u = (point.axis + 1) % 3;
  point.v = (point.axis + 2) % 3;
  point.isNegative = direction[point.axis] < 0;
  const std::int64_t sum = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
  const auto rounded = [&](std::int64_t component) {
    const std::int64_t size = sum > 0 ? (2 * radius * std::abs(component) + sum) / (2 * sum) : 0;
    return component < 0 ? -size : size;
  };
  point.atU = rounded(direction[point.u]);
  point.atV = rounded(direction[point.v]);
  return point;
}

/// The three coordinates of a point.
inline Value valueOf(const OctahedronPoint& point, std::int64_t radius) {
  const std::int64_t rest = radius - std::abs(point.atU) - std::abs(point.atV);
  Value value;
  value[static_cast<std::uint32_t>(point.u)] = static_cast<std::int32_t>(point.atU);
  value[static_cast<std::uint32_t>(point.v)] = static_cast<std::int32_t>(point.atV);
  value[static_cast<std::uint32_t>(point.axis)] = static_cast<std::int32_t>(point.isNegative ? -rest : rest);
  return value;
}

/// The direction of a point.
inline Vec3d directionOf(const Value& point) {
  return {double(point[0]), double(point[1]), double(point[2])};
}

/// The largest angle, in radians, between a direction and its rounded point. An error of half a step on two axes, and
/// so of a whole step on the third, moves the point by sqrt(3 / 2) steps; its distance from the origin is at least
/// radius / sqrt(3).
inline double octahedronErrorBound(std::uint32_t bits) {
  return std::sqrt(4.5) / ((1 << (bits - 1)) - 1) * 1.001 + 1e-6;
}

/// The sums of the triangle normals around each of the first `limit` wedges. The triangles of a wedge that repeats an
/// earlier one are added to the earlier one.
inline NormalSums sumsOfWedges(const Surface& surface, const std::vector<bool>& repeats, bool isUniform,
                               std::uint32_t limit) {
  const Wedges& wedges = surface.wedges;
  std::vector<std::uint32_t> repeated(wedges.count());
  for (std::uint32_t wedge = 0; wedge < wedges.count(); ++wedge)
    repeated[wedge] = repeats[wedge] ? repeated[wedges.previous[wedge]] : wedge;
  NormalSums sums(wedges.count(), surface.normalShift);
  for (std::size_t corner = 0; corner < wedges.ofCorner.size(); corner += 3) {
    const auto wedge = [&](std::size_t i) { return repeated[wedges.ofCorner[corner + i]]; };
    if (std::min({wedge(0), wedge(1), wedge(2)}) >= limit)
      continue;
    const auto position = [&](std::size_t i) { return surface.positions[surface.connectivity.vertex[corner + i]]; };
    Vec3<std::int32_t> normal = sums.normalOf(position(0), position(1), position(2));
    if (isUniform) {
      const Vec3i64 n(normal);
      const std::int64_t size = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
      for (int axis = 0; axis < 3 && size > 0; ++axis)
        normal[axis] = static_cast<std::int32_t>(4096 * n[axis] / size);
    }
    for (std::size_t i = 0; i < 3; ++i)
      sums.add(wedge(i), normal);
  }
  return sums;
}

/// The cost of codeOtherNormal, in 1/65536 bits, but for the side of the octahedron.
inline std::uint32_t costOfOtherNormal(const Model* models, const OctahedronPoint& point, const Value& value) {
  const auto residual = [&](int axis, std::int64_t at) { return value[static_cast<std::uint32_t>(axis)] - at; };
  const std::int64_t du = residual(point.u, point.atU), dv = residual(point.v, point.atV);
  return costOfSmall(models + attributeModels::first, du) +
         costOfSmall(models + attributeModels::second + numberModels * std::min(lengthInBits(du), 7u), dv);
}

/// Codes a normal that differs from its prediction.
template <typename Coder>
Value codeOtherNormal(Coder& coder, OctahedronPoint point, std::int64_t radius, const Value& value) {
  const auto at = [&](int axis) { return value[static_cast<std::uint32_t>(axis)]; };
  const SignedNumber du = codeSmall(coder, attributeModels::first, at(point.u) - point.atU);
  const std::size_t models = attributeModels::second + numberModels * std::min(du.length, 7u);
  const SignedNumber dv = codeSmall(coder, models, at(point.v) - point.atV);
  point.atU += du.value;
  point.atV += dv.value;
  const std::int64_t rest = radius - std::abs(point.atU) - std::abs(point.atV);
  coder.require(rest >= 0, "a normal lies beyond the octahedron");
  if (rest > 0 && coder.bit(attributeModels::flip, (at(point.axis) < 0) != point.isNegative))
    point.isNegative = !point.isNegative;
  return valueOf(point, radius);
}

/// Accepts no prediction but the value itself.
struct NoTolerance {
  bool accepts(std::uint32_t, const Value&) const { return false; }
  template <typename CostOf>
  Value cheapest(std::uint32_t, const OctahedronPoint&, std::int64_t, const Value& value, CostOf) const {
    return value;
  }
};

/// Codes the normals of all wedges, or of the first `limit` for an encoder that measures their cost. An encoder's
/// `tolerance` accepts predictions that may stand for values (NormalTolerance); `values` become what is stored.
template <typename Coder, typename Tolerance = NoTolerance>
void codeNormals(Coder& coder, const Surface& surface, const AttributeType& type, std::vector<Value>& values,
                 const Tolerance& tolerance = {}, std::uint32_t limit = std::numeric_limits<std::uint32_t>::max()) {
  const Wedges& wedges = surface.wedges;
  const std::int64_t radius = (std::int64_t{1} << (type.bits - 1)) - 1;
  std::vector<bool> repeats(wedges.count());
  if (surface.hasSeams() && !type.isDerived())
    repeats = codeRepeats(coder, surface, values);
  else if (surface.isBase) // seams of a base are seams of the texture only
    for (std::uint32_t wedge = 0; wedge < wedges.count(); ++wedge)
      repeats[wedge] = wedges.previous[wedge] != none;
  const bool hasTriangles = surface.topology == Topology::triangles;
  const bool ofVertices = !surface.hasSeams() && !type.isUniform();
  const NormalSums ofWedges =
      hasTriangles && !ofVertices ? sumsOfWedges(surface, repeats, type.isUniform(), limit) : NormalSums(0, 0);
  const NormalSums& sums = ofVertices ? surface.normalSums : ofWedges;
  const std::uint32_t end = std::min(static_cast<std::uint32_t>(wedges.count()), limit);
  bool isExact = false; // whether the previous normal equals its prediction
  for (std::uint32_t wedge = 0; wedge < end; ++wedge) {
    if (repeats[wedge]) {
      values[wedge] = values[wedges.previous[wedge]];
      continue;
    }
    Vec3i64 direction;
    if (hasTriangles)
      direction = Vec3i64(sums[wedge]);
    else if (wedge > 0)
      direction = {values[wedge - 1][0], values[wedge - 1][1], values[wedge - 1][2]};
    const OctahedronPoint point = octahedronPoint(direction, radius);
    const Value expected = valueOf(point, radius);
    isExact = type.isDerived() || coder.bit(attributeModels::exact + isExact,
                                            values[wedge] == expected || tolerance.accepts(wedge, expected));
    if constexpr (Coder::encodes)
      if (!isExact)
        values[wedge] = tolerance.cheapest(wedge, point, radius, values[wedge], [&](const Value& value) {
          return costOfOtherNormal(coder.models().data(), point, value);
        });
    values[wedge] = isExact ? expected : codeOtherNormal(coder, point, radius, values[wedge]);
  }
}

} // namespace imgeo::compact
