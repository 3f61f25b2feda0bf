#include "prepare/instances/congruence.h"

#include "base/shortest_decimal.h"
#include "prepare/index_hash_table.h"
#include "prepare/instances/best_rotation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace imgeo {

namespace {

/// At most so many pairs of vertices are tried.
constexpr std::size_t minCandidates = 4, maxCandidates = 256;

/// So many vertices in all these tries together, beyond minCandidates.
constexpr std::size_t maxVerticesTried = std::size_t{1} << 23;

/// The shares of the tolerance that rounding to decimals may take: the second where the first takes too much.
constexpr double roundingShares[] = {1.0 / 8, 1.0 / 32};

std::uint64_t bitsOf(float value) {
  return std::bit_cast<std::uint32_t>(value + 0.0f); // 0 for -0
}
std::uint64_t hashOf(const Vec2f& value) {
  return mixHash(bitsOf(value.x), bitsOf(value.y));
}
std::uint64_t hashOf(const Rgba& value) {
  return mixHash(mixHash(bitsOf(value.r), bitsOf(value.g)), mixHash(bitsOf(value.b), bitsOf(value.a)));
}
std::uint64_t hashOf(const Vec3f&) {
  return 0; // normals are not compared exactly
}

/// A hash of what the wedges of a mesh have, in any order.
std::uint64_t contentOf(const Mesh& mesh) {
  std::vector<std::uint64_t> hashes(mesh.wedgeCount());
  visitAttributes(mesh, [&](const auto& row, const auto& values) {
    for (std::size_t i = 0; i < values.size(); ++i)
      hashes[i] = mixHash(hashes[i] + static_cast<std::uint64_t>(row.role), hashOf(values[i]));
  });
  for (const NamedAttribute& attribute : mesh.namedAttributes)
    for (std::size_t i = 0; i < attribute.values.size(); ++i) {
      std::uint64_t& hash = hashes[i / attribute.components];
      hash = mixHash(hash, bitsOf(attribute.values[i]));
    }
  const std::uint64_t sum = std::accumulate(hashes.begin(), hashes.end(), std::uint64_t{0});
  std::uint64_t counts = mixHash(static_cast<std::uint64_t>(mesh.topology), mesh.positions.size());
  counts = mixHash(mixHash(counts, mesh.wedgeCount()), mesh.corners.size());
  return mixHash(counts, sum);
}

bool mayTurn(const Mesh& mesh) {
  return std::ranges::all_of(mesh.namedAttributes,
                             [](const NamedAttribute& attribute) { return attribute.components < 3; });
}

/// A rotation about the centroid of `from`, which goes to that of `to`, as a Transform with few digits: its numbers are
/// off by `slack` at most, where it turns as far as the radius of `from`.
Transform roundedTransform(const Affine3d& rotation, const MeshMeasure& from, const MeshMeasure& to, double slack) {
  Transform transform = transformOf(rotation);
  transform.scale = {1, 1, 1};
  const double angle = from.radius > 0 ? slack / from.radius : slack;
  Rotation& turn = transform.rotation;
  turn.angle = shortestWithin(turn.angle, angle);
  for (int axis = 0; axis < 3; ++axis)
    turn.axis[axis] = shortestWithin(turn.axis[axis], angle);
  const Vec3d translation = to.centroid - affineOf(turn).direction(from.centroid);
  for (int axis = 0; axis < 3; ++axis)
    transform.translation[axis] = shortestWithin(translation[axis], slack);
  if (turn.angle == 0)
    turn = {};
  return transform;
}

/// A search for the map of one mesh to another.
class MapSearch {
public:
  MapSearch(const Mesh& from, const MeshMeasure& fromMeasure, const Mesh& to, const MeshMeasure& toMeasure,
            const CongruenceTolerance& tolerance)
      : from_(from), to_(to), fromMeasure_(fromMeasure), toMeasure_(toMeasure), tolerance_(tolerance) {}

