#include "transcode/verify/compare_resampled.h"

#include "containers/read_mesh.h"
#include "prepare/geometry_image/surface_distance.h"

#include <algorithm>

namespace imgeo {

namespace {

/// The points where distances are measured are those of convert, but for rounding.
constexpr double roundingFactor = 1.01;

bool isWithin(double distance, double stated, const Lattice& lattice) {
  return distance <= roundingFactor * stated + 0.01 * lattice.step;
}

} // namespace

void compareResampled(const ContainerReader& reader, const GeometryDescription& geometry, const Mesh& mesh,
                      VerifyReport& report, Findings& findings) {
  const Mesh surface = readMesh(reader, geometry, "the site");
  const SurfaceDistance stated = geometry.surfaceDistance.value();
  ++report.resampledMeshes;
  report.input.of(mesh.topology) += mesh.elementCount();
  report.site.of(surface.topology) += surface.elementCount();
  if (mesh.topology != Topology::triangles || mesh.elementCount() == 0 || surface.elementCount() == 0)
    return findings.add("A mesh and its geometry images are not both surfaces.");
  const SurfaceDistance distance = distanceBetween(mesh, surface);
  if (distance.largest - stated.largest >= report.surfaceDistance - report.surfaceDistanceBound ||
      report.resampledMeshes == 1) {
    report.surfaceDistance = distance.largest;
    report.surfaceDistanceBound = stated.largest;
  }
  if (!isWithin(distance.largest, stated.largest, geometry.lattice))
    findings.add("A surface is off by {:.6g}, which is more than the {:.6g} that the site states.", distance.largest,
                 stated.largest);
  else if (!isWithin(distance.mean, stated.mean, geometry.lattice))
    findings.add("A surface is off by {:.6g} in the mean, which is more than the {:.6g} that the site states.",
                 distance.mean, stated.mean);
  visitAttributes(mesh, surface, [&](const auto& row, const auto& ofMesh, const auto& ofSurface) {
    if (ofMesh.empty() != ofSurface.empty())
      findings.add("The {} has {}, the {} has none.", ofMesh.empty() ? "site" : "input", row.plural,
                   ofMesh.empty() ? "input" : "site");
  });
}

} // namespace imgeo
