#include "prepare/levels/group_triangles.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>

namespace imgeo {

namespace {

/// The keys of all triangles of a mesh.
std::vector<FrameKey> keysOf(const Mesh& mesh, GroupFrame frame) {
  const std::array<FrameKey, 3> axes = axesOf(frame);
  std::vector<FrameKey> keys(mesh.elementCount());
  parallelForBlocks(keys.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t triangle = begin; triangle < end; ++triangle)
      keys[triangle] = keyOfTriangle(axes, mesh.cornerPosition(3 * triangle), mesh.cornerPosition(3 * triangle + 1),
                                     mesh.cornerPosition(3 * triangle + 2));
  });
  return keys;
}

int longestKeyAxis(const std::vector<FrameKey>& keys, std::span<const std::uint32_t> triangles) {
  FrameKey low = keys[triangles[0]], high = low;
  for (const std::uint32_t triangle : triangles)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], keys[triangle][axis]);
      high[axis] = std::max(high[axis], keys[triangle][axis]);
    }
  const FrameKey size = high - low;
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

/// Orders the triangles so that those of the first of two halves come first. Returns how many these are.
std::size_t halve(const std::vector<FrameKey>& keys, std::span<std::uint32_t> triangles, std::uint32_t maxTriangles) {
  const std::size_t groupCount = (triangles.size() + maxTriangles - 1) / maxTriangles;
  // A node of three groups is cut at a third, so that groups are well filled.
  const std::size_t cut = triangles.size() * (groupCount / 2) / groupCount;
  const int axis = longestKeyAxis(keys, triangles);
  std::nth_element(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(cut), triangles.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return keys[a][axis] != keys[b][axis] ? keys[a][axis] < keys[b][axis] : a < b;
                   });
  return cut;
}

/// The bits of a number below 2^21, each followed by two zeros.
std::uint64_t spreadBits(std::uint64_t value) {
  std::uint64_t result = 0;
  for (int bit = 0; bit < 21; ++bit)
    result |= (value >> bit & 1) << (3 * bit);
  return result;
}

/// The position of a group's box along a Morton curve.
std::uint64_t mortonCodeOf(const Mesh& mesh, std::span<const std::uint32_t> triangles) {
  Box3d box;
  for (const std::uint32_t triangle : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      box.add(Vec3d(mesh.cornerPosition(3 * std::size_t{triangle} + i)));
  const auto part = [&](int axis) { return static_cast<std::uint64_t>(box.center()[axis] / 8); }; // of 24 bits 21
  return spreadBits(part(0)) | spreadBits(part(1)) << 1 | spreadBits(part(2)) << 2;
}

} // namespace

std::vector<std::vector<std::uint32_t>> groupTriangles(const Mesh& mesh,
                                                       std::vector<std::vector<std::uint32_t>> regions,
                                                       std::uint32_t maxTriangles, GroupFrame frame) {
  const std::vector<FrameKey> keys = keysOf(mesh, frame);
  struct RegionPart {
    std::size_t region;
    std::span<std::uint32_t> triangles;
  };
  std::vector<RegionPart> nodes;
  for (std::size_t region = 0; region < regions.size(); ++region)
    if (!regions[region].empty())
      nodes.push_back({region, regions[region]});
  const auto isTooLarge = [&](const RegionPart& node) { return node.triangles.size() > maxTriangles; };
  while (std::ranges::any_of(nodes, isTooLarge)) {
    std::vector<std::size_t> cuts(nodes.size());
    parallelFor(nodes.size(), [&](std::size_t i) {
      cuts[i] = isTooLarge(nodes[i]) ? halve(keys, nodes[i].triangles, maxTriangles) : 0;
    });
    std::vector<RegionPart> children;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (cuts[i] > 0)
        children.push_back({nodes[i].region, nodes[i].triangles.first(cuts[i])});
      children.push_back({nodes[i].region, nodes[i].triangles.subspan(cuts[i])});
    }
    nodes = std::move(children);
  }
  struct CodedGroup {
    std::size_t region;
    std::uint64_t code;
    std::vector<std::uint32_t> triangles;
  };
  std::vector<CodedGroup> groups(nodes.size());
  parallelFor(nodes.size(), [&](std::size_t i) {
    groups[i].region = nodes[i].region;
    groups[i].triangles.assign(nodes[i].triangles.begin(), nodes[i].triangles.end());
    std::ranges::sort(groups[i].triangles);
    groups[i].code = mortonCodeOf(mesh, groups[i].triangles);
  });
  std::ranges::sort(groups, [](const CodedGroup& a, const CodedGroup& b) {
    return std::tie(a.region, a.code, a.triangles.front()) < std::tie(b.region, b.code, b.triangles.front());
  });
  std::vector<std::vector<std::uint32_t>> result;
  for (CodedGroup& group : groups)
    result.push_back(std::move(group.triangles));
  return result;
}

} // namespace imgeo
