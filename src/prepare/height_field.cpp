#include "prepare/height_field.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace imgeo {

namespace {

/// How far coordinates may be from the grid, in its steps: single precision rounds them.
constexpr double maxRounding = 1e-3;

/// The different coordinates along an axis, in ascending order, if they are evenly spaced. Empty otherwise.
std::vector<float> evenCoordinates(const Mesh& mesh, int axis) {
  std::vector<float> all;
  all.reserve(mesh.positions.size());
  for (const Vec3f& position : mesh.positions)
    all.push_back(position[axis]);
  std::ranges::sort(all);
  all.erase(std::ranges::unique(all).begin(), all.end());
  if (all.size() < 2)
    return {};
  const double step = (double{all.back()} - all.front()) / static_cast<double>(all.size() - 1);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!(std::abs(all[i] - (all.front() + step * static_cast<double>(i))) <= maxRounding * step))
      return {};
  return all;
}

std::size_t indexOf(float coordinate, const std::vector<float>& coordinates) {
  return static_cast<std::size_t>(std::ranges::lower_bound(coordinates, coordinate) - coordinates.begin());
}

/// Whether the triangles are the two of each cell. `cells` are the numbers of the vertices on the grid.
bool hasGridTriangles(const Mesh& mesh, const std::vector<std::uint32_t>& cells, std::uint32_t columns) {
  std::vector<std::array<bool, 2>> isThere(cells.size());
  for (std::size_t first = 0; first < mesh.corners.size(); first += 3) {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = cells[mesh.wedgePositions[mesh.corners[first + i]]];
    std::ranges::rotate(corners, std::ranges::min_element(corners));
    const auto [a, b, c] = corners;
    const bool isUpperLeft = b == a + columns && c == a + 1 && c % columns != 0;
    const bool isLowerRight = b == a + columns - 1 && c == a + columns && a % columns != 0;
    if (!isUpperLeft && !isLowerRight)
      return false;
    bool& known = isThere[a][isLowerRight];
    if (known)
      return false;
    known = true;
  }
  return true;
}

} // namespace

std::variant<HeightField, std::string> heightFieldOf(const Mesh& mesh) {
  if (mesh.topology != Topology::triangles)
    return "it has no triangles";
  if (mesh.wedgeCount() != mesh.positions.size())
    return "it has creases or seams";
  const std::vector<float> xs = evenCoordinates(mesh, 0), zs = evenCoordinates(mesh, 2);
  if (xs.empty() || zs.empty())
    return "its vertices are on no regular grid along x and z";
  if (xs.size() * zs.size() != mesh.positions.size())
    return "its grid has holes";
  const auto columns = static_cast<std::uint32_t>(xs.size()), rows = static_cast<std::uint32_t>(zs.size());
  constexpr std::uint32_t none = UINT32_MAX;
  HeightField field{columns, rows, std::vector(mesh.positions.size(), none)};
  std::vector<std::uint32_t> cells(mesh.positions.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    cells[i] =
        static_cast<std::uint32_t>(indexOf(mesh.positions[i].z, zs) * columns + indexOf(mesh.positions[i].x, xs));
  for (std::uint32_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
    std::uint32_t& cell = field.wedges[cells[mesh.wedgePositions[wedge]]];
    if (cell != none)
      return "two of its vertices are above one another";
    cell = wedge;
  }
  if (mesh.elementCount() != std::size_t{2} * (columns - 1) * (rows - 1) || !hasGridTriangles(mesh, cells, columns))
    return "its triangles are not those of a grid whose cells are split from the lower left to the upper right";
  return field;
}

} // namespace imgeo
