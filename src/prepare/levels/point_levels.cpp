#include "prepare/levels/point_levels.h"

#include "base/parallel.h"
#include "prepare/levels/nearest_point.h"
#include "prepare/levels/poisson_disk.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace imgeo {

namespace {

/// The children of a group are at most so many.
constexpr std::uint64_t maxChildren = 4;

/// Points that lie together: those of a group of level 0, or of several.
struct CloudPart {
  std::span<std::uint32_t> wedges;
  std::uint64_t groupCount; ///< of level 0
};

/// A group of a level that is being built.
struct PointGroup {
  std::vector<std::vector<std::uint32_t>> segments; ///< points: all, or by child
  std::vector<std::uint32_t> children;              ///< numbers within the level below
  std::span<const std::uint32_t> whole;             ///< the points of level 0 below, in the order of the KD tree
  double error = 0;                                 ///< largest distance of these from the coarse form
};

class PointLevelBuilder {
public:
  PointLevelBuilder(const Mesh& mesh, std::span<const Vec3u> points, const LevelOptions& options,
                    const PointGroupSink& sink)
      : mesh_(mesh), positions_(points), options_(options), sink_(sink) {}

  Levels run() {
    std::vector<std::uint32_t> wedges(mesh_.wedgeCount());
    std::iota(wedges.begin(), wedges.end(), 0u);
    std::vector<std::vector<std::uint32_t>> childCounts = cut(wedges); // by level from 1 on
    std::vector<PointGroup> level;
    for (const CloudPart& leaf : leaves_)
      level.push_back({{{leaf.wedges.begin(), leaf.wedges.end()}}, {}, leaf.wedges});
    for (std::size_t number = 0; number < childCounts.size(); ++number) {
      std::vector<PointGroup> above = levelAbove(level, childCounts[number]);
      finish(number, level);
      level = std::move(above);
    }
    finish(childCounts.size(), level);
    return numberedLevels(std::move(levels_));
  }

private:
  const Vec3u& positionOf(std::uint32_t wedge) const { return positions_[mesh_.wedgePositions[wedge]]; }

  /// Cuts the wedges into the nodes of all levels from the highest down. Sets `leaves_` and returns the numbers of
  /// children of the groups of each level from 1 on.
  std::vector<std::vector<std::uint32_t>> cut(std::vector<std::uint32_t>& wedges) {
    const std::uint64_t groupCount = (wedges.size() + options_.groupTriangles - 1) / options_.groupTriangles;
    std::uint64_t capacity = 1; // leaves of a node of the level
    while (capacity < groupCount)
      capacity *= maxChildren;
    leaves_ = {{wedges, groupCount}};
    std::vector<std::vector<std::uint32_t>> childCounts;
    while (capacity > 1) {
      capacity /= maxChildren;
      std::vector<std::vector<CloudPart>> parts(leaves_.size());
      parallelFor(leaves_.size(), [&](std::size_t i) { parts[i] = partsOf(leaves_[i], capacity); });
      std::vector<std::uint32_t>& counts = childCounts.emplace_back();
      leaves_.clear();
      for (const std::vector<CloudPart>& children : parts) {
        counts.push_back(static_cast<std::uint32_t>(children.size()));
        leaves_.insert(leaves_.end(), children.begin(), children.end());
      }
    }
    std::ranges::reverse(childCounts);
    return childCounts;
  }

  /// Halves a node until no part has more than `capacity` groups of level 0.
  std::vector<CloudPart> partsOf(const CloudPart& node, std::uint64_t capacity) const {
    if (node.groupCount <= capacity)
      return {node};
    const std::uint64_t firstCount = node.groupCount / 2;
    const std::size_t size = node.wedges.size() * firstCount / node.groupCount;
    const int axis = longestAxis(node.wedges);
    std::nth_element(node.wedges.begin(), node.wedges.begin() + static_cast<std::ptrdiff_t>(size), node.wedges.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                       const std::uint32_t atA = positionOf(a)[axis], atB = positionOf(b)[axis];
                       return atA != atB ? atA < atB : a < b;
                     });
    std::vector<CloudPart> parts = partsOf({node.wedges.first(size), firstCount}, capacity);
    const std::vector<CloudPart> others = partsOf({node.wedges.subspan(size), node.groupCount - firstCount}, capacity);
    parts.insert(parts.end(), others.begin(), others.end());
    return parts;
  }