  std::optional<Transform> run() const {
    if (isMap({}))
      return Transform{};
    if (const std::optional<Transform> translation = rounded({}))
      return translation;
    if (!mayTurn(from_))
      return std::nullopt;
    if (from_.corners == to_.corners && from_.wedgePositions == to_.wedgePositions) {
      std::vector<std::uint32_t> sameOrder(from_.positions.size());
      std::iota(sameOrder.begin(), sameOrder.end(), 0u);
      if (std::optional<Transform> map = bestMap(sameOrder))
        return map;
    }
    return from_.topology == Topology::triangles ? byPairs() : std::nullopt;
  }

private:
  bool isMap(const Transform& transform) const {
    return correspondence(from_, to_, affineOf(transform), tolerance_).has_value();
  }
  /// A map with as few digits as the tolerance allows.
  std::optional<Transform> rounded(const Affine3d& rotation) const {
    for (const double share : roundingShares)
      if (const Transform map = roundedTransform(rotation, fromMeasure_, toMeasure_, share * tolerance_.distance);
          isMap(map))
        return map;
    return std::nullopt;
  }
  Vec3d ofFrom(std::uint32_t position) const { return Vec3d(from_.positions[position]) - fromMeasure_.centroid; }
  Vec3d ofTo(std::uint32_t position) const { return Vec3d(to_.positions[position]) - toMeasure_.centroid; }

  /// The best map for positions that correspond, if it is within the tolerance.
  std::optional<Transform> bestMap(const std::vector<std::uint32_t>& positions) const {
    PairSums sums;
    for (std::uint32_t i = 0; i < positions.size(); ++i)
      sums.add(ofFrom(i), ofTo(positions[i]));
    return rounded(bestRotation(sums));
  }

  /// Maps two vertices of `from` to pairs of vertices of `to`.
  std::optional<Transform> byPairs() const;

  const Mesh &from_, &to_;
  const MeshMeasure &fromMeasure_, &toMeasure_;
  const CongruenceTolerance& tolerance_;
};

/// Vertices by their distances from the centroid.
class CentroidDistances {
public:
  CentroidDistances(const Mesh& mesh, const Vec3d& centroid) {
    for (std::uint32_t i = 0; i < mesh.positions.size(); ++i)
      sorted_.emplace_back(length(Vec3d(mesh.positions[i]) - centroid), i);
    std::ranges::sort(sorted_);
  }

