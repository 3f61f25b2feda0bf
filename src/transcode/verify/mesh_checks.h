#pragma once
// What is compared of a mesh and a geometry besides their elements, and what of it is reported. Meshes in memory and
// those that it does not hold are checked alike.

#include "containers/patch_reader.h"
#include "scene/mesh.h"
#include "transcode/verify/element_list.h"
#include "transcode/verify/findings.h"

#include <cstddef>
#include <vector>

namespace imgeo {

/// Compares the boxes that the document states for patches and for all of them with those of their vertices. A patch
/// whose box is not stated has any.
class BoxCheck {
public:
  explicit BoxCheck(const GeometryDescription& geometry);
  void add(const Box3d& ofVertices, const Box3d& stated);
  void report(Findings& findings) const;

private:
  bool agree(const Box3d& a, const Box3d& b) const;

  double slack_;
  Box3d whole_, stated_;
  std::size_t wrong_ = 0, count_ = 0;
};

/// The box of decoded vertices.
Box3d boxOf(const IndexedPatch& patch, const Lattice& lattice);

/// The lattice on which a site has the vertices of a mesh with the box `ofMesh`: of all meshes in the file, of a grid,
/// of the source, or of the mesh's box.
Lattice expectedLattice(const GeometryDescription& geometry, const Box3d& ofMesh);

/// The lattice points of positions, as the site stores them.
std::vector<Vec3u> quantisedOn(const Lattice& expected, const GeometryDescription& geometry,
                               std::span<const Vec3f> positions);

/// Maximum distance along an axis between positions of the input and their lattice points in the site.
double positionError(std::span<const Vec3f> positions, const std::vector<Vec3u>& quantised, const Lattice& lattice);

/// Adds the largest error of positions to the report, and a finding where it is larger than allowed. `ofMesh`: the box
/// of the mesh.
void reportPositions(const GeometryDescription& geometry, double error, const Box3d& ofMesh, VerifyReport& report,
                     Findings& findings);

/// Checks that patches have the attributes of a mesh, whose values are not looked at.
void checkAttributesPresent(const Mesh& mesh, const std::vector<IndexedPatch>& patches, Findings& findings);

/// The numbers of elements of an input and of a site.
struct ElementTotals {
  std::size_t input = 0, site = 0;
};

/// Adds the counts of a mesh to those of the report.
void addCounts(const ElementDifference& difference, const ElementTotals& totals, Topology topology,
               VerifyReport& report);

/// Compares the differences of a mesh with the allowed ones.
void addFindings(const ElementDifference& difference, const AttributeBounds& bounds, Topology topology,
                 VerifyReport& report, Findings& findings);

} // namespace imgeo