  int longestAxis(std::span<const std::uint32_t> wedges) const {
    Vec3u low = positionOf(wedges[0]), high = low;
    for (const std::uint32_t wedge : wedges)
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], positionOf(wedge)[axis]);
        high[axis] = std::max(high[axis], positionOf(wedge)[axis]);
      }
    const Vec3u size = high - low;
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  }

  /// The groups of the next level, the first of which has the first of `childCounts` groups as its children ... Sets
  /// the errors of the groups of `level`.
  std::vector<PointGroup> levelAbove(std::vector<PointGroup>& level,
                                     const std::vector<std::uint32_t>& childCounts) const {
    std::vector<PointGroup> above(childCounts.size());
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < above.size(); ++i) {
      above[i].children.resize(childCounts[i]);
      std::iota(above[i].children.begin(), above[i].children.end(), next);
      next += childCounts[i];
      const std::span<const std::uint32_t> first = level[above[i].children.front()].whole,
                                           last = level[above[i].children.back()].whole;
      above[i].whole = {first.data(), last.data() + last.size()};
    }
    parallelFor(above.size(), [&](std::size_t i) { choose(above[i], level); });
    return above;
  }

  /// Chooses the points of a group among those of its children, whose errors it sets.
  void choose(PointGroup& group, std::vector<PointGroup>& level) const {
    std::vector<std::uint32_t> wedges, parts;
    std::vector<Vec3u> points;
    for (std::uint32_t part = 0; part < group.children.size(); ++part)
      for (const std::vector<std::uint32_t>& segment : level[group.children[part]].segments)
        for (const std::uint32_t wedge : segment) {
          wedges.push_back(wedge);
          parts.push_back(part);
          points.push_back(positionOf(wedge));
        }
    const auto share = static_cast<std::size_t>(static_cast<double>(points.size()) / options_.ratio);
    const std::vector<bool> isKept = choosePoissonDisk(points, parts, std::max(share, group.children.size()));
    group.segments.resize(group.children.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      if (isKept[i])
        group.segments[parts[i]].push_back(wedges[i]);
    for (std::size_t part = 0; part < group.children.size(); ++part) {
      PointGroup& child = level[group.children[part]];
      const NearestPoint nearest(positionsOf(group.segments[part]));
      for (const std::uint32_t wedge : child.whole)
        child.error = nearest.farther(child.error, positionOf(wedge));
    }
  }

  std::vector<Vec3u> positionsOf(const std::vector<std::uint32_t>& wedges) const {
    std::vector<Vec3u> positions;
    for (const std::uint32_t wedge : wedges)
      positions.push_back(positionOf(wedge));
    return positions;
  }

  /// Hands the groups of a level over.
  void finish(std::size_t number, std::vector<PointGroup>& groups) {
    const auto level = static_cast<std::uint32_t>(number);
    sink_.begin(level, groups.size());
    std::vector<LeveledGroup> facts(groups.size());
    parallelFor(groups.size(), [&](std::size_t i) {
      facts[i] = factsOf(level, groups[i]);
      std::vector<Patch> patches;
      for (const std::vector<std::uint32_t>& segment : groups[i].segments)
        patches.push_back(patchOf(segment));
      groups[i].segments = {};
      sink_.take(level, i, std::move(patches));
    });
    levels_.push_back(std::move(facts));
  }

  LeveledGroup factsOf(std::uint32_t level, PointGroup& group) const {
    Box3d box;
    const auto forEachPoint = [&](auto visit) {
      for (const std::vector<std::uint32_t>& segment : group.segments)
        for (const std::uint32_t wedge : segment)
          visit(Vec3d(positionOf(wedge)));
    };
    forEachPoint([&](const Vec3d& point) { box.add(point); });
    LeveledGroup facts{level, std::move(group.children), box.center(), 0, group.error};
    forEachPoint([&](const Vec3d& point) { facts.radius = std::max(facts.radius, length(point - facts.center)); });
    return facts;
  }

  Patch patchOf(const std::vector<std::uint32_t>& wedges) const {
    Patch patch;
    patch.topology = Topology::points;
    patch.positions = positionsOf(wedges);
    static_cast<VertexAttributes&>(patch) = gather(mesh_, wedges);
    patch.wedgePositions.resize(wedges.size());
    std::iota(patch.wedgePositions.begin(), patch.wedgePositions.end(), 0u);
    patch.corners = patch.wedgePositions;
    return patch;
  }

  const Mesh& mesh_;
  std::span<const Vec3u> positions_;
  const LevelOptions& options_;
  const PointGroupSink& sink_;
  std::vector<CloudPart> leaves_;
  std::vector<std::vector<LeveledGroup>> levels_; ///< by level; `children` are numbers within the level below
};

} // namespace

Levels buildPointLevels(const Mesh& mesh, std::span<const Vec3u> points, const LevelOptions& options,
                        const PointGroupSink& sink) {
  assert(mesh.topology == Topology::points && !mesh.corners.empty() && points.size() == mesh.positions.size());
  return PointLevelBuilder(mesh, points, options, sink).run();
}

} // namespace imgeo
