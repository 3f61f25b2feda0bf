#pragma once
// A level that is divided into regions: scattering its triangles, and building the groups of a region.

#include "containers/levels/group_file.h"
#include "prepare/lattice.h"
#include "transcode/out_of_core/region_files.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace imgeo {

/// What all regions of a level have in common.
struct RegionedLevel {
  std::uint32_t level = 0;
  std::uint64_t triangles = 0;
  RegionTree tree{};
  GroupFrame frame = GroupFrame::straight;
  RecordLayout layout{};                ///< of scattered triangles
  const Lattice* lattice = nullptr;     ///< level 0: that of positions in records, which are the source's
  bool computesNormals = false;         ///< level 0: whether the layout lacks them
  NormalWeighting weighting{};          ///< of computed normals
  double creaseDegrees = smoothDegrees; ///< of computed normals
  std::size_t scatterTasks = 0;
  std::uint32_t firstFile = 0;              ///< added to the level in names of work files
  std::optional<std::size_t> chartSet{};    ///< level 0: the set of texture coordinates that has labels of charts
  std::vector<std::uint32_t> firstLabels{}; ///< by scatter task
  std::vector<std::uint32_t> charts{};      ///< by label

  std::string file(const char* pass, std::size_t task) const { return taskFile(pass, firstFile + level, task); }
};

/// Divides triangles, or points, among the regions.
class Scatter {
public:
  explicit Scatter(const RegionedLevel& level)
      : level_(level),
        axes_(axesOf(level.frame)), result_{std::vector<std::vector<float>>(level.tree.regionCount()), {}, 0, {}} {}

  /// `points`: lattice points by position of the mesh. `child`: of a triangle, the group of the level below that it
  /// stands for; 0 on level 0.
  void add(const Mesh& mesh, const std::vector<Vec3f>& points, std::size_t element, std::uint32_t child);
  ScatteredElements take() { return std::move(result_); }
  void addCollapsed(std::size_t count) { result_.collapsed += count; }
  void addLabels(std::uint32_t count) { result_.labels.push_back(count); }

private:
  void addPoint(const Mesh& mesh, const std::vector<Vec3f>& points, std::size_t element);

  const RegionedLevel& level_;
  std::array<FrameKey, 3> axes_;
  ScatteredElements result_;
};

/// The normals of corners at positions of a region, of triangles of other regions.
Bytes borderNormalsOf(const RegionedLevel& level, const WorkFolder& work, std::uint32_t region);

/// What building a region gives.
struct BuiltRegion {
  Bytes groups; ///< writeRegionGroups()
  Bytes forms;  ///< records of coarse forms, tagged by the number of their group within the region
};

/// Builds the groups of a region. `groupTriangles` and `ratio` are those of LevelOptions. `images`: nullptr where
/// groups have none.
BuiltRegion buildRegion(const RegionedLevel& level, const WorkFolder& work, std::uint32_t region, const LevelPlan& plan,
                        const LevelOptions& options, const GeometryDescription& geometry, const EncodeOptions& encoding,
                        LevelImages* images);

} // namespace imgeo
