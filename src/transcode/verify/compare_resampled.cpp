#include "transcode/verify/compare_resampled.h"

#include "base/parallel.h"
#include "containers/read_mesh.h"
#include "containers/stored_coords.h"
#include "prepare/geometry_image/surface_distance.h"
#include "transcode/verify/compare_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace imgeo {

namespace {

/// The points where distances are measured are those of convert, but for rounding.
constexpr double roundingFactor = 1.01;

bool isWithin(double distance, double stated, const Lattice& lattice) {
  return distance <= roundingFactor * stated + 0.01 * lattice.step;
}

/// The largest distance between a stored vertex and the point of the mesh that it was sampled at.
double largestRounding(const GeometryDescription& geometry, const Mesh& mesh) {
  const Box3d box = boxOf(mesh);
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis)
    largest = std::max({largest, std::abs(box.min[axis]), std::abs(box.max[axis])});
  const double ofAxis = positionErrorBound(geometry) + 2 * std::numeric_limits<float>::epsilon() * largest;
  return std::numbers::sqrt3 * ofAxis;
}

/// Compares the attributes of the grids' vertices with those of the mesh where they were sampled.
void compareVertices(const ContainerReader& reader, const GeometryDescription& geometry, const Mesh& mesh,
                     const std::optional<SiteManifest>& manifest, VerifyReport& report, Findings& findings) {
  std::vector<IndexedPatch> patches(geometry.patches.size());
  parallelFor(patches.size(), [&](std::size_t i) { patches[i] = reader.decode(geometry.patches[i], geometry); });
  const AttributeBounds bounds = boundsOf(geometry, reader.precisionOf(geometry), manifest);
  const SampleDifference difference =
      compareSamples(mesh, patches, geometry.lattice, largestRounding(geometry, mesh), bounds);
  if (difference.beside > 0)
    findings.add("{} of {} vertices of geometry images are not on the surface of the input.", difference.beside,
                 difference.samples);
  reportAttributes(difference, bounds, report, findings);
  if (difference.colorsDiffering > 0)
    findings.add("{} of {} vertices of geometry images have other colours: a channel is off by up to {:.3g} of 255, "
                 "more than its rounding, {:.3g}.",
                 difference.colorsDiffering, difference.samples, 255 * difference.color, 255 * bounds.color);
  if (!mesh.normals.empty())
    report.normalBoundDegrees = std::max(report.normalBoundDegrees, bounds.normalDegrees);
}

} // namespace

void compareResampled(const ContainerReader& reader, const GeometryDescription& geometry, const Mesh& mesh,
                      const std::optional<SiteManifest>& manifest, VerifyReport& report, Findings& findings) {
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
  compareVertices(reader, geometry, mesh, manifest, report, findings);
}

} // namespace imgeo
