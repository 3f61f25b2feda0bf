#pragma once
// Regions: the pieces of a large level that are cut into groups and simplified one at a time, so that memory need not
// hold the level. Meshes in memory have the same regions, and so the same groups.

#include "prepare/levels/group_frame.h"

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// The triangles of a level, or points of a cloud, by which its regions are chosen: at most 2^18, spread evenly over
/// their numbers.
std::uint64_t sampledElementCount(std::uint64_t elementCount);

/// The number of sampled triangle or point i, which ascends with i. The elements are divided into sampledElementCount()
/// equal ranges, and one of each is sampled, at a pseudo-random position: rows of a file do not repeat in the sample.
std::uint64_t sampledElement(std::uint64_t i, std::uint64_t elementCount);

/// Divides space in a frame into regions of about as many triangles each. A triangle belongs to the region of its
/// centroid, a point to its own.
class RegionTree {
public:
  /// One region.
  RegionTree() : nodes_(1) {}

  /// A KD tree of regions of about `regionTriangles` triangles or fewer. `sample`: the keys of the sampled triangles of
  /// a level of `triangleCount`. One region for at most `regionTriangles`.
  RegionTree(std::vector<FrameKey> sample, std::uint64_t triangleCount, std::uint32_t regionTriangles);

  std::uint32_t regionCount() const { return regionCount_; }
  std::uint32_t regionOf(const FrameKey& key) const {
    const Node* node = nodes_.data();
    while (node->axis >= 0)
      node = &nodes_[key[node->axis] < node->cut ? node->below : node->above];
    return node->region;
  }

private:
  struct Node {
    int axis = -1;                      ///< -1: a region
    std::int64_t cut = 0;               ///< keys below it are in the node `below`
    std::uint32_t below = 0, above = 0; ///< indices of nodes
    std::uint32_t region = 0;
  };

  /// How many samples there are for how many regions.
  struct Density {
    std::uint64_t samples, parts;
  };
  std::uint32_t build(std::span<FrameKey> sample, const Density& density);

  std::vector<Node> nodes_;
  std::uint32_t regionCount_ = 1;
};

/// The regions of a triangle and of its corners. A vertex of a triangle that belongs to another region than the vertex
/// is fixed in all regions, so that each region knows its fixed vertices by its own triangles and those that touch it.
struct TriangleRegions {
  std::uint32_t triangle = 0;
  std::uint32_t corners[3] = {};

  TriangleRegions(const RegionTree& tree, const std::array<FrameKey, 3>& axes, const Vec3f& a, const Vec3f& b,
                  const Vec3f& c)
      : triangle(tree.regionOf(keyOfTriangle(axes, a, b, c))), corners{tree.regionOf(keyOfPoint(axes, a)),
                                                                       tree.regionOf(keyOfPoint(axes, b)),
                                                                       tree.regionOf(keyOfPoint(axes, c))} {}
};

} // namespace imgeo
