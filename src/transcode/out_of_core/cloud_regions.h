#pragma once
// A cloud that is divided into regions: scattering its points, building the levels of a region, and measuring its
// distances from the levels above.

#include "containers/levels/group_file.h"
#include "prepare/lattice.h"
#include "prepare/levels/point_levels.h"
#include "transcode/out_of_core/region_files.h"

#include <vector>

namespace imgeo {

/// What all regions of a cloud have in common.
struct RegionedCloud {
  RegionTree tree{};
  RecordLayout layout{};            ///< of scattered points
  const Lattice* lattice = nullptr; ///< of their positions, which are the source's
  std::uint32_t height = 0;         ///< the level of the root of each region
  std::size_t scatterTasks = 0;
};

/// Divides the points of a piece among the regions: writeScattered().
Bytes scatterPoints(const RegionedCloud& cloud, const Mesh& piece);

/// Encodes the groups of levels as they are built.
class GroupEncoder {
public:
  /// Takes levels from `firstLevel` on.
  GroupEncoder(const GeometryDescription& geometry, const EncodeOptions& encoding, std::uint32_t firstLevel)
      : geometry_(geometry), encoding_(encoding), firstLevel_(firstLevel) {}

  /// `alsoTake`: called like the sink's `take`, before.
  PointGroupSink sink(std::function<void(std::uint32_t level, std::size_t group, const std::vector<Patch>&)> alsoTake);
  /// By level: writeRegionGroups() of what `levels` has of the groups.
  std::vector<Bytes> takeFiles(PointLevels levels);

private:
  struct Level {
    std::vector<GroupRow> rows;
    std::vector<Bytes> files;
  };

  const GeometryDescription& geometry_;
  const EncodeOptions& encoding_;
  std::uint32_t firstLevel_;
  std::vector<Level> levels_;
};

/// What building a region gives.
struct BuiltCloudRegion {
  std::vector<Bytes> groups; ///< by level: writeRegionGroups(); children are numbers within the region
  Bytes root;                ///< records of the root's points, whose positions are lattice points
  Bytes region;              ///< to be read by CloudRegion
};

BuiltCloudRegion buildCloudRegion(const RegionedCloud& cloud, const WorkFolder& work, std::uint32_t region,
                                  const LevelOptions& options, const GeometryDescription& geometry,
                                  const EncodeOptions& encoding);

/// What is kept of a region that has been built.
struct CloudRegion {
  std::uint32_t height = 0;  ///< the level of its root
  std::vector<Vec3u> points; ///< of level 0, with repetitions

  CloudRegion(ByteSpan bytes, const std::string& path);
};

/// The level of the root of a region, of which the file is at `path`.
std::uint32_t readRegionHeight(const std::string& path);

/// Appends the points of a patch to a mesh of points.
void appendPoints(Mesh& mesh, const Patch& patch);

/// The records of a mesh of points.
Bytes recordsOf(const RecordLayout& layout, const Mesh& mesh);

} // namespace imgeo
