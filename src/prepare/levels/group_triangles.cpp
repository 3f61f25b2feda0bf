#include "prepare/levels/group_triangles.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>

namespace imgeo {

namespace {

using Key = Vec3<std::int64_t>;

/// The axes of a frame as integers, so that keys are the same on every machine.
std::array<Key, 3> axesOf(GroupFrame frame) {
  if (frame == GroupFrame::straight)
    return {Key{1, 0, 0}, Key{0, 1, 0}, Key{0, 0, 1}};
  // Rodrigues' rotation by 0.75 about (1, 1, 1), times 2^20: the circulant matrix of these three numbers.
  constexpr std::int64_t a = 861013, b = -318880, c = 506443;
  return {Key{a, b, c}, Key{c, a, b}, Key{b, c, a}};
}

/// Thrice the centroid of each triangle in the frame.
std::vector<Key> keysOf(const Mesh& mesh, GroupFrame frame) {
  const std::array<Key, 3> axes = axesOf(frame);
  std::vector<Key> keys(mesh.elementCount());
  parallelForBlocks(keys.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t triangle = begin; triangle < end; ++triangle) {
      Key sum;
      for (std::size_t i = 0; i < 3; ++i)
        sum += Key(mesh.cornerPosition(3 * triangle + i));
      keys[triangle] = {dot(axes[0], sum), dot(axes[1], sum), dot(axes[2], sum)};
    }
  });
  return keys;
}

int longestKeyAxis(const std::vector<Key>& keys, std::span<const std::uint32_t> triangles) {
  Key low = keys[triangles[0]], high = low;
  for (const std::uint32_t triangle : triangles)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], keys[triangle][axis]);
      high[axis] = std::max(high[axis], keys[triangle][axis]);
    }
  const Key size = high - low;
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

/// Orders the triangles so that those of the first of two halves come first. Returns how many these are.
std::size_t halve(const std::vector<Key>& keys, std::span<std::uint32_t> triangles, std::uint32_t maxTriangles) {
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

std::vector<std::vector<std::uint32_t>> groupTriangles(const Mesh& mesh, std::uint32_t maxTriangles, GroupFrame frame) {
  const std::vector<Key> keys = keysOf(mesh, frame);
  std::vector<std::uint32_t> permutation(mesh.elementCount());
  std::iota(permutation.begin(), permutation.end(), 0u);
  std::vector<std::span<std::uint32_t>> nodes{permutation};
  while (std::ranges::any_of(nodes, [&](const auto& node) { return node.size() > maxTriangles; })) {
    std::vector<std::size_t> cuts(nodes.size());
    parallelFor(nodes.size(), [&](std::size_t i) {
      cuts[i] = nodes[i].size() > maxTriangles ? halve(keys, nodes[i], maxTriangles) : 0;
    });
    std::vector<std::span<std::uint32_t>> children;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (cuts[i] > 0)
        children.push_back(nodes[i].first(cuts[i]));
      children.push_back(nodes[i].subspan(cuts[i]));
    }
    nodes = std::move(children);
  }
  struct Group {
    std::uint64_t code;
    std::vector<std::uint32_t> triangles;
  };
  std::vector<Group> groups(nodes.size());
  parallelFor(nodes.size(), [&](std::size_t i) {
    groups[i].triangles.assign(nodes[i].begin(), nodes[i].end());
    std::ranges::sort(groups[i].triangles);
    groups[i].code = mortonCodeOf(mesh, groups[i].triangles);
  });
  std::ranges::sort(groups, [](const Group& a, const Group& b) {
    return std::tie(a.code, a.triangles.front()) < std::tie(b.code, b.triangles.front());
  });
  std::vector<std::vector<std::uint32_t>> result;
  for (Group& group : groups)
    result.push_back(std::move(group.triangles));
  return result;
}

} // namespace imgeo
