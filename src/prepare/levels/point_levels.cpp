#include "prepare/levels/point_levels.h"

#include "base/parallel.h"
#include "prepare/levels/nearest_point.h"
#include "prepare/levels/point_tree.h"
#include "prepare/levels/poisson_disk.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace imgeo {

namespace {

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

  /// Builds the levels from 0 on. `wedges` are those of all regions, of which `sizes` has the numbers of wedges.
  PointLevels run(std::span<std::uint32_t> wedges, std::span<const std::uint64_t> sizes, std::uint32_t height) {
    for (const std::uint64_t size : sizes) {
      leaves_.push_back({wedges.first(size), pointGroupCount(size, options_.groupTriangles)});
      wedges = wedges.subspan(size);
    }
    ChildCounts counts = cut(height);
    for (std::vector<std::uint32_t>& above : pointTreeAbove(sizes.size()))
      counts.push_back(std::move(above));
    std::vector<PointGroup> level;
    for (const CloudPart& leaf : leaves_)
      level.push_back({{{leaf.wedges.begin(), leaf.wedges.end()}}, {}, leaf.wedges});
    for (std::uint32_t number = 0; number < counts.size(); ++number) {
      std::vector<PointGroup> above = levelAbove(level, counts[number]);
      finish(number, level);
      level = std::move(above);
    }
    finish(static_cast<std::uint32_t>(counts.size()), level);
    return std::move(levels_);
  }

  /// Builds the levels above some groups, whose wedges end at `ends`.
  PointLevels runAbove(std::span<const std::uint64_t> ends, std::uint32_t height) {
    std::vector<PointGroup> level(ends.size());
    for (std::size_t i = 0; i < level.size(); ++i) {
      const std::uint64_t begin = i == 0 ? 0 : ends[i - 1];
      std::vector<std::uint32_t>& wedges = level[i].segments.emplace_back(ends[i] - begin);
      std::iota(wedges.begin(), wedges.end(), static_cast<std::uint32_t>(begin));
    }
    const ChildCounts counts = pointTreeAbove(ends.size());
    for (std::uint32_t i = 0; i < counts.size(); ++i) {
      std::vector<PointGroup> above = levelAbove(level, counts[i]);
      if (i > 0)
        finish(height + i, level);
      level = std::move(above);
    }
    if (!counts.empty())
      finish(height + static_cast<std::uint32_t>(counts.size()), level);
    return std::move(levels_);
  }

private:
  const Vec3u& positionOf(std::uint32_t wedge) const { return positions_[mesh_.wedgePositions[wedge]]; }

  /// Cuts the regions, which are `leaves_`, into the nodes of all levels from `height` down to the new `leaves_`.
  /// Returns the numbers of children of the groups of these levels.
  ChildCounts cut(std::uint32_t height) {
    ChildCounts childCounts;
    while (height-- > 0) {
      std::vector<std::vector<CloudPart>> parts(leaves_.size());
      parallelFor(leaves_.size(), [&](std::size_t i) {
        parts[i] = leaves_[i].groupCount > 1 ? halves(leaves_[i], pointTreeCapacity(height)) : std::vector{leaves_[i]};
      });
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

  /// Halves a node until no part has more than `capacity` groups of level 0, but once at least.
  std::vector<CloudPart> halves(const CloudPart& node, std::uint64_t capacity) const {
    const std::uint64_t firstCount = node.groupCount / 2;
    const std::size_t size = node.wedges.size() * firstCount / node.groupCount;
    const int axis = longestAxis(node.wedges);
    std::nth_element(node.wedges.begin(), node.wedges.begin() + static_cast<std::ptrdiff_t>(size), node.wedges.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                       const std::uint32_t atA = positionOf(a)[axis], atB = positionOf(b)[axis];
                       return atA != atB ? atA < atB : a < b;
                     });
    std::vector<CloudPart> parts;
    for (const CloudPart& half : {CloudPart{node.wedges.first(size), firstCount},
                                  CloudPart{node.wedges.subspan(size), node.groupCount - firstCount}})
      if (half.groupCount > capacity)
        std::ranges::copy(halves(half, capacity), std::back_inserter(parts));
      else
        parts.push_back(half);
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
  void finish(std::uint32_t level, std::vector<PointGroup>& groups) {
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
  PointLevels levels_;
};

/// The wedges of a cloud by region, in ascending order within each.
struct DividedCloud {
  std::vector<std::uint32_t> wedges;
  std::vector<std::uint64_t> sizes;       ///< wedges by region
  std::vector<std::uint64_t> pointCounts; ///< by region; several points may have a wedge
};

DividedCloud divide(const Mesh& mesh, std::span<const Vec3u> points, const RegionTree& tree) {
  DividedCloud divided{std::vector<std::uint32_t>(mesh.wedgeCount()), std::vector<std::uint64_t>(tree.regionCount()),
                       std::vector<std::uint64_t>(tree.regionCount())};
  const auto axes = axesOf(GroupFrame::straight);
  std::vector<std::uint32_t> regions(mesh.wedgeCount());
  parallelForBlocks(regions.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t wedge = begin; wedge < end; ++wedge)
      regions[wedge] = tree.regionOf(keyOfPoint(axes, Vec3f(points[mesh.wedgePositions[wedge]])));
  });
  for (const std::uint32_t region : regions)
    ++divided.sizes[region];
  for (const std::uint32_t wedge : mesh.corners)
    ++divided.pointCounts[regions[wedge]];
  std::vector<std::uint64_t> next(divided.sizes.size());
  std::exclusive_scan(divided.sizes.begin(), divided.sizes.end(), next.begin(), std::uint64_t{0});
  for (std::uint32_t wedge = 0; wedge < regions.size(); ++wedge)
    divided.wedges[next[regions[wedge]]++] = wedge;
  return divided;
}
} // namespace

