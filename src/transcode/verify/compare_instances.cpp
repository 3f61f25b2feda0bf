#include "transcode/verify/compare_instances.h"

#include "base/affine_inverse.h"
#include "prepare/instances/correspondence.h"

#include <algorithm>
#include <cmath>

namespace imgeo {

namespace {

std::optional<Correspondence> compared(const ShapePair& shape, const Mesh& source, const Mesh& mesh, double stated) {
  if (shape.worldFromInput.determinant() == 0)
    return std::nullopt;
  const double rounding =
      transformSlack(shape.worldFromInput, boxOf(mesh)) / std::cbrt(std::abs(shape.worldFromInput.determinant()));
  return correspondence(source, mesh, inverseOf(shape.worldFromInput) * shape.worldFromSite,
                        {.distance = stated + rounding});
}

} // namespace

double transformSlack(const Affine3d& map, const Box3d& box) {
  return 1e-6 * (length(map.direction(box.size())) + length(map.point(box.center())));
}

std::vector<ShapeMatch> matchShapes(const std::vector<ShapePair>& shapes, const SceneMeshes& meshes,
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
      correspondence = compared(shape, *meshes[source->second], *meshes[shape.mesh], *stated);
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
