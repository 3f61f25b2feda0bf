#include "transcode/verify/compare_instances.h"

#include "prepare/instances/correspondence.h"

#include <algorithm>
#include <cmath>

namespace imgeo {

namespace {

/// The inverse of a map; nothing for a singular one.
std::optional<Affine3d> inverseOf(const Affine3d& map) {
  const double determinant = map.determinant();
  if (!(std::abs(determinant) > 0))
    return std::nullopt;
  const Vec3d a = cross(map.y, map.z) * (1 / determinant), b = cross(map.z, map.x) * (1 / determinant),
              c = cross(map.x, map.y) * (1 / determinant); // the rows
  Affine3d inverse{{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}, {}};
  inverse.translation = inverse.direction(map.translation) * -1;
  return inverse;
}

std::optional<Correspondence> compared(const ShapePair& shape, const Mesh& source, const Mesh& mesh, double stated) {
  const std::optional<Affine3d> inputFromWorld = inverseOf(shape.worldFromInput);
  if (!inputFromWorld)
    return std::nullopt;
  const double rounding =
      transformSlack(shape.worldFromInput, boxOf(mesh)) / std::cbrt(std::abs(shape.worldFromInput.determinant()));
  return correspondence(source, mesh, *inputFromWorld * shape.worldFromSite, {.distance = stated + rounding});
}

} // namespace

double transformSlack(const Affine3d& map, const Box3d& box) {
  return 1e-6 * (length(map.direction(box.size())) + length(map.point(box.center())));
}

std::vector<ShapeMatch> matchShapes(const std::vector<ShapePair>& shapes, const std::vector<Mesh>& meshes,
                                    std::optional<double> stated, VerifyReport& report) {
  std::map<std::size_t, std::size_t> sources; ///< by geometry: the mesh that it has been made of
  for (const ShapePair& shape : shapes)
    if (shape.hasSameTransform)
      sources.try_emplace(shape.geometry, shape.mesh);
  report.instances = 0;
  report.instanceDistance = 0;
  report.instanceDistanceBound = stated.value_or(0);
  std::vector<ShapeMatch> matches;
  for (const ShapePair& shape : shapes) {
    const auto source = sources.find(shape.geometry);
    if (shape.hasSameTransform && (source->second == shape.mesh || !stated)) {
      matches.push_back(ShapeMatch::source);
      continue;
    }
    std::optional<Correspondence> correspondence;
    if (stated && source != sources.end())
      correspondence = compared(shape, meshes[source->second], meshes[shape.mesh], *stated);
    if (correspondence) {
      ++report.instances;
      report.instanceDistance = std::max(report.instanceDistance, correspondence->distance);
      matches.push_back(ShapeMatch::instance);
    } else {
      matches.push_back(shape.hasSameTransform ? ShapeMatch::source : ShapeMatch::moved);
    }
  }
  return matches;
}

} // namespace imgeo
