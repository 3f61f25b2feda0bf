#pragma once
// A mesh of a source that memory does not hold, divided into regions: each is compared with the triangles, or points,
// of the site there.

#include "import/chunks/chunked_source.h"
#include "transcode/out_of_core/level_regions.h"
#include "transcode/out_of_core/survey.h"
#include "transcode/site/site_manifest.h"
#include "transcode/verify/element_list.h"
#include "transcode/verify/verify_work.h"

#include <memory>
#include <vector>

namespace imgeo {

class ScatteredSource {
public:
  /// Reads the mesh for what is known of all of it. `options`, those of its import, and `work`, whose mesh it is, must
  /// outlive the object.
  ScatteredSource(const ChunkedMesh& mesh, const ImportOptions& options, const SiteManifest& manifest,
                  const VerifyWork& work);

  /// A mesh of two vertices, which have the smallest and the largest of all values.
  const Mesh& extremes() const { return extremes_; }

  Topology topology() const { return mesh_.topology(); } ///< triangles or points
  std::uint64_t diskBytes() const;                       ///< of the work files of the mesh and of the site's, about

  /// Divides the triangles, or points, among regions, by their points on the lattice of a geometry that was made of the
  /// mesh, and that must outlive what is called then.
  void scatterAs(const GeometryDescription& geometry);
  const RegionTree& regions() const { return level_.tree; }
  /// The largest error of a position along an axis.
  double positionError() const { return positionError_; }

  /// The triangles or points of a region, welded, with normals, and colours as they were rounded.
  ElementList elementsOf(std::uint32_t region) const;

private:
  /// The lattice points of positions of the source, as the site stores them.
  std::vector<Vec3u> pointsOf(const Mesh& mesh) const;
  Imported readPiece(std::size_t chunk) const;
  Survey survey() const;

  ChunkedMesh mesh_;
  const ImportOptions& importOptions_;
  ConvertOptions convertOptions_; ///< as far as pieces are read by them
  const VerifyWork& work_;
  Box3d box_;
  Mesh extremes_;
  const GeometryDescription* geometry_ = nullptr; ///< from scatterAs on
  Lattice lattice_;
  RegionedLevel level_;
  double positionError_ = 0;
};

} // namespace imgeo
