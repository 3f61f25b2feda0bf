#include "import/mesh/point_cloud.h"

#include "import/mesh/metadata_set.h"
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

Mesh pointCloud(std::string name, CloudPoints points, const Vec3d& origin) {
  std::vector<Vec3f> positions;
  positions.reserve(points.positions.size());
  for (const Vec3d& position : points.positions)
    positions.emplace_back(position - origin);
  Mesh mesh = pointCloud(std::move(name), std::move(positions));
  mesh.normals = std::move(points.normals);
  mesh.colors = std::move(points.colors);
  mesh.namedAttributes = std::move(points.values);
  return mesh;
}

Rgba pointColor(std::span<const double, 3> channels, double white, std::uint64_t& clamped) {
  float color[3];
  for (std::size_t n = 0; n < 3; ++n) {
    const double fraction = channels[n] / white;
    clamped += !(fraction >= 0 && fraction * 255 < 255.5);
    color[n] = channelOf(fraction);
  }
  return {color[0], color[1], color[2], 1.0f};
}

void addOrigin(SceneGraph& graph, const Vec3d& origin) {
  if (origin == Vec3d{0, 0, 0})
    return;
  for (const std::size_t root : graph.roots) {
    MetadataSet set(graph);
    set.addPoint("origin", origin);
    set.addTo(root, georeferenceName);
  }
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
