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

#include <algorithm>
#include <cmath>
#include <fmt/ranges.h>
#include <limits>
#include <set>

namespace imgeo {

namespace {

/// Type of the coordinates. For images any integer type will do: it only selects the exact lattice.
ElementType coordTypeOf(const GeometryDescription& geometry) {
  return hasElementTypes(geometry.encoding) ? geometry.coordType : ElementType::uint32;
}

std::vector<IndexedPatch> decodePatches(const ContainerReader& reader, const GeometryDescription& geometry) {
  std::vector<IndexedPatch> patches(geometry.patches.size());
  parallelFor(patches.size(), [&](std::size_t i) { patches[i] = reader.decode(geometry.patches[i], geometry); });
  return patches;
}

/// Gives the patches of a grid without an image of normals those that a page shows.
void addSlopeNormals(std::vector<IndexedPatch>& patches, const GeometryDescription& geometry) {
  for (std::size_t i = 0; i < patches.size(); ++i)
    if (patches[i].normals.empty())
      patches[i].normals = slopeNormals(*geometry.grid, geometry.patches[i].implicitMeshSize, patches[i].positions,
                                        geometry.lattice, geometry.ccw);
}

/// Checks that every patch has the box that the document states for it, where it states one.
void checkBoxes(const std::vector<IndexedPatch>& patches, const GeometryDescription& geometry, Findings& findings) {
  const double slack = geometry.lattice.step / 2 + 1e-6 * geometry.box.longestEdge();
  const auto agree = [&](const Box3d& a, const Box3d& b) {
    for (int axis = 0; axis < 3 && !b.empty(); ++axis)
      if (!(std::abs(a.min[axis] - b.min[axis]) <= slack && std::abs(a.max[axis] - b.max[axis]) <= slack))
        return false;
    return true;
  };
  Box3d whole;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    Box3d box;
    for (const Vec3u q : patches[i].positions)
      box.add(geometry.lattice.point(q));
    wrong += !agree(box, geometry.patches[i].box);
    whole.add(box.min);
    whole.add(box.max);
  }
  if (wrong > 0)
    findings.add("{} of {} patches have a box that does not fit their vertices.", wrong, patches.size());
  if (!agree(whole, geometry.box))
    findings.add("The box of the geometry does not fit its vertices.");
}

/// Maximum distance along an axis between a vertex of the input and its lattice point in the site.
double positionError(const Mesh& mesh, const std::vector<Vec3u>& quantised, const Lattice& lattice) {
  double error = 0;
  for (std::size_t i = 0; i < quantised.size(); ++i) {
    const Vec3d off = lattice.point(quantised[i]) - Vec3d(mesh.positions[i]);
    error = std::max({error, std::abs(off.x), std::abs(off.y), std::abs(off.z)});
  }
  return error;
}

/// Rounding error of double precision. It matters where coordinates are large and the lattice step is small (32 bits).
double positionTolerance(const Mesh& mesh, const Lattice& lattice) {
  const Box3d box = boxOf(mesh);
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis)
    largest = std::max({largest, std::abs(box.min[axis]), std::abs(box.max[axis])});
  return 1e-6 * lattice.step + 8 * largest * std::numeric_limits<double>::epsilon();
}

void checkAttributesPresent(const Mesh& mesh, const std::vector<IndexedPatch>& patches, Findings& findings) {
  visitAttributes(mesh, [&](const auto& row, const auto& values) {
    const bool inInput = !values.empty();
    for (const IndexedPatch& patch : patches)
      if ((patch.*row.values).empty() == inInput && patch.vertexCount() > 0)
        return findings.add("The {} {} {}.", inInput ? "input has" : "site has", row.plural,
                            inInput ? "that the site lacks" : "that the input lacks");
  });
  const auto namesOf = [](const VertexAttributes& attributes) {
    std::set<std::string> names;
    for (const NamedAttribute& attribute : attributes.namedAttributes)
      names.insert(fmt::format("\"{}\" of {}", attribute.name, attribute.components));
    return names;
  };
  for (const IndexedPatch& patch : patches)
    if (namesOf(patch) != namesOf(mesh))
      return findings.add("The input's further attributes are {}, the site's {}.", fmt::join(namesOf(mesh), ", "),
                          fmt::join(namesOf(patch), ", "));
}

