// Levels of meshes out of core: each level region by region, until one has no more triangles than a region.

#include "base/error.h"
#include "base/parallel.h"
#include "prepare/degenerate_elements.h"
#include "transcode/out_of_core/large_levels.h"
#include "transcode/out_of_core/level_regions.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace imgeo {

namespace {

/// Shares of the whole work of the passes over level 0; each further level takes a quarter of the one below.
constexpr double wholeOfLevels = 4.0 / 3, scatterShare = 0.12, normalsShare = 0.13, buildShare = 0.7;

class LargeMeshLevels : public LargeLevels {
public:
  using LargeLevels::LargeLevels;

private:
  void buildLevels() override {
    grid_ = gridOfSample(sample_);
    layout_ = survey_.layout;
    triangles_ = survey_.elements;
    while (triangles_ > 0 && !buildsInMemory(triangles_))
      triangles_ = buildLevel(triangles_);
  }

  bool buildsInMemory(std::uint64_t triangles) const { return level_ > 0 && triangles <= options_.regionTriangles; }

  double shareOfLevel(double share) const { return share / wholeOfLevels / std::pow(4.0, level_); }

  /// Builds the groups of a level of so many triangles, region by region. Returns the number of triangles of the level
  /// above; 0 if there is none.
  std::uint64_t buildLevel(std::uint64_t triangles) {
    RegionedLevel level;
    level.level = level_;
    level.triangles = triangles;
    level.frame = frameOfLevel(level_);
    if (level_ > 0)
      sampleForms(triangles);
    level.tree = regionsOfSample(sample_, triangles, options_.regionTriangles, level.frame);
    level.layout = layout_;
    level.lattice = level_ == 0 ? &lattice_ : nullptr;
    level.computesNormals = level_ == 0 && computesNormals_;
    level.weighting = options_.normalWeighting;
    level.scatterTasks = level_ == 0 ? source_.chunkCount() : regionGroups_.size();
    const EdgeLengths lengths = scatter(level);
    if (level.computesNormals)
      passes_.run(
          "computing normals", shareOfLevel(normalsShare), level.tree.regionCount(), regionsAtOnce(), "normals-done",
          [&](std::size_t region) { return taskFile("normals", level_, region); },
          [&](std::size_t region) { return borderNormalsOf(level, work_, static_cast<std::uint32_t>(region)); },
          [] { return Bytes(); });
    const LevelPlan plan{level_, false, lengths.roundingShiftAbove(), maximum_, grid_};
    build(level, plan);
    for (std::size_t task = 0; ranks_.isFirst() && task < level.scatterTasks; ++task)
      work_.remove(taskFile("scatter", level_, task));
    layout_.normals |= level.computesNormals;
    grid_ = gridOfRounding(plan.roundingShift);
    const std::uint64_t above = readGroups(level.tree.regionCount());
    ++level_;
    return isWorthwhile(above, triangles) ? above : 0;
  }

  /// Writes the triangles of the level by region. Returns the lengths of the level's edges.
  EdgeLengths scatter(const RegionedLevel& level) {
    const auto fileOf = [&](std::size_t task) { return taskFile("scatter", level_, task); };
    const std::string doneFile = fmt::format("scatter-{}-done", level_);
    passes_.run(
        fmt::format("dividing level {} into regions", level_), shareOfLevel(scatterShare), level.scatterTasks,
        piecesAtOnce(), doneFile, fileOf,
        [&](std::size_t task) { return level_ == 0 ? scatterPiece(level, task) : scatterForms(level, task); },
        [&] {
          ScatteredElements sums;
          for (std::size_t task = 0; task < level.scatterTasks; ++task) {
            const ScatteredElements each = readScatteredSums(work_.file(fileOf(task)));
            sums.lengths.add(each.lengths);
            sums.collapsed += each.collapsed;
          }
          return writeScattered(sums);
        });
    const ScatteredElements sums = readScatteredSums(work_.file(doneFile));
    if (level_ == 0)
      result_.encoded.collapsed.triangles = sums.collapsed;
    return sums.lengths;
  }

