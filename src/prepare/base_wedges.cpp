#include "prepare/base_wedges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <vector>

namespace imgeo {

namespace {

/// Wedges of a patch in sets that grow together.
class WedgeSets {
public:
  explicit WedgeSets(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0u); }

  std::uint32_t setOf(std::uint32_t wedge) {
    while (parents_[wedge] != wedge)
      wedge = parents_[wedge] = parents_[parents_[wedge]];
    return wedge;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    a = setOf(a), b = setOf(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<std::uint32_t> parents_;
};

/// Joins the wedges of each position that have one place in the texture.
void joinAlike(WedgeSets& sets, const Patch& patch) {
  if (patch.wedgeCount() == patch.positions.size())
    return;
  std::vector<std::uint32_t> order(patch.wedgeCount());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t wedge) {
    const Vec2f texCoord = patch.texCoords.empty() ? Vec2f{} : patch.texCoords[wedge];
    return std::tuple(patch.wedgePositions[wedge], texCoord.x, texCoord.y);
  };
  std::ranges::sort(order, {}, key);
  for (std::size_t i = 1; i < order.size(); ++i)
    if (key(order[i]) == key(order[i - 1]))
      sets.join(order[i], order[i - 1]);
}

/// Joins wedges of a triangle whose vertices have become one.
void joinGathered(WedgeSets& sets, const SimplifiedTriangles& simplified, const Patch& patch) {
  const auto vertexOf = [&](std::uint32_t wedge) { return simplified.vertexOfInput[patch.wedgePositions[wedge]]; };
  for (std::size_t corner = 0; corner < patch.corners.size(); ++corner) {
    const std::uint32_t a = patch.corners[corner], b = patch.corners[corner % 3 == 2 ? corner - 2 : corner + 1];
    if (vertexOf(a) != SimplifiedTriangles::none && vertexOf(a) == vertexOf(b))
      sets.join(a, b);
  }
}

/// Of each set, by the number of its wedge that stands for it, the wedge that is nearest to the vertex.
std::vector<std::uint32_t> nearestOf(WedgeSets& sets, const SimplifiedTriangles& simplified, const Patch& patch) {
  std::vector<std::uint32_t> nearest(patch.wedgeCount(), SimplifiedTriangles::none);
  std::vector<double> distances(patch.wedgeCount(), std::numeric_limits<double>::infinity());
  for (std::uint32_t wedge = 0; wedge < patch.wedgeCount(); ++wedge) {
    const std::uint32_t position = patch.wedgePositions[wedge], vertex = simplified.vertexOfInput[position];
    if (vertex == SimplifiedTriangles::none)
      continue;
    const Vec3d off = Vec3d(patch.positions[position]) - Vec3d(simplified.positions[vertex]);
    const std::uint32_t set = sets.setOf(wedge);
    if (dot(off, off) < distances[set]) {
      distances[set] = dot(off, off);
      nearest[set] = wedge;
    }
  }
  return nearest;
}

/// Makes wedges of pieces of surface, one for those of a vertex that lie together in the texture.
class Pieces {
public:
  Pieces(const SimplifiedTriangles& simplified, const Patch& patch, const std::vector<std::uint32_t>& nearest)
      : patch_(patch), nearest_(nearest), latest_(simplified.positions.size(), SimplifiedTriangles::none),
        numbers_(patch.wedgeCount(), SimplifiedTriangles::none) {}

  /// The next corner, by a set of wedges and the vertex that it stands around.
  void add(std::uint32_t set, std::uint32_t position) {
    sets_.push_back(set);
    positions_.push_back(position);
  }

  SimplifiedWedges finish() {
    const double together = patch_.texCoords.empty() ? 0 : meanEdge() / 4;
    for (std::size_t corner = 0; corner < sets_.size(); ++corner) {
      std::uint32_t& number = numbers_[sets_[corner]];
      if (number == SimplifiedTriangles::none)
        number = wedgeAt(positions_[corner], nearest_[sets_[corner]], together);
      wedges_.corners.push_back(number);
    }
    return std::move(wedges_);
  }

private:
  double between(std::uint32_t a, std::uint32_t b) const {
    const Vec2f from = patch_.texCoords[a], to = patch_.texCoords[b];
    return std::hypot(double{to.x} - from.x, double{to.y} - from.y);
  }

  /// Of the triangles in the texture.
  double meanEdge() const {
    double sum = 0;
    for (std::size_t corner = 0; corner < sets_.size(); ++corner)
      sum += between(nearest_[sets_[corner]], nearest_[sets_[corner % 3 == 2 ? corner - 2 : corner + 1]]);
    return sum / static_cast<double>(sets_.size());
  }

  std::uint32_t wedgeAt(std::uint32_t position, std::uint32_t source, double together) {
    constexpr int mostToLookAt = 16; // loose triangles may be thousands at one vertex
    std::uint32_t wedge = latest_[position];
    for (int looked = 0; wedge != SimplifiedTriangles::none && looked < mostToLookAt; ++looked, wedge = before_[wedge])
      if (patch_.texCoords.empty() || between(wedges_.sources[wedge], source) <= together)
        return wedge;
    before_.push_back(latest_[position]);
    latest_[position] = static_cast<std::uint32_t>(wedges_.positions.size());
    wedges_.positions.push_back(position);
    wedges_.sources.push_back(source);
    return latest_[position];
  }

  const Patch& patch_;
  const std::vector<std::uint32_t>& nearest_;   ///< per set
  std::vector<std::uint32_t> sets_, positions_; ///< per corner
  std::vector<std::uint32_t> latest_, before_;  ///< wedges of a position, in a list
  std::vector<std::uint32_t> numbers_;          ///< per set: its wedge
  SimplifiedWedges wedges_;
};

/// Where there is nothing to choose.
SimplifiedWedges plainWedges(const SimplifiedTriangles& simplified) {
  SimplifiedWedges wedges{std::vector<std::uint32_t>(simplified.positions.size()),
                          std::vector<std::uint32_t>(simplified.positions.size()), simplified.corners};
  std::iota(wedges.positions.begin(), wedges.positions.end(), 0u);
  return wedges;
}

} // namespace

SimplifiedWedges wedgesOf(const SimplifiedTriangles& simplified, const Patch& patch,
                          std::span<const std::uint32_t> triangles) {
  if (patch.texCoords.empty() && patch.colors.empty() && patch.namedAttributes.empty())
    return plainWedges(simplified);
  WedgeSets sets(patch.wedgeCount());
  joinAlike(sets, patch);
  joinGathered(sets, simplified, patch);
  const std::vector<std::uint32_t> nearest = nearestOf(sets, simplified, patch);
  Pieces pieces(simplified, patch, nearest);
  for (std::size_t corner = 0; corner < simplified.corners.size(); ++corner) {
    const std::uint32_t triangle = triangles[simplified.triangles[corner / 3]];
    pieces.add(sets.setOf(patch.corners[std::size_t{3} * triangle + corner % 3]), simplified.corners[corner]);
  }
  return pieces.finish();
}

} // namespace imgeo