/// Adds the counts of a mesh to those of the report.
void addCounts(const ElementDifference& difference, const ElementList& input, const ElementList& site,
               Topology topology, VerifyReport& report) {
  report.input.of(topology) += input.elements.size();
  report.site.of(topology) += site.elements.size();
  report.missing.of(topology) += difference.missing;
  report.extra.of(topology) += difference.extra;
}

/// Whether a mesh has a lattice of its source's (findSourceLattice), which is coarser than that of its box: the last
/// points of the two lie apart.
bool isSourceLattice(const GeometryDescription& geometry, const Lattice& ofBox) {
  return rowOf(geometry).storage == PatchStorage::packed &&
         (geometry.lattice.step - ofBox.step) * ofBox.maximum() > 0.25 * ofBox.step;
}

/// Lattice points of the input's vertices, as the site stores them: on the lattice of all meshes in the file, of a
/// grid, of the source, or of the mesh's box.
std::vector<Vec3u> quantisedAs(const GeometryDescription& geometry, const std::vector<IndexedPatch>& patches,
                               const Mesh& mesh, bool isForeign) {
  if (isForeign)
    return quantiseLike(patches, mesh.positions, geometry.lattice);
  const bool isHeightMap = geometry.grid == GridKind::heightMap;
  const Lattice ofBox = latticeFor(boxOf(mesh), coordTypeOf(geometry), geometry.lattice.bits);
  const bool hasOther = geometry.isShared || isHeightMap || isSourceLattice(geometry, ofBox);
  const Lattice& expected = hasOther ? geometry.lattice : ofBox;
  std::vector<Vec3u> quantised = quantise(mesh.positions, expected);
  for (Vec3u& q : quantised)
    q = pointReadBack(q, expected, geometry);
  return quantised;
}

void checkPositions(const GeometryDescription& geometry, const std::vector<Vec3u>& quantised, const Mesh& mesh,
                    VerifyReport& report, Findings& findings) {
  const double error = positionError(mesh, quantised, geometry.lattice),
               slack = report.isForeign ? foreignRounding * geometry.lattice.step : 0,
               bound = positionErrorBound(geometry) + slack;
  if (error * report.positionBound >= report.positionError * bound)
    report.positionError = error, report.positionBound = bound;
  if (error > bound + positionTolerance(mesh, geometry.lattice))
    findings.add("Positions are off by up to {:.6g}, more than half a step of the lattice, {:.6g}.", error, bound);
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

/// Compares the differences of a mesh with the allowed ones.
void addFindings(const ElementDifference& difference, const AttributeBounds& bounds, Topology topology,
                 VerifyReport& report, Findings& findings) {
  const char* elements = nameOf(topology);
  if (difference.missing > 0)
    findings.add("{} {} of the input are missing from the site.", difference.missing, elements);
  if (difference.extra > 0)
    findings.add("{} {} of the site are not in the input.", difference.extra, elements);

  reportAttributes(difference, bounds, report, findings);
  if (difference.colorsDiffering > 0)
    findings.add("{} {} have other colours: a channel is off by up to {:.3g} of 255, more than its rounding, {:.3g}.",
                 difference.colorsDiffering, elements, 255 * difference.color, 255 * bounds.color);
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
  checkPositions(geometry, quantised, mesh, report, findings);

  const Topology topology = manifest ? manifest->primitives == Primitives::points ? Topology::points : mesh.topology
                                     : topologyOf(patches.front().draws.front().primitive);
  const bool isUnindexed = std::ranges::any_of(patches, &std::vector<std::uint32_t>::empty, &IndexedPatch::indices);
  const ElementKind kind{topology, isUnindexed};
  const ElementList input = elementsOf(mesh, quantised, kind), site = elementsOf(patches, kind);
  const AttributeBounds bounds = boundsOf(geometry, reader.precisionOf(geometry), manifest);
  const ElementDifference difference = compare(input, site, bounds);
  addCounts(difference, input, site, topology, report);
  addFindings(difference, bounds, topology, report, findings);
  if (!mesh.normals.empty())
    report.normalBoundDegrees = std::max(report.normalBoundDegrees, bounds.normalDegrees);
}

} // namespace imgeo
