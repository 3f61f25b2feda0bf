#pragma once
// The images of all groups of a mesh with levels of detail: made while the groups are built, and counted.

#include "images/raster.h"
#include "imgeo/convert.h"
#include "prepare/levels/levels.h"
#include "transcode/encode/atlas.h"
#include "transcode/encode/chip_limits.h"
#include "transcode/encode/group_chips.h"
#include "transcode/encode/rebaked_atlas.h"

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace imgeo {

/// The image of a group, in a file.
struct ChipFile {
  Bytes bytes;
  RasterSize size;
  double texelEdge = 0; ///< in lattice steps
};

class LevelImages {
public:
  /// Null where the groups of a mesh cannot have images; `reason` is then why, or empty where it has no texture or the
  /// image is reported elsewhere.
  /// Throws Error{limit} for an image of more than `maxPixels`, where that is less than maxAtlasPixels.
  static std::unique_ptr<LevelImages> of(const Mesh& mesh, const ConvertOptions& options, const Atlas& atlas,
                                         std::string& reason, std::uint64_t maxPixels = maxAtlasPixels);

  /// The number of the set of texture coordinates that images have.
  std::size_t set() const { return set_; }
  /// Adds that set over all of an image, for the description of the node.
  void addWholeImage(Mesh& mesh) const;
  /// Replaces the set by one that states the chart of each wedge.
  void addCharts(Mesh& mesh);
  /// The same where charts have been found elsewhere.
  void setCharts(std::vector<ChartMask> charts);
  /// Whether the charts alone say that the images are of no use: before any group is built.
  bool areTooFragmented() const;

  /// Gives the mesh new charts, and resamples the whole image for them. Before, `mesh` has the source's charts, by
  /// addCharts(); `points` are its positions on the lattice. False where that is of no use.
  bool resample(Mesh& mesh, std::span<const Vec3u> points);
  /// New charts of the triangles of a mesh, which have the source's charts by setCharts(). Nothing where there is no
  /// way to make them. Throws Error{limit} as NewCharts::of() does.
  std::optional<ResampledTexture> resampled(const TriangleVisits& triangles, std::uint64_t maxBytes = UINT64_MAX) const;
  void setResampled(ResampledTexture texture);
  /// Null: the charts are the source's.
  const NewCharts* newCharts() const { return newCharts_ ? &*newCharts_ : nullptr; }
  /// Forgets the images that have been made.
  void restart();
  RasterSize size() const { return {source_.image.width, source_.image.height}; } ///< of the whole image, or the new

  void addLevel(std::size_t groupCount) { files_.emplace_back(groupCount); }
  /// Makes the image of a group, whose patch gets its texture coordinates. Safe to call from any thread. Returns false
  /// where the images have turned out to be of no use; the patch is as it was, and further ones are only counted.
  bool make(Patch& patch, std::uint32_t level, std::size_t group);
  /// The same, without keeping it: a file without bytes where the images have turned out to be of no use, of no size
  /// where it would be too large.
  ChipFile makeFile(Patch& patch, std::uint32_t level);
  /// States what is known of all images so far, of which other processes have made some.
  void setCounts(std::uint64_t texels, bool hasLargeImage) { texels_ = texels, hasLargeImage_ = hasLargeImage; }

  /// Why the images are of no use, with the numbers; empty where they are of use. When all groups have been built, or
  /// where areTooFragmented().
  std::string failure() const;
  /// In the order of the index: from the highest level down.
  std::vector<ChipFile> take();

private:
  double maxTexels() const { return maxChipShare * static_cast<double>(texelsOfWhole_); }
  bool hasFailed() const;

  ChipSource source_; ///< the whole image, or the new one
  std::uint64_t texelsOfWhole_ = 0;
  std::optional<NewCharts> newCharts_{};
  std::size_t set_ = 0;
  std::uint32_t groupTriangles_ = 0;
  std::optional<int> quality_{};               ///< of lossy WebP; nothing: lossless
  std::vector<std::vector<ChipFile>> files_{}; ///< by level
  double minTexels_ = 0;                       ///< that the images of level 0 have, by the charts
  std::atomic<bool> hasLargeImage_ = false;
  std::atomic<std::uint64_t> texels_ = 0; ///< of all images, made or not
};

/// Also counts the resolution of images as an error: a coarse form has half of its group's.
void addTexelErrors(Levels& levels, std::span<const double> texelEdges);

} // namespace imgeo