std::vector<std::uint32_t> sampledPoints(const Mesh& mesh) {
  std::vector<std::uint32_t> sample;
  const std::uint64_t count = sampledElementCount(mesh.elementCount());
  for (std::uint64_t i = 0; i < count; ++i)
    sample.push_back(mesh.wedgePositions[mesh.corners[sampledElement(i, mesh.elementCount())]]);
  return sample;
}

RegionTree regionsOfPoints(std::span<const Vec3f> sample, std::uint64_t pointCount, std::uint32_t regionPoints) {
  if (pointCount <= regionPoints)
    return {};
  const auto axes = axesOf(GroupFrame::straight);
  std::vector<FrameKey> keys;
  for (const Vec3f& point : sample)
    keys.push_back(keyOfPoint(axes, point));
  return {std::move(keys), pointCount, regionPoints};
}

std::uint32_t regionHeight(std::span<const std::uint64_t> pointCounts, std::uint32_t groupPoints) {
  return pointTreeHeight(pointGroupCount(*std::ranges::max_element(pointCounts), groupPoints));
}

Levels buildPointLevels(const Mesh& mesh, std::span<const Vec3u> points, const LevelOptions& options,
                        const PointGroupSink& sink) {
  assert(mesh.topology == Topology::points && !mesh.corners.empty() && points.size() == mesh.positions.size());
  std::vector<Vec3f> sample;
  for (const std::uint32_t position : sampledPoints(mesh))
    sample.emplace_back(points[position]);
  const RegionTree tree = regionsOfPoints(sample, mesh.elementCount(), options.regionTriangles);
  DividedCloud cloud = divide(mesh, points, tree);
  // Wedges count where one region has all of them, so that equal points make no levels.
  const std::uint32_t height =
      regionHeight(tree.regionCount() == 1 ? cloud.sizes : cloud.pointCounts, options.groupTriangles);
  return numberedLevels(PointLevelBuilder(mesh, points, options, sink).run(cloud.wedges, cloud.sizes, height));
}

PointLevels buildPointRegion(const Mesh& mesh, std::span<const Vec3u> points, std::uint32_t height,
                             const LevelOptions& options, const PointGroupSink& sink) {
  assert(mesh.topology == Topology::points && !mesh.corners.empty() && points.size() == mesh.positions.size());
  std::vector<std::uint32_t> wedges(mesh.wedgeCount());
  std::iota(wedges.begin(), wedges.end(), 0u);
  const std::uint64_t size = wedges.size();
  return PointLevelBuilder(mesh, points, options, sink).run(wedges, std::span(&size, 1), height);
}

PointLevels buildPointLevelsAbove(const Mesh& mesh, std::span<const Vec3u> points, std::span<const std::uint64_t> ends,
                                  std::uint32_t height, const LevelOptions& options, const PointGroupSink& sink) {
  assert(mesh.topology == Topology::points && !ends.empty() && ends.back() == mesh.wedgeCount());
  return PointLevelBuilder(mesh, points, options, sink).runAbove(ends, height);
}

} // namespace imgeo