  Bytes scatterPiece(const RegionedLevel& level, std::size_t chunk) const {
    Imported imported = readPiece(source_, chunk, importOptions_, options_);
    const Mesh& mesh = imported.scene.meshes.at(0);
    const std::vector<Vec3u> quantised = quantise(mesh.positions, lattice_);
    std::vector<Vec3f> points;
    points.reserve(quantised.size());
    for (const Vec3u& point : quantised)
      points.emplace_back(point);
    Scatter scatter(level);
    scatter.addCollapsed(countCollapsedElements(mesh, quantised, lattice_.bits));
    for (std::size_t triangle = 0; triangle < mesh.elementCount(); ++triangle)
      scatter.add(mesh, points, triangle, 0);
    return writeScattered(scatter.take());
  }

  /// Divides the coarse forms of a region of the level below.
  Bytes scatterForms(const RegionedLevel& level, std::size_t region) const {
    const std::string path = work_.file(taskFile("forms", level_ - 1, region));
    const FileView view(path);
    const std::span<const float> records = floatsOf(view.bytes());
    const Mesh mesh = layout_.meshOf(records);
    Scatter scatter(level);
    for (std::size_t triangle = 0; triangle < mesh.elementCount(); ++triangle)
      scatter.add(mesh, mesh.positions, triangle,
                  firstGroups_[region] + tagOf(&records[triangle * layout_.recordFloats()]));
    return writeScattered(scatter.take());
  }

  /// Finds the corners of the sampled triangles of the level.
  void sampleForms(std::uint64_t triangles) {
    std::vector<std::uint64_t> first{0};
    for (const RegionGroups& region : regionGroups_)
      first.push_back(first.back() + region.formElements);
    const auto fileOf = [&](std::size_t region) { return taskFile("sample", level_, region); };
    passes_.run(
        fmt::format("choosing the regions of level {}", level_), 0, regionGroups_.size(), regionsAtOnce(),
        fmt::format("sample-{}-done", level_), fileOf,
        [&](std::size_t region) { return sampleRegion(region, first[region], triangles); }, [] { return Bytes(); });
    sample_.clear();
    for (std::size_t region = 0; region < regionGroups_.size(); ++region) {
      const std::string path = work_.file(fileOf(region));
      const Bytes bytes = readFile(path);
      const std::vector<Vec3f> part = WorkReader(bytes, path).takeAll<Vec3f>();
      sample_.insert(sample_.end(), part.begin(), part.end());
    }
  }

  /// The same for a region of the level below. `first`: the number of its first triangle.
  Bytes sampleRegion(std::size_t region, std::uint64_t first, std::uint64_t triangles) const {
    const FileView view(work_.file(taskFile("forms", level_ - 1, region)));
    const std::span<const float> records = floatsOf(view.bytes());
    const std::uint64_t size = layout_.recordFloats(), end = first + records.size() / size;
    const std::uint64_t samples = sampledElementCount(triangles);
    std::vector<Vec3f> sample;
    for (std::uint64_t i = first * samples / triangles; i < samples && sampledElement(i, triangles) < end; ++i)
      for (std::size_t corner = 0; corner < 3 && sampledElement(i, triangles) >= first; ++corner)
        sample.push_back(positionOf(&records[(sampledElement(i, triangles) - first) * size], corner));
    WorkWriter out;
    out.addAll(std::span<const Vec3f>(sample));
    return std::move(out.bytes);
  }

  void build(const RegionedLevel& level, const LevelPlan& plan) {
    passes_.run(
        fmt::format("building level {}", level_), shareOfLevel(buildShare), level.tree.regionCount(), regionsAtOnce(),
        fmt::format("groups-{}-done", level_), [&](std::size_t region) { return taskFile("groups", level_, region); },
        [&](std::size_t region) {
          BuiltRegion built = buildRegion(level, work_, static_cast<std::uint32_t>(region), plan, levelOptions_,
                                          result_.encoded.geometry, encoding_);
          work_.write(taskFile("forms", level_, region), built.forms);
          return std::move(built.groups);
        },
        [] { return Bytes(); });
  }

