#include "prepare/base_wedges.h"

#include "base/disjoint_sets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace imgeo {

namespace {

/// The normal of a wedge if creases are kept, else the same vector for all.
Vec3f creaseNormal(const Patch& patch, std::uint32_t wedge, Creases creases) {
  return creases == Creases::kept && !patch.normals.empty() ? patch.normals[wedge] : Vec3f{};
}

/// Joins the wedges of each position that have the same texture coordinates in all sets, and the same normal if creases
/// are kept.
void joinEqualWedges(DisjointSets& sets, const Patch& patch, Creases creases) {
  if (patch.wedgeCount() == patch.positions.size())
    return;
  std::vector<std::uint32_t> order(patch.wedgeCount());
  std::iota(order.begin(), order.end(), 0u);
  const std::size_t setCount = texCoordSetCount(patch);
  const auto key = [&](std::uint32_t wedge) {
    std::array<float, 2 * maxTexCoordSets + 3> values{};
    for (std::size_t set = 0; set < setCount; ++set) {
      const Vec2f texCoord = texCoordsOf(patch, set)[wedge];
      values[2 * set] = texCoord.x, values[2 * set + 1] = texCoord.y;
    }
    const Vec3f normal = creaseNormal(patch, wedge, creases);
    for (int axis = 0; axis < 3; ++axis)
      values[2 * maxTexCoordSets + static_cast<std::size_t>(axis)] = normal[axis];
    return std::pair(patch.wedgePositions[wedge], values);
  };
  std::ranges::sort(order, {}, key);
  for (std::size_t i = 1; i < order.size(); ++i)
    if (key(order[i]) == key(order[i - 1]))
      sets.merge(order[i], order[i - 1]);
}

/// Joins the wedges of a triangle that simplification has mapped to one vertex.
void joinCollapsed(DisjointSets& sets, const SimplifiedTriangles& simplified, const Patch& patch) {
  const auto vertexOf = [&](std::uint32_t wedge) { return simplified.vertexOfInput[patch.wedgePositions[wedge]]; };
  for (std::size_t corner = 0; corner < patch.corners.size(); ++corner) {
    const std::uint32_t a = patch.corners[corner], b = patch.corners[corner % 3 == 2 ? corner - 2 : corner + 1];
    if (vertexOf(a) != SimplifiedTriangles::none && vertexOf(a) == vertexOf(b))
      sets.merge(a, b);
  }
}

/// For each set, indexed by its representative wedge: the wedge that is nearest to the simplified vertex.
std::vector<std::uint32_t> nearestWedges(DisjointSets& sets, const SimplifiedTriangles& simplified,
                                         const Patch& patch) {
  std::vector<std::uint32_t> nearest(patch.wedgeCount(), SimplifiedTriangles::none);
  std::vector<double> distances(patch.wedgeCount(), std::numeric_limits<double>::infinity());
  for (std::uint32_t wedge = 0; wedge < patch.wedgeCount(); ++wedge) {
    const std::uint32_t position = patch.wedgePositions[wedge], vertex = simplified.vertexOfInput[position];
    if (vertex == SimplifiedTriangles::none)
      continue;
    const Vec3d difference = Vec3d(patch.positions[position]) - Vec3d(simplified.positions[vertex]);
    const std::uint32_t set = sets.find(wedge);
    if (dot(difference, difference) < distances[set]) {
      distances[set] = dot(difference, difference);
      nearest[set] = wedge;
    }
  }
  return nearest;
}

/// Makes the wedges of each simplified vertex: sets whose texture coordinates are close to each other share one.
class WedgeBuilder {
public:
  WedgeBuilder(const SimplifiedTriangles& simplified, const Patch& patch, const std::vector<std::uint32_t>& nearest,
               Creases creases)
      : patch_(patch), nearest_(nearest), creases_(creases),
        latest_(simplified.positions.size(), SimplifiedTriangles::none),
        wedgeOfSet_(patch.wedgeCount(), SimplifiedTriangles::none), texCoordSetCount_(texCoordSetCount(patch)) {}

  /// Adds the next corner, given its set of wedges and its simplified vertex.
  void add(std::uint32_t set, std::uint32_t position) {
    sets_.push_back(set);
    positions_.push_back(position);
  }

