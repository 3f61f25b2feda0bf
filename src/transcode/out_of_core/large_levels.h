#pragma once
// What the levels of large meshes and of large clouds have in common: the survey of the mesh, the description of the
// node, the shares of memory, and the files of the site.

#include "transcode/encode/levels.h"
#include "transcode/out_of_core/out_of_core.h"
#include "transcode/out_of_core/passes.h"
#include "transcode/out_of_core/region_files.h"
#include "transcode/out_of_core/source_passes.h"

#include <functional>
#include <string>
#include <vector>

namespace imgeo {

/// What all builders of levels out of core are made from.
struct LargeTask {
  ChunkedMesh mesh;
  const ImportOptions& importOptions;
  const ConvertOptions& options; ///< resolved
  Ranks& ranks;
  const Progress& progress;
  ShareOfMeshes share;
  std::uint64_t laterElements = 0; ///< of the large meshes behind it, which need disk too
};

class LargeLevels {
public:
  explicit LargeLevels(const LargeTask& task);
  virtual ~LargeLevels() = default;
  LargeLevels(const LargeLevels&) = delete;
  LargeLevels& operator=(const LargeLevels&) = delete;

  /// Builds what ranks share. All ranks do this together.
  void buildShared();
  /// Builds the rest and writes the files. Only on rank 0.
  LargeMesh finish(ContentFiles& files);
  std::size_t taskCount() const { return passes_.taskCount(); } ///< of all ranks

protected:
  /// Builds groups when the source has been surveyed.
  virtual void buildLevels() = 0;
  /// Forgets what has been built, to build it again without images.
  virtual void forgetLevels() {}
  /// Builds the levels that ranks do not share.
  virtual void buildRest() {}
  /// All levels that have been built.
  virtual Levels takeLevels() = 0;
  /// A coarse form with positions of the source.
  virtual Mesh coarseForm() = 0;

  /// The number that names the work files of a level: other ones with images of groups, without which levels may have
  /// to be built again.
  std::uint32_t fileNumber(std::uint32_t level) const {
    return level + (!images_ ? 0 : resamples_ ? 2 * firstFileWithImages : firstFileWithImages);
  }
  std::uint64_t memory() const { return options_.memoryBytes - imageBytes_; }
  /// How many tasks are done at a time that take so much memory each.
  std::size_t atOnce(std::uint64_t bytesEach) const;
  std::size_t piecesAtOnce() const;
  std::size_t regionsAtOnce() const;
  /// Calls make(maxBytes) with the memory that there is for new charts, and refuses the option --memory where that is
  /// too little.
  Bytes withinMemory(const std::function<Bytes(std::uint64_t maxBytes)>& make) const;
  void setResampled(ResampledTexture texture);
  /// Moves lattice points to where they are in the source.
  void moveToSource(Mesh& mesh) const;

  const ChunkedMesh mesh_;
  const ImportOptions& importOptions_;
  const ConvertOptions& options_;
  Ranks& ranks_;
  const WorkFolder& work_;
  Passes passes_;
  const LevelOptions levelOptions_;
  EncodeOptions encoding_;
  LargeMesh result_;

  Survey survey_;
  Lattice lattice_;
  std::uint32_t maximum_ = 0; ///< of coordinates
  bool computesNormals_ = false;
  double creaseDegrees_ = smoothDegrees; ///< of computed normals
  Mesh extremes_;                        ///< two vertices that have the least and the largest of all values
  std::unique_ptr<LevelImages> images_;  ///< nullptr: groups have none
  bool resamples_ = false;               ///< images have new charts, whatever the source's are
  std::string imageObstacle_;            ///< why the source's charts are of no use for images; empty: not known to be
  std::vector<Vec3f> sample_;            ///< lattice points of the corners of sampled elements

  std::vector<std::vector<RegionGroups>> storedLevels_; ///< of levels that are in work files, without `group`
  std::vector<std::vector<GroupFile>> rest_;            ///< levels above, which are in memory
  std::vector<std::vector<Bytes>> restBytes_;
  std::vector<std::vector<ChipFile>> restChips_; ///< their images

private:
  static constexpr std::uint32_t firstFileWithImages = 100; // more than there are levels

  void describe();
  void findTexture();
  void settleImages();
  SourcePieces pieces() const;
  void requireDisk() const;
  std::string writeFiles(const LevelIndex& index, std::span<const GroupFile> groups, std::span<const ChipRow> chips,
                         ContentFiles& files);

  std::uint64_t laterElements_ = 0;
  bool hasRest_ = false;         ///< whether buildRest() has been called
  std::uint64_t imageBytes_ = 0; ///< memory of the whole image and its charts
};

std::unique_ptr<LargeLevels> largeMeshLevels(const LargeTask& task);
std::unique_ptr<LargeLevels> largeCloudLevels(const LargeTask& task);

/// Coarse forms whose level has at most so many groups stand in for the source where it is looked at.
inline constexpr std::size_t maxCoarseGroups = 16;

} // namespace imgeo