  /// The vertices within `tolerance` of a distance.
  std::span<const std::pair<double, std::uint32_t>> at(double distance, double tolerance) const {
    const auto low = std::ranges::lower_bound(sorted_, std::pair{distance - tolerance, std::uint32_t{0}});
    const auto high = std::ranges::upper_bound(sorted_, std::pair{distance + tolerance, UINT32_MAX});
    return {low, high};
  }
  const std::vector<std::pair<double, std::uint32_t>>& sorted() const { return sorted_; }

private:
  std::vector<std::pair<double, std::uint32_t>> sorted_;
};

/// The orthonormal frame of two directions that are not parallel.
Affine3d frameOf(const Vec3d& first, const Vec3d& second) {
  const Vec3d x = first * (1 / length(first)), across = cross(first, second), z = across * (1 / length(across));
  return {x, cross(z, x), z, {}};
}

Affine3d transposed(const Affine3d& m) {
  return {{m.x.x, m.y.x, m.z.x}, {m.x.y, m.y.y, m.z.y}, {m.x.z, m.y.z, m.z.z}, {}};
}

std::optional<Transform> MapSearch::byPairs() const {
  const double near = 4 * tolerance_.distance, minDistance = fromMeasure_.radius / 4;
  const CentroidDistances inFrom(from_, fromMeasure_.centroid), inTo(to_, toMeasure_.centroid);
  if (!std::ranges::equal(inFrom.sorted(), inTo.sorted(),
                          [&](const auto& a, const auto& b) { return std::abs(a.first - b.first) <= near; }))
    return std::nullopt;
  /// The vertex that fewest others are as far from the centroid as, of those that `isAllowed`.
  const auto rarest = [&](const auto& isAllowed) {
    std::optional<std::uint32_t> best;
    std::size_t fewest = 0;
    for (const auto& [distance, vertex] : inFrom.sorted()) {
      if (distance < minDistance || !isAllowed(vertex))
        continue;
      const std::size_t count = inFrom.at(distance, near).size();
      if (!best || count < fewest)
        best = vertex, fewest = count;
    }
    return best;
  };
  const std::optional<std::uint32_t> first = rarest([](std::uint32_t) { return true; });
  if (!first)
    return std::nullopt;
  const Vec3d a = ofFrom(*first);
  const std::optional<std::uint32_t> second = rarest([&](std::uint32_t vertex) {
    const Vec3d b = ofFrom(vertex);
    return length(cross(a, b)) > 0.25 * length(a) * length(b);
  });
  if (!second)
    return std::nullopt;
  const Vec3d b = ofFrom(*second);
  const Affine3d toFrame = transposed(frameOf(a, b));
  // The vertices of the pair are off by a tolerance each, others by as much more as they are farther away.
  const CongruenceTolerance loose{64 * tolerance_.distance, 4 * tolerance_.normal};
  const std::size_t limit = std::clamp(maxVerticesTried / from_.positions.size(), minCandidates, maxCandidates);
  std::size_t candidates = 0;
  for (const auto& [distanceA, otherA] : inTo.at(length(a), near))
    for (const auto& [distanceB, otherB] : inTo.at(length(b), near)) {
      const Vec3d c = ofTo(otherA), d = ofTo(otherB);
      if (otherA == otherB || std::abs(length(c - d) - length(a - b)) > 2 * near)
        continue;
      if (++candidates > limit)
        return std::nullopt;
      Affine3d map = frameOf(c, d) * toFrame;
      map.translation = toMeasure_.centroid - map.direction(fromMeasure_.centroid);
      if (const std::optional<Correspondence> pairs = correspondence(from_, to_, map, loose))
        if (std::optional<Transform> best = bestMap(pairs->positions))
          return best;
    }
  return std::nullopt;
}

} // namespace

MeshMeasure measureOf(const Mesh& mesh) {
  MeshMeasure measure;
  measure.content = contentOf(mesh);
  if (mesh.positions.empty())
    return measure;
  for (const Vec3f& position : mesh.positions) {
    measure.centroid += Vec3d(position);
    for (int axis = 0; axis < 3; ++axis)
      measure.largestCoordinate = std::max(measure.largestCoordinate, std::abs(double{position[axis]}));
  }
  const double count = static_cast<double>(mesh.positions.size());
  measure.centroid = measure.centroid * (1 / count);
  double sum = 0;
  for (const Vec3f& position : mesh.positions) {
    const Vec3d offset = Vec3d(position) - measure.centroid;
    sum += dot(offset, offset);
    measure.radius = std::max(measure.radius, length(offset));
  }
  measure.gyration = std::sqrt(sum / count);
  return measure;
}

bool mayBeCongruent(const MeshMeasure& a, const MeshMeasure& b, double distance) {
  return a.content == b.content && std::abs(a.gyration - b.gyration) <= 2 * distance &&
         std::abs(a.radius - b.radius) <= 2 * distance;
}

std::optional<Transform> findRigidMap(const Mesh& from, const MeshMeasure& fromMeasure, const Mesh& to,
                                      const MeshMeasure& toMeasure, const CongruenceTolerance& tolerance) {
  if (!haveSameCounts(from, to) || !mayBeCongruent(fromMeasure, toMeasure, tolerance.distance))
    return std::nullopt;
  return MapSearch(from, fromMeasure, to, toMeasure, tolerance).run();
}

} // namespace imgeo
