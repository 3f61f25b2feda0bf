#include "transcode/verify/compare_mesh.h"

#include "base/parallel.h"
#include "containers/encodings.h"
#include "containers/flat_normals.h"
#include "containers/grid.h"
#include "containers/stored_coords.h"
#include "prepare/patches.h"
#include "transcode/verify/check_levels.h"
#include "transcode/verify/check_point_levels.h"
#include "transcode/verify/element_list.h"
#include "transcode/verify/foreign_site.h"
#include "transcode/verify/mesh_checks.h"

#include <algorithm>
#include <utility>

namespace imgeo {

namespace {

std::vector<IndexedPatch> decodePatches(const ContainerReader& reader, const GeometryDescription& geometry) {
  std::vector<IndexedPatch> patches(geometry.patches.size());
  parallelFor(patches.size(), [&](std::size_t i) { patches[i] = reader.decode(geometry.patches[i], geometry); });
  return patches;
}

void checkBoxes(const std::vector<IndexedPatch>& patches, const GeometryDescription& geometry, Findings& findings) {
  BoxCheck check(geometry);
  for (std::size_t i = 0; i < patches.size(); ++i)
    check.add(boxOf(patches[i], geometry.lattice), geometry.patches[i].box);
  check.report(findings);
}

/// Gives the patches of a grid without an image of normals those that a page shows.
void addSlopeNormals(std::vector<IndexedPatch>& patches, const GeometryDescription& geometry) {
  for (std::size_t i = 0; i < patches.size(); ++i)
    if (patches[i].normals.empty())
      patches[i].normals = slopeNormals(*geometry.grid, geometry.patches[i].implicitMeshSize, patches[i].positions,
                                        geometry.lattice, geometry.ccw);
}

/// Lattice points of the input's vertices, as the site stores them.
std::vector<Vec3u> quantisedAs(const GeometryDescription& geometry, const std::vector<IndexedPatch>& patches,
                               const Mesh& mesh, bool isForeign) {
  if (isForeign)
    return quantiseLike(patches, mesh.positions, geometry.lattice);
  return quantisedOn(expectedLattice(geometry, boxOf(mesh)), geometry, mesh.positions);
}

/// Checks that the base mesh, if there is one, can be decoded and leaves no crack at the border of any patch.
void checkBase(const ContainerReader& reader, const GeometryDescription& geometry,
               const std::vector<IndexedPatch>& patches, Findings& findings) {
  if (!geometry.base || geometry.levels)
    return;
  const BaseMesh base = reader.decodeBase(geometry);
  std::vector<PatchTriangles> triangles;
  for (const IndexedPatch& patch : patches)
    triangles.push_back({patch.positions, patch.indices});
  if (!meetsAtBorders(base, triangles))
    findings.add("The base does not meet the patches at their borders.");
}

} // namespace

void compareMesh(const ContainerReader& reader, const GeometryDescription& geometry, const Mesh& original,
                 const std::optional<SiteManifest>& manifest, VerifyReport& report, Findings& findings) {
  // Our height maps of one image have no normals: those of a page follow from the slope.
  std::optional<Mesh> copy;
  if (manifest && geometry.grid == GridKind::heightMap && !geometry.patches[0].vertexAttributes[VertexRole::normal]) {
    copy = original;
    copy->normals.clear();
  }
  const Mesh& mesh = copy ? *copy : original;
  std::vector<IndexedPatch> patches = decodePatches(reader, geometry);
  if (!geometry.isShared) // else the box is that of several patches; decoding has checked that it contains each
    checkBoxes(patches, geometry, findings);
  checkBase(reader, geometry, patches, findings);
  if (geometry.levels && geometry.levels->topology == Topology::points)
    checkPointLevels(*geometry.levels, reader.fetch(), findings);
  else if (geometry.levels)
    checkLevels(*geometry.levels, reader.fetch(), findings);
  if (geometry.isFlat && topologyOf(patches.front().draws.front().primitive) == Topology::triangles)
    for (IndexedPatch& patch : patches)
      makeFlat(patch, geometry.lattice);
  if (!manifest && mesh.normals.empty())
    for (IndexedPatch& patch : patches)
      patch.normals.clear(); // the other program computed them in a way that is not known
  if (geometry.grid && !mesh.normals.empty())
    addSlopeNormals(patches, geometry);
  checkAttributesPresent(mesh, patches, findings);
  const std::vector<Vec3u> quantised = quantisedAs(geometry, patches, mesh, !manifest);
  reportPositions(geometry, positionError(mesh.positions, quantised, geometry.lattice), boxOf(mesh), report, findings);

  const Topology topology = manifest ? manifest->primitives == Primitives::points ? Topology::points : mesh.topology
                                     : topologyOf(patches.front().draws.front().primitive);
  const bool isUnindexed = std::ranges::any_of(patches, &std::vector<std::uint32_t>::empty, &IndexedPatch::indices);
  const ElementKind kind{topology, isUnindexed};
  ElementList input = elementsOf(mesh, quantised, kind), site = elementsOf(patches, kind);
  const ElementTotals totals{input.elements.size(), site.elements.size()};
  const AttributeBounds bounds = boundsOf(geometry, reader.precisionOf(geometry), manifest);
  const ElementDifference difference = compare(std::move(input), std::move(site), bounds);
  addCounts(difference, totals, topology, report);
  addFindings(difference, bounds, topology, report, findings);
  if (!mesh.normals.empty())
    report.normalBoundDegrees = std::max(report.normalBoundDegrees, bounds.normalDegrees);
}

} // namespace imgeo
