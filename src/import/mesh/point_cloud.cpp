#include "import/mesh/point_cloud.h"

#include "import/warnings.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <utility>

namespace imgeo {

Vec3d originOf(const Box3d& box) {
  constexpr double farRatio = 16;
  Vec3d origin{0, 0, 0};
  const double width = box.longestEdge();
  for (int axis = 0; axis < 3; ++axis)
    if (std::max(std::abs(box.min[axis]), std::abs(box.max[axis])) > farRatio * width)
      origin[axis] = std::floor((box.min[axis] + box.max[axis]) / 2);
  return origin;
}

Mesh pointCloud(std::string name, std::vector<Vec3f> positions) {
  Mesh mesh;
  mesh.name = std::move(name);
  mesh.topology = Topology::points;
  mesh.positions = std::move(positions);
  mesh.wedgePositions.resize(mesh.positions.size());
  std::iota(mesh.wedgePositions.begin(), mesh.wedgePositions.end(), 0u);
  mesh.corners = mesh.wedgePositions;
  return mesh;
}

std::string pointValueName(std::string_view stored, std::span<const std::string> taken) {
  std::string plain;
  for (const char c : stored)
    plain += c > ' ' && c <= '~' && c != ',' ? c : '_';
  if (plain.empty())
    plain = "extra";
  std::string unique = plain;
  for (int n = 2; std::ranges::find(taken, unique) != taken.end(); ++n)
    unique = fmt::format("{}_{}", plain, n);
  return unique;
}

void addPointValues(Mesh& mesh, NamedAttribute values, std::vector<std::string>& warnings) {
  std::uint64_t bad = 0;
  for (float& value : values.values)
    if (!std::isfinite(value)) {
      value = 0;
      ++bad;
    }
  if (bad > 0)
    warnings.push_back(fmt::format("'{}': {} no number within single precision; 0 replaces {}.", values.name,
                                   counted(bad, "value is", "values are"), bad == 1 ? "it" : "them"));
  mesh.namedAttributes.push_back(std::move(values));
}

} // namespace imgeo