  /// Reads what is known of the groups of the level that has been built. Returns the triangles of their coarse forms.
  std::uint64_t readGroups(std::uint32_t regionCount) {
    std::uint64_t triangles = 0;
    std::vector<LeveledGroup> groups;
    regionGroups_.clear();
    firstGroups_.clear();
    for (std::uint32_t region = 0; region < regionCount; ++region) {
      const std::string path = work_.file(taskFile("groups", level_, region));
      const FileView view(path);
      RegionGroups built = readRegionGroups(view.bytes(), path);
      triangles += built.formElements;
      firstGroups_.push_back(static_cast<std::uint32_t>(groups.size()));
      for (GroupRow& row : built.rows)
        groups.push_back(std::move(row.group));
      regionGroups_.push_back(std::move(built));
    }
    addErrorsBelow(groups, levels_);
    levels_.push_back(std::move(groups));
    storedLevels_.push_back(regionGroups_);
    return triangles;
  }

  /// Builds all further levels in memory.
  void buildRest() override {
    if (triangles_ == 0)
      return;
    Mesh mesh;
    std::vector<std::uint32_t> segments;
    for (std::size_t region = 0; region < regionGroups_.size(); ++region) {
      const FileView view(work_.file(taskFile("forms", level_ - 1, region)));
      const std::span<const float> records = floatsOf(view.bytes());
      Mesh part = layout_.meshOf(records);
      for (std::size_t at = 0; at < records.size(); at += layout_.recordFloats())
        segments.push_back(firstGroups_[region] + tagOf(&records[at]));
      const auto before = static_cast<std::uint32_t>(mesh.positions.size());
      if (before == 0) {
        mesh = std::move(part);
        continue;
      }
      append(mesh, before, part, part.wedgeCount());
      mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
      for (std::uint32_t i = 0; i < part.positions.size(); ++i)
        mesh.wedgePositions.push_back(before + i), mesh.corners.push_back(before + i);
    }
    const double share = shareOfLevel(1) * 3 / 4;
    const GroupSink sink{
        [&](std::uint32_t level, std::size_t count) {
          rest_.emplace_back(count);
          restBytes_.emplace_back(count);
          if (coarse_.empty() && count <= maxCoarseGroups)
            coarseLevel_ = level, coarse_.resize(count);
          passes_.advance(fmt::format("building level {}", level), rest_.size() == 1 ? share : share / 4);
        },
        [&](std::uint32_t level, std::size_t group, GroupMesh groupMesh) {
          if (level == coarseLevel_)
            coarse_[group] = groupMesh.patch;
          EncodedGroup encoded = encodeGroup(std::move(groupMesh), result_.encoded.geometry, encoding_);
          rest_[level - level_][group] = groupFileOf(encoded);
          restBytes_[level - level_][group] = std::move(encoded.bytes);
        }};
    finished_ = buildLevelsAbove(std::move(mesh), std::move(segments), {std::move(levels_), maximum_, grid_},
                                 levelOptions_, sink);
  }

  Levels takeLevels() override {
    if (!finished_) // the highest level that was built out of core has the roots
      finished_ = numberedLevels(std::move(levels_));
    return *std::move(finished_);
  }

  Mesh coarseForm() override {
    LevelTriangles level;
    for (const Patch& patch : coarse_)
      appendForm(level, patch, 0);
    if (coarse_.empty()) { // of unconnected pieces, which do not become fewer
      level.mesh.positions = sample_;
      for (std::uint32_t corner = 0; corner < sample_.size(); ++corner)
        level.mesh.corners.push_back(corner);
      level.mesh.wedgePositions = level.mesh.corners;
    }
    moveToSource(level.mesh);
    return std::move(level.mesh);
  }

  std::uint64_t triangles_ = 0;                   ///< of the next level to be built
  std::uint32_t level_ = 0;                       ///< the next to be built
  RecordLayout layout_;                           ///< of its triangles
  std::optional<VertexGrid> grid_;                ///< of its positions
  std::vector<RegionGroups> regionGroups_;        ///< of the level below
  std::vector<std::uint32_t> firstGroups_;        ///< by region of the level below: the number of its first group
  std::vector<std::vector<LeveledGroup>> levels_; ///< those that have been built out of core
  std::optional<Levels> finished_;
  std::uint32_t coarseLevel_ = UINT32_MAX;
  std::vector<Patch> coarse_; ///< the groups of that level
};

} // namespace

std::unique_ptr<LargeLevels> largeMeshLevels(const LargeTask& task) {
  return std::make_unique<LargeMeshLevels>(task);
}

} // namespace imgeo
