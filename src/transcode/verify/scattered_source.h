#pragma once
// A source that memory does not hold, divided into regions: each is compared with the triangles, or points, of the
// site there.

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
  /// Reads the source, which has one mesh, for what is known of all of it. `options` are those of its import.
  ScatteredSource(std::unique_ptr<ChunkedSource> source, const ImportOptions& options, const SiteManifest& manifest,
                  const VerifyWork& work);

  /// The source with a mesh of two vertices, which have the smallest and the largest of all values.
  const Imported& extremes() const { return extremes_; }

  Topology topology() const { return mesh_.topology(); } ///< triangles or points

  /// Divides the triangles, or points, among regions, by their points on the lattice of a geometry that was made of the
  /// source.
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
  void survey();

  std::unique_ptr<ChunkedSource> source_;
  ChunkedMesh mesh_; ///< its only one
  ImportOptions importOptions_;
  ConvertOptions convertOptions_; ///< as far as pieces are read by them
  const VerifyWork& work_;
  Survey survey_;
  Imported extremes_;
  const GeometryDescription* geometry_ = nullptr; ///< from scatterAs on
  Lattice lattice_;
  RegionedLevel level_;
  double positionError_ = 0;
};

} // namespace imgeo