  SimplifiedWedges finish() {
    for (std::size_t set = 0; set < texCoordSetCount_; ++set)
      maxDistances_[set] = meanTexCoordEdge(set) / 4;
    for (std::size_t corner = 0; corner < sets_.size(); ++corner) {
      std::uint32_t& wedge = wedgeOfSet_[sets_[corner]];
      if (wedge == SimplifiedTriangles::none)
        wedge = wedgeAt(positions_[corner], nearest_[sets_[corner]]);
      wedges_.corners.push_back(wedge);
    }
    return std::move(wedges_);
  }

private:
  double texCoordDistance(std::size_t set, std::uint32_t a, std::uint32_t b) const {
    const Vec2f from = texCoordsOf(patch_, set)[a], to = texCoordsOf(patch_, set)[b];
    return std::hypot(double{to.x} - from.x, double{to.y} - from.y);
  }

  /// Mean edge length of the simplified triangles in texture coordinates.
  double meanTexCoordEdge(std::size_t set) const {
    double sum = 0;
    for (std::size_t corner = 0; corner < sets_.size(); ++corner)
      sum += texCoordDistance(set, nearest_[sets_[corner]], nearest_[sets_[corner % 3 == 2 ? corner - 2 : corner + 1]]);
    return sum / static_cast<double>(sets_.size());
  }

  bool areClose(std::uint32_t a, std::uint32_t b) const {
    for (std::size_t set = 0; set < texCoordSetCount_; ++set)
      if (!(texCoordDistance(set, a, b) <= maxDistances_[set]))
        return false;
    if (creases_ == Creases::smoothed || patch_.normals.empty())
      return true;
    constexpr float minCosine = 0.866f; // of 30 degrees
    return dot(patch_.normals[a], patch_.normals[b]) >= minCosine;
  }

  /// The wedge of a vertex whose texture coordinates and normal are close to those of `source`; a new one if there is
  /// none.
  std::uint32_t wedgeAt(std::uint32_t position, std::uint32_t source) {
    constexpr int maxCandidates = 16; // one vertex may have thousands of unconnected triangles
    std::uint32_t wedge = latest_[position];
    for (int n = 0; wedge != SimplifiedTriangles::none && n < maxCandidates; ++n, wedge = before_[wedge])
      if (areClose(wedges_.sources[wedge], source))
        return wedge;
    before_.push_back(latest_[position]);
    latest_[position] = static_cast<std::uint32_t>(wedges_.positions.size());
    wedges_.positions.push_back(position);
    wedges_.sources.push_back(source);
    return latest_[position];
  }

  const Patch& patch_;
  const std::vector<std::uint32_t>& nearest_; ///< by set
  Creases creases_;
  std::vector<std::uint32_t> sets_, positions_; ///< by corner
  std::vector<std::uint32_t> latest_, before_;  ///< linked list of the wedges of each position
  std::vector<std::uint32_t> wedgeOfSet_;       ///< by set
  std::size_t texCoordSetCount_;
  std::array<double, maxTexCoordSets> maxDistances_{}; ///< by set of texture coordinates
  SimplifiedWedges wedges_;
};

/// One wedge for each position, for patches without attributes, in which SimplifiedWedges::sources do not matter.
SimplifiedWedges plainWedges(const SimplifiedTriangles& simplified) {
  SimplifiedWedges wedges{std::vector<std::uint32_t>(simplified.positions.size()),
                          std::vector<std::uint32_t>(simplified.positions.size()), simplified.corners};
  std::iota(wedges.positions.begin(), wedges.positions.end(), 0u);
  return wedges;
}

} // namespace

SimplifiedWedges wedgesOf(const SimplifiedTriangles& simplified, const Patch& patch,
                          std::span<const std::uint32_t> triangles, Creases creases) {
  const bool keepsNormals = creases == Creases::kept && !patch.normals.empty();
  const bool hasAttributes =
      keepsNormals || !patch.namedAttributes.empty() ||
      std::ranges::any_of(vertexRoles, [&](VertexRole role) { return isInBase(role) && hasAttribute(patch, role); });
  if (!hasAttributes)
    return plainWedges(simplified);
  DisjointSets sets(patch.wedgeCount());
  joinEqualWedges(sets, patch, creases);
  joinCollapsed(sets, simplified, patch);
  const std::vector<std::uint32_t> nearest = nearestWedges(sets, simplified, patch);
  WedgeBuilder builder(simplified, patch, nearest, creases);
  for (std::size_t corner = 0; corner < simplified.corners.size(); ++corner) {
    const std::uint32_t triangle = triangles[simplified.triangles[corner / 3]];
    builder.add(sets.find(patch.corners[std::size_t{3} * triangle + corner % 3]), simplified.corners[corner]);
  }
  return builder.finish();
}

} // namespace imgeo
