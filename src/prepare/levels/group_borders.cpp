#include "prepare/levels/group_borders.h"

#include "prepare/edge_sum.h"
#include "prepare/position_table.h"

#include <algorithm>
#include <cstdlib>
#include <tuple>

namespace imgeo {

namespace {

bool isBefore(const Vec3u& a, const Vec3u& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// The border of triangles, over the numbers of their points in a table.
EdgeSum borderOf(const GroupTriangles& triangles, PositionTable& table) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(triangles.positions.size());
  for (const Vec3u& position : triangles.positions)
    numbers.push_back(table.indexOf(position));
  EdgeSum border;
  border.addTriangles(triangles.corners, [&](std::uint32_t position) { return numbers[position]; });
  return border;
}

} // namespace

std::vector<Vec3u> borderPointsOf(const GroupTriangles& group) {
  PositionTable table(group.positions.size());
  EdgeSum border = borderOf(group, table);
  std::vector<std::uint32_t> ends;
  border.visit([&](std::uint32_t a, std::uint32_t b, int) { ends.insert(ends.end(), {a, b}); });
  std::ranges::sort(ends);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<Vec3u> points;
  points.reserve(ends.size());
  for (const std::uint32_t end : ends)
    points.push_back(table.positions[end]);
  return points;
}

SharedBorderPoints::SharedBorderPoints(std::span<const std::vector<Vec3u>> byGroup) {
  std::vector<Vec3u> all;
  for (const std::vector<Vec3u>& points : byGroup)
    all.insert(all.end(), points.begin(), points.end());
  std::ranges::sort(all, isBefore);
  for (std::size_t i = 1; i < all.size(); ++i)
    if (all[i] == all[i - 1] && (points_.empty() || points_.back() != all[i]))
      points_.push_back(all[i]);
}

bool SharedBorderPoints::contains(const Vec3u& point) const {
  return std::ranges::binary_search(points_, point, isBefore);
}

bool hasOtherBorder(const GroupTriangles& group, const GroupTriangles& form, const SharedBorderPoints& shared) {
  PositionTable table(group.positions.size() + form.positions.size());
  EdgeSum border = borderOf(group, table), differences = borderOf(form, table);
  const auto isShared = [&](std::uint32_t number) { return shared.contains(table.positions[number]); };
  // Simplification maps each edge of the mesh's border, which no other group has, to one edge or to none.
  std::size_t ownEdges = 0, changedEdges = 0;
  border.visit([&](std::uint32_t a, std::uint32_t b, int count) {
    if (isShared(a) && isShared(b))
      differences.add(a, b, -count);
    else
      ownEdges += static_cast<std::size_t>(std::abs(count));
  });
  differences.visit(
      [&](std::uint32_t, std::uint32_t, int count) { changedEdges += static_cast<std::size_t>(std::abs(count)); });
  return changedEdges > ownEdges;
}

void appendSegment(GroupTriangles& form, const GroupTriangles& parent, std::uint32_t segment) {
  for (std::size_t triangle = 0; triangle < parent.segments.size(); ++triangle)
    for (std::size_t i = 0; i < 3 && parent.segments[triangle] == segment; ++i) {
      form.corners.push_back(static_cast<std::uint32_t>(form.positions.size()));
      form.positions.push_back(parent.positions[parent.corners[3 * triangle + i]]);
    }
}

} // namespace imgeo
