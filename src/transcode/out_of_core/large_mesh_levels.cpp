// Levels of meshes out of core: each level region by region, until one has no more triangles than a region.

#include "base/error.h"
#include "base/narrow.h"
#include "base/parallel.h"
#include "prepare/degenerate_elements.h"
#include "transcode/out_of_core/large_levels.h"
#include "transcode/out_of_core/level_regions.h"
#include "transcode/out_of_core/region_atlas.h"
#include "transcode/out_of_core/region_charts.h"

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
    if (images_) {
      layout_.texCoordSets = static_cast<std::uint32_t>(images_->set() + 1);
      layout_.texCoordMappings = extremes_.texCoordMappings;
    }
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
    level.creaseDegrees = creaseDegrees_;
    level.firstFile = fileNumber(0);
    if (images_ && level_ == 0)
      level.chartSet = images_->set();
    level.scatterTasks = level_ == 0 ? mesh_.chunkCount() : regionGroups_.size();
    const ScatteredElements sums = scatter(level);
    if (level.chartSet) {
      findCharts(level, sums.labels);
      if ((images_->areTooFragmented() || resamples_) && !resample(level)) { // all levels are built without
        removeScattered(level);
        return 0;
      }
    }
    if (level.computesNormals)
      passes_.run(
          {.name = "computing normals",
           .share = shareOfLevel(normalsShare),
           .count = level.tree.regionCount(),
           .atOnce = regionsAtOnce(),
           .doneFile = fmt::format("normals-{}-done", fileNumber(level_)),
           .fileOf = [&](std::size_t region) { return level.file("normals", region); },
           .task =
               [&](std::size_t region) { return borderNormalsOf(level, work_, static_cast<std::uint32_t>(region)); }});
    const LevelPlan plan{level_, false, sums.lengths.roundingShiftAbove(), maximum_, grid_};
    build(level, plan);
    removeScattered(level);
    layout_.normals |= level.computesNormals;
    grid_ = gridOfRounding(plan.roundingShift);
    const std::uint64_t above = readGroups(level.tree.regionCount());
    ++level_;
    return isWorthwhile(above, triangles) ? above : 0;
  }

  void removeScattered(const RegionedLevel& level) const {
    for (std::size_t task = 0; ranks_.isFirst() && task < level.scatterTasks; ++task)
      work_.remove(level.file("scatter", task));
  }

  /// Writes the triangles of the level by region. Returns the sums over all.
  ScatteredElements scatter(const RegionedLevel& level) {
    const auto fileOf = [&](std::size_t task) { return level.file("scatter", task); };
    const std::string doneFile = fmt::format("scatter-{}-done", fileNumber(level_));
    passes_.run(
        {.name = fmt::format("dividing level {} into regions", level_),
         .share = shareOfLevel(scatterShare),
         .count = level.scatterTasks,
         .atOnce = piecesAtOnce(),
         .doneFile = doneFile,
         .fileOf = fileOf,
         .task = [&](std::size_t task) { return level_ == 0 ? scatterPiece(level, task) : scatterForms(level, task); },
         .finish =
             [&] {
               ScatteredElements sums;
               for (std::size_t task = 0; task < level.scatterTasks; ++task) {
                 const ScatteredElements each = readScatteredSums(work_.file(fileOf(task)));
                 sums.lengths.add(each.lengths);
                 sums.collapsed += each.collapsed;
                 sums.labels.insert(sums.labels.end(), each.labels.begin(), each.labels.end());
               }
               return writeScattered(sums);
             }});
    ScatteredElements sums = readScatteredSums(work_.file(doneFile));
    if (level_ == 0)
      result_.encoded.collapsed.triangles = sums.collapsed;
    return sums;
  }

  /// Numbers the charts of the texture and draws their masks. `labels`: of each piece, how many.
  void findCharts(RegionedLevel& level, const std::vector<std::uint32_t>& labels) {
    std::uint64_t count = 0;
    for (const std::uint32_t each : labels) {
      level.firstLabels.push_back(narrow<std::uint32_t>(count));
      count += each;
    }
    const auto fileOf = [](std::size_t region) { return taskFile("charts", 0, region); };
    passes_.run(
        {.name = "finding the charts of the texture",
         .count = level.tree.regionCount(),
         .atOnce = regionsAtOnce(),
         .doneFile = "charts-done",
         .fileOf = fileOf,
         .task = [&](std::size_t region) { return chartPairsOf(level, work_, static_cast<std::uint32_t>(region)); },
         .finish =
             [&] {
               std::vector<std::string> files;
               for (std::uint32_t region = 0; region < level.tree.regionCount(); ++region)
                 files.push_back(work_.file(fileOf(region)));
               WorkWriter out;
               out.addAll(std::span<const std::uint32_t>(joinCharts(narrow<std::uint32_t>(count), files)));
               return std::move(out.bytes);
             }});
    const std::string path = work_.file("charts-done");
    const Bytes bytes = readFile(path);
    level.charts = WorkReader(bytes, path).takeAll<std::uint32_t>();
    const auto masks = [](std::size_t) { return taskFile("masks", 0, 0); };
    passes_.run({.name = "drawing the charts of the texture",
                 .doneFile = "masks-done",
                 .fileOf = masks,
                 .task = [&](std::size_t) { return drawCharts(level, work_, images_->size()); }});
    images_->setCharts(readCharts(work_.file(masks(0))));
  }

  /// Gives the mesh new charts. False where that is of no use.
  bool resample(const RegionedLevel& level) {
    if (imageObstacle_.empty())
      imageObstacle_ = images_->failure();
    const auto fileOf = [&](std::size_t) { return taskFile("atlas", fileNumber(0), 0); };
    passes_.run({.name = "resampling the texture",
                 .doneFile = fmt::format("atlas-{}-done", fileNumber(0)),
                 .fileOf = fileOf,
                 .task = [&](std::size_t) {
                   return withinMemory(
                       [&](std::uint64_t maxBytes) { return resampleTexture(level, work_, *images_, maxBytes); });
                 }});
    if (std::optional<ResampledTexture> texture = readResampled(work_.file(fileOf(0))))
      setResampled(*std::move(texture));
    return images_->newCharts() && !images_->areTooFragmented();
  }

  Bytes scatterPiece(const RegionedLevel& level, std::size_t chunk) const {
    Imported imported = readPiece(mesh_, chunk, importOptions_, options_);
    Mesh& mesh = imported.scene.meshes.at(0);
    const std::vector<Vec3u> quantised = quantise(mesh.positions, lattice_);
    std::vector<Vec3f> points;
    points.reserve(quantised.size());
    for (const Vec3u& point : quantised)
      points.emplace_back(point);
    Scatter scatter(level);
    if (level.chartSet)
      scatter.addLabels(labelCharts(mesh, *level.chartSet));
    scatter.addCollapsed(countCollapsedElements(mesh, quantised, lattice_.bits));
    for (std::size_t triangle = 0; triangle < mesh.elementCount(); ++triangle)
      scatter.add(mesh, points, triangle, 0);
    return writeScattered(scatter.take());
  }

  /// Divides the coarse forms of a region of the level below.
  Bytes scatterForms(const RegionedLevel& level, std::size_t region) const {
    const std::string path = work_.file(taskFile("forms", fileNumber(level_ - 1), region));
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
    const auto fileOf = [&](std::size_t region) { return taskFile("sample", fileNumber(level_), region); };
    passes_.run({.name = fmt::format("choosing the regions of level {}", level_),
                 .count = regionGroups_.size(),
                 .atOnce = regionsAtOnce(),
                 .doneFile = fmt::format("sample-{}-done", fileNumber(level_)),
                 .fileOf = fileOf,
                 .task = [&](std::size_t region) { return sampleRegion(region, first[region], triangles); }});
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
    const FileView view(work_.file(taskFile("forms", fileNumber(level_ - 1), region)));
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

  void forgetLevels() override {
    triangles_ = 0, level_ = 0;
    regionGroups_.clear(), firstGroups_.clear(), levels_.clear(), coarse_.clear();
    finished_.reset();
    coarseLevel_ = UINT32_MAX;
    texels_ = 0, hasLargeImage_ = false;
  }

  void build(const RegionedLevel& level, const LevelPlan& plan) {
    passes_.run({.name = fmt::format("building level {}", level_),
                 .share = shareOfLevel(buildShare),
                 .count = level.tree.regionCount(),
                 .atOnce = regionsAtOnce(),
                 .doneFile = fmt::format("groups-{}-done", fileNumber(level_)),
                 .fileOf = [&](std::size_t region) { return level.file("groups", region); },
                 .task =
                     [&](std::size_t region) {
                       BuiltRegion built =
                           buildRegion(level, work_, static_cast<std::uint32_t>(region), plan, levelOptions_,
                                       result_.encoded.geometry, encoding_, images_.get());
                       work_.write(level.file("forms", region), built.forms);
                       return std::move(built.groups);
                     }});
  }

  /// Reads what is known of the groups of the level that has been built. Returns the triangles of their coarse forms.
  std::uint64_t readGroups(std::uint32_t regionCount) {
    std::uint64_t triangles = 0;
    std::vector<LeveledGroup> groups;
    regionGroups_.clear();
    firstGroups_.clear();
    for (std::uint32_t region = 0; region < regionCount; ++region) {
      const std::string path = work_.file(taskFile("groups", fileNumber(level_), region));
      const FileView view(path);
      RegionGroups built = readRegionGroups(view.bytes(), path);
      triangles += built.formElements;
      firstGroups_.push_back(static_cast<std::uint32_t>(groups.size()));
      for (GroupRow& row : built.rows) {
        groups.push_back(std::move(row.group));
        texels_ += std::uint64_t{row.chip.size.width} * row.chip.size.height;
        hasLargeImage_ |= row.chip.size.width == 0;
      }
      regionGroups_.push_back(std::move(built));
    }
    if (images_)
      images_->setCounts(texels_, hasLargeImage_);
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
      const FileView view(work_.file(taskFile("forms", fileNumber(level_ - 1), region)));
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
          restChips_.emplace_back(images_ ? count : 0);
          if (coarse_.empty() && count <= maxCoarseGroups)
            coarseLevel_ = level, coarse_.resize(count);
          passes_.advance(fmt::format("building level {}", level), rest_.size() == 1 ? share : share / 4);
        },
        [&](std::uint32_t level, std::size_t group, GroupMesh groupMesh) {
          if (level == coarseLevel_)
            coarse_[group] = groupMesh.patch;
          if (images_) {
            restChips_[level - level_][group] = images_->makeFile(groupMesh.patch, level);
            if (restChips_[level - level_][group].bytes.empty())
              return; // only counted
          }
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
    if (images_ && !coarse_.empty()) {
      texCoordsOf(level.mesh, images_->set()).clear();
      level.mesh.texCoordMappings = survey_.layout.texCoordMappings;
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
  std::uint64_t texels_ = 0; ///< of the images of these
  bool hasLargeImage_ = false;
  std::uint32_t coarseLevel_ = UINT32_MAX;
  std::vector<Patch> coarse_; ///< the groups of that level
};

} // namespace

std::unique_ptr<LargeLevels> largeMeshLevels(const LargeTask& task) {
  return std::make_unique<LargeMeshLevels>(task);
}

} // namespace imgeo
