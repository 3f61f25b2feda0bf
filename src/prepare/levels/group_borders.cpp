#include "prepare/levels/group_borders.h"

#include "prepare/edge_sum.h"
#include "prepare/levels/shared_points.h"
#include "prepare/position_table.h"

#include <cstdlib>

namespace imgeo {

namespace {

/// The groups of a level over common numbers of lattice points.
class NumberedLevel {
public:
  NumberedLevel(std::span<const GroupTriangles> groups, PositionTable& table) : groups_(groups) {
    for (const GroupTriangles& group : groups) {
      std::vector<std::uint32_t>& numbers = numbers_.emplace_back();
      for (const Vec3u& position : group.positions)
        numbers.push_back(table.indexOf(position));
    }
  }

  /// Calls visit(from, to, group, triangle) for each edge of each triangle of a group.
  template <typename Visit> void visitEdges(std::size_t group, Visit visit) const {
    const std::vector<std::uint32_t>& corners = groups_[group].corners;
    for (std::size_t corner = 0; corner < corners.size(); ++corner)
      visit(numbers_[group][corners[corner]], numbers_[group][corners[corner % 3 == 2 ? corner - 2 : corner + 1]],
            corner / 3);
  }

  /// By number: whether several groups have the point.
  std::vector<bool> sharedPoints(std::size_t pointCount) const {
    SharedPoints shared(pointCount);
    for (std::uint32_t group = 0; group < groups_.size(); ++group)
      for (const std::uint32_t corner : groups_[group].corners)
        shared.add(numbers_[group][corner], group);
    return shared.take();
  }

private:
  std::span<const GroupTriangles> groups_;
  std::vector<std::vector<std::uint32_t>> numbers_; ///< by group and position
};

std::size_t countPositions(std::span<const GroupTriangles> groups) {
  std::size_t count = 0;
  for (const GroupTriangles& group : groups)
    count += group.positions.size();
  return count;
}

} // namespace

std::optional<std::size_t> groupWithOtherBorder(std::span<const GroupTriangles> level,
                                                std::span<const GroupTriangles> above) {
  PositionTable table(countPositions(level) + countPositions(above));
  const NumberedLevel lower(level, table), upper(above, table);
  const std::vector<bool> isShared = lower.sharedPoints(table.positions.size());
  std::vector<EdgeSum> differences(level.size());
  for (std::size_t parent = 0; parent < above.size(); ++parent)
    upper.visitEdges(parent, [&](std::uint32_t from, std::uint32_t to, std::size_t triangle) {
      differences[above[parent].children[above[parent].segments[triangle]]].add(from, to);
    });
  for (std::size_t group = 0; group < level.size(); ++group) {
    EdgeSum border;
    lower.visitEdges(group, [&](std::uint32_t from, std::uint32_t to, std::size_t) { border.add(from, to); });
    // Simplification maps each edge of the mesh's border, which no other group has, to one edge or to none.
    std::size_t ownEdges = 0, changedEdges = 0;
    border.visit([&](std::uint32_t a, std::uint32_t b, int count) {
      if (isShared[a] && isShared[b])
        differences[group].add(a, b, -count);
      else
        ownEdges += static_cast<std::size_t>(std::abs(count));
    });
    differences[group].visit(
        [&](std::uint32_t, std::uint32_t, int count) { changedEdges += static_cast<std::size_t>(std::abs(count)); });
    if (changedEdges > ownEdges)
      return group;
  }
  return std::nullopt;
}

std::vector<GroupTriangles> coarseFormsIn(std::span<const GroupTriangles> above, std::size_t count) {
  std::vector<GroupTriangles> forms(count);
  for (const GroupTriangles& parent : above)
    for (std::size_t triangle = 0; triangle < parent.segments.size(); ++triangle) {
      GroupTriangles& form = forms[parent.children[parent.segments[triangle]]];
      for (std::size_t i = 0; i < 3; ++i) {
        form.corners.push_back(static_cast<std::uint32_t>(form.positions.size()));
        form.positions.push_back(parent.positions[parent.corners[3 * triangle + i]]);
      }
    }
  return forms;
}

} // namespace imgeo
