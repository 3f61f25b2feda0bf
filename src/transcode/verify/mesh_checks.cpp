#include "transcode/verify/mesh_checks.h"

#include "containers/encodings.h"
#include "containers/grid.h"
#include "containers/stored_coords.h"
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

/// Rounding error of double precision. It matters where coordinates are large and the lattice step is small (32 bits).
double positionTolerance(const Box3d& box, const Lattice& lattice) {
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis)
    largest = std::max({largest, std::abs(box.min[axis]), std::abs(box.max[axis])});
  return 1e-6 * lattice.step + 8 * largest * std::numeric_limits<double>::epsilon();
}

/// Whether a mesh has a lattice of its source's (findSourceLattice), which is coarser than that of its box: the last
/// points of the two lie apart; or holds the source's floats, which are the same on any lattice that is fine enough.
bool isSourceLattice(const GeometryDescription& geometry, const Lattice& ofBox) {
  if (rowOf(geometry).storage != PatchStorage::packed)
    return geometry.lattice.bits == sourceBits && coordTypeOf(geometry) == ElementType::float32;
  return (geometry.lattice.step - ofBox.step) * ofBox.maximum() > 0.25 * ofBox.step;
}

} // namespace

BoxCheck::BoxCheck(const GeometryDescription& geometry)
    : slack_(geometry.lattice.step / 2 + 1e-6 * geometry.box.longestEdge()), stated_(geometry.box) {}

bool BoxCheck::agree(const Box3d& a, const Box3d& b) const {
  for (int axis = 0; axis < 3 && !b.empty(); ++axis)
    if (!(std::abs(a.min[axis] - b.min[axis]) <= slack_ && std::abs(a.max[axis] - b.max[axis]) <= slack_))
      return false;
  return true;
}

void BoxCheck::add(const Box3d& ofVertices, const Box3d& stated) {
  ++count_;
  wrong_ += !agree(ofVertices, stated);
  whole_.add(ofVertices.min);
  whole_.add(ofVertices.max);
}

void BoxCheck::report(Findings& findings) const {
  if (wrong_ > 0)
    findings.add("{} of {} patches have a box that does not fit their vertices.", wrong_, count_);
  if (!agree(whole_, stated_))
    findings.add("The box of the geometry does not fit its vertices.");
}

Box3d boxOf(const IndexedPatch& patch, const Lattice& lattice) {
  Box3d box;
  for (const Vec3u q : patch.positions)
    box.add(lattice.point(q));
  return box;
}

Lattice expectedLattice(const GeometryDescription& geometry, const Box3d& ofMesh) {
  const bool isHeightMap = geometry.grid == GridKind::heightMap;
  const Lattice ofBox = latticeFor(ofMesh, coordTypeOf(geometry), geometry.lattice.bits);
  return geometry.isShared || isHeightMap || isSourceLattice(geometry, ofBox) ? geometry.lattice : ofBox;
}

std::vector<Vec3u> quantisedOn(const Lattice& expected, const GeometryDescription& geometry,
                               std::span<const Vec3f> positions) {
  std::vector<Vec3u> quantised = quantise(positions, expected);
  for (Vec3u& q : quantised)
    q = pointReadBack(q, expected, geometry);
  return quantised;
}

double positionError(std::span<const Vec3f> positions, const std::vector<Vec3u>& quantised, const Lattice& lattice) {
  double error = 0;
  for (std::size_t i = 0; i < quantised.size(); ++i) {
    const Vec3d off = lattice.point(quantised[i]) - Vec3d(positions[i]);
    error = std::max({error, std::abs(off.x), std::abs(off.y), std::abs(off.z)});
  }
  return error;
}

void reportPositions(const GeometryDescription& geometry, double error, const Box3d& ofMesh, VerifyReport& report,
                     Findings& findings) {
  const double slack = report.isForeign ? foreignRounding * geometry.lattice.step : 0,
               bound = positionErrorBound(geometry) + slack;
  if (error * report.positionBound >= report.positionError * bound)
    report.positionError = error, report.positionBound = bound;
  if (error > bound + positionTolerance(ofMesh, geometry.lattice))
    findings.add("Positions are off by up to {:.6g}, more than half a step of the lattice, {:.6g}.", error, bound);
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

void addCounts(const ElementDifference& difference, const ElementTotals& totals, Topology topology,
               VerifyReport& report) {
  report.input.of(topology) += totals.input;
  report.site.of(topology) += totals.site;
  report.missing.of(topology) += difference.missing;
  report.extra.of(topology) += difference.extra;
}

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

} // namespace imgeo
