// Levels of clouds out of core: those of each region up to its root, then those above the roots in memory, then the
// errors of groups above, for which each region measures the distances of its points.

#include "base/error.h"
#include "base/parallel.h"
#include "prepare/levels/nearest_point.h"
#include "transcode/out_of_core/cloud_regions.h"
#include "transcode/out_of_core/large_levels.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <utility>

namespace imgeo {

namespace {

/// Shares of the whole work, beside the survey.
struct CloudShares {
  static constexpr double scatter = 0.1, build = 0.6, top = 0.04, measure = 0.22;
};

/// Memory of a point of the roots while the levels above are built.
constexpr std::uint64_t rootPointBytes = 300;

class LargeCloudLevels : public LargeLevels {
public:
  using LargeLevels::LargeLevels;

private:
  void buildLevels() override {
    cloud_.tree = regionsOfPoints(sample_, survey_.elements, options_.regionTriangles);
    cloud_.layout = survey_.layout;
    cloud_.lattice = &lattice_;
    cloud_.scatterTasks = mesh_.chunkCount();
    scatter();
    buildRegions();
    buildTop();
    measure();
  }

  std::uint32_t regionCount() const { return cloud_.tree.regionCount(); }
  std::string regionFile(std::size_t region) const { return taskFile("region", 0, region); }

  void scatter() {
    const auto fileOf = [](std::size_t task) { return taskFile("scatter", 0, task); };
    const std::string doneFile = "scatter-0-done";
    passes_.run({.name = "dividing points into regions",
                 .share = CloudShares::scatter,
                 .count = cloud_.scatterTasks,
                 .atOnce = piecesAtOnce(),
                 .doneFile = doneFile,
                 .fileOf = fileOf,
                 .task =
                     [&](std::size_t chunk) {
                       return scatterPoints(cloud_,
                                            readPiece(mesh_, chunk, importOptions_, options_).scene.meshes.at(0));
                     },
                 .finish =
                     [&] {
                       std::vector<std::uint64_t> counts(regionCount());
                       for (std::size_t task = 0; task < cloud_.scatterTasks; ++task) {
                         const std::vector<std::uint64_t> sizes = readScatteredSizes(work_.file(fileOf(task)));
                         for (std::size_t region = 0; region < counts.size(); ++region)
                           counts[region] += sizes.at(region) / cloud_.layout.recordFloats();
                       }
                       WorkWriter out;
                       out.addAll(std::span<const std::uint64_t>(counts));
                       return std::move(out.bytes);
                     }});
    const std::string path = work_.file(doneFile);
    const Bytes bytes = readFile(path);
    cloud_.height = regionHeight(WorkReader(bytes, path).takeAll<std::uint64_t>(), options_.groupTriangles);
    requireMemoryForRoots();
  }

  /// Refuses regions of so few levels that their roots together have too many points.
  void requireMemoryForRoots() const {
    if (regionCount() == 1)
      return;
    const std::uint64_t needed = (survey_.elements >> 2 * cloud_.height) * rootPointBytes;
    if (needed > memory())
      throw Error(ErrorKind::usage, "--region-triangles",
                  fmt::format("the levels above regions of {} points take about {} MB of memory; larger regions, or "
                              "smaller groups, leave less above",
                              options_.regionTriangles, needed / 1'000'000));
  }

  void buildRegions() {
    passes_.run({.name = "building regions",
                 .share = CloudShares::build,
                 .count = regionCount(),
                 .atOnce = regionsAtOnce(),
                 .doneFile = "regions-done",
                 .fileOf = [&](std::size_t region) { return regionFile(region); },
                 .task =
                     [&](std::size_t region) {
                       BuiltCloudRegion built = buildCloudRegion(cloud_, work_, static_cast<std::uint32_t>(region),
                                                                 levelOptions_, result_.encoded.geometry, encoding_);
                       for (std::uint32_t level = 0; level < built.groups.size(); ++level)
                         work_.write(taskFile("groups", level, region), built.groups[level]);
                       work_.write(taskFile("root", 0, region), built.root);
                       return std::move(built.region);
                     }});
    for (std::size_t task = 0; ranks_.isFirst() && task < cloud_.scatterTasks; ++task)
      work_.remove(taskFile("scatter", 0, task));
    cloud_.height = readRegionHeight(work_.file(regionFile(0)));
    for (std::uint32_t level = 0; level <= cloud_.height; ++level)
      readGroups(regionCount());
  }

  /// Reads what is known of the groups of the next level, which are in so many files.
  void readGroups(std::size_t fileCount) {
    const auto level = static_cast<std::uint32_t>(levels_.size());
    std::vector<LeveledGroup> groups;
    std::vector<RegionGroups> stored;
    std::vector<std::uint32_t> first;
    for (std::size_t file = 0; file < fileCount; ++file) {
      first.push_back(static_cast<std::uint32_t>(groups.size()));
      const std::string path = work_.file(taskFile("groups", level, file));
      const FileView view(path);
      stored.push_back(readRegionGroups(view.bytes(), path));
      for (GroupRow& row : stored.back().rows) {
        for (std::uint32_t& child : row.group.children)
          child += firstGroups_.empty() ? 0 : firstGroups_[file];
        groups.push_back(std::move(row.group));
      }
    }
    firstGroups_ = std::move(first);
    levels_.push_back(std::move(groups));
    storedLevels_.push_back(std::move(stored));
  }

  /// Builds the levels above the roots, one after the other, in one task.
  void buildTop() {
    passes_.run({.name = "building levels above",
                 .share = CloudShares::top,
                 .doneFile = "top-done",
                 .fileOf = [](std::size_t) { return taskFile("top", 0, 0); },
                 .task = [&](std::size_t) { return buildAbove(); }});
    const std::string path = work_.file(taskFile("top", 0, 0));
    const Bytes bytes = readFile(path);
    const auto levelCount = WorkReader(bytes, path).take<std::uint32_t>();
    while (levels_.size() < levelCount) {
      firstGroups_.assign(1, 0); // children have their numbers within the whole level
      readGroups(1);
    }
  }

  /// Writes the groups above the roots, the points of their segments and a coarse form. Returns the number of levels.
  Bytes buildAbove() const {
    std::vector<float> records;
    std::vector<std::uint64_t> ends;
    for (std::size_t region = 0; region < regionCount(); ++region) {
      const FileView view(work_.file(taskFile("root", 0, region)));
      const std::span<const float> part = floatsOf(view.bytes());
      records.insert(records.end(), part.begin(), part.end());
      ends.push_back(records.size() / cloud_.layout.recordFloats());
    }
    const Mesh mesh = cloud_.layout.meshOf(records);
    records = {};
    std::vector<Vec3u> points;
    points.reserve(mesh.positions.size());
    for (const Vec3f& position : mesh.positions)
      points.emplace_back(position);

    std::vector<Mesh> coarse;
    std::optional<std::uint32_t> coarseLevel;
    GroupEncoder encoder(result_.encoded.geometry, encoding_, cloud_.height + 1);
    PointGroupSink sink = encoder.sink([&](std::uint32_t level, std::size_t group, const std::vector<Patch>& segments) {
      WorkWriter out;
      for (const Patch& segment : segments)
        out.addAll(std::span<const Vec3u>(segment.positions));
      work_.write(taskFile("segments", level, group), out.bytes);
      for (std::size_t i = 0; coarseLevel == level && i < segments.size(); ++i)
        appendPoints(coarse[group], segments[i]);
    });
    sink.begin = [&, encodeLevel = std::move(sink.begin)](std::uint32_t level, std::size_t groupCount) {
      encodeLevel(level, groupCount);
      if (coarse.empty() && ends.size() > maxCoarseGroups && groupCount <= maxCoarseGroups)
        coarseLevel = level, coarse.resize(groupCount);
    };
    PointLevels levels = buildPointLevelsAbove(mesh, points, ends, cloud_.height, levelOptions_, sink);
    const auto levelCount = static_cast<std::uint32_t>(cloud_.height + 1 + levels.size());
    std::uint32_t level = cloud_.height;
    for (const Bytes& groups : encoder.takeFiles(std::move(levels)))
      work_.write(taskFile("groups", ++level, 0), groups);
    Bytes form;
    for (const Mesh& each : coarse) {
      const Bytes part = recordsOf(cloud_.layout, each);
      form.insert(form.end(), part.begin(), part.end());
    }
    work_.write(taskFile("coarse", 0, 0), coarse.empty() ? recordsOf(cloud_.layout, mesh) : form);
    WorkWriter out;
    out.add(levelCount);
    return std::move(out.bytes);
  }

  /// A group between a region's root and the top: its level and number, its parent, and which of its children it is.
  struct Step {
    std::uint32_t level, group, parent;
    std::size_t segment;
  };

  std::vector<Step> wayUp(std::uint32_t region) const {
    std::vector<Step> steps;
    std::uint32_t group = region;
    for (std::uint32_t level = cloud_.height; level + 1 < levels_.size(); ++level) {
      const std::vector<LeveledGroup>& above = levels_[level + 1];
      const auto parent = std::ranges::find_if(
          above, [&](const LeveledGroup& each) { return !each.children.empty() && each.children.back() >= group; });
      const auto number = static_cast<std::uint32_t>(parent - above.begin());
      steps.push_back({level, group, number, group - parent->children.front()});
      group = number;
    }
    return steps;
  }

  /// Finds the errors of the roots and of the groups above.
  void measure() {
    const auto fileOf = [](std::size_t region) { return taskFile("distances", 0, region); };
    passes_.run({.name = "measuring distances",
                 .share = CloudShares::measure,
                 .count = regionCount(),
                 .atOnce = regionsAtOnce(),
                 .doneFile = "distances-done",
                 .fileOf = fileOf,
                 .task = [&](std::size_t region) { return distancesOf(static_cast<std::uint32_t>(region)); }});
    for (std::uint32_t region = 0; region < regionCount(); ++region) {
      const std::string path = work_.file(fileOf(region));
      const Bytes bytes = readFile(path);
      WorkReader in(bytes, path);
      for (const Step& step : wayUp(region)) {
        double& error = levels_[step.level][step.group].error;
        error = std::max(error, in.take<double>());
      }
    }
  }

  /// The largest distance of a point of the region from the coarse form of its root and of each group above, but one.
  Bytes distancesOf(std::uint32_t region) const {
    const std::string path = work_.file(regionFile(region));
    const FileView view(path);
    const CloudRegion points(view.bytes(), path);
    WorkWriter out;
    for (const Step& step : wayUp(region)) {
      const NearestPoint nearest(segmentOf(step));
      double distance = 0;
      for (const Vec3u& point : points.points)
        distance = nearest.farther(distance, point);
      out.add(distance);
    }
    return std::move(out.bytes);
  }

  /// The coarse form of a group.
  std::vector<Vec3u> segmentOf(const Step& step) const {
    const std::string path = work_.file(taskFile("segments", step.level + 1, step.parent));
    const FileView view(path);
    WorkReader in(view.bytes(), path);
    for (std::size_t i = 0; i < step.segment; ++i)
      in.takeAll<Vec3u>();
    return in.takeAll<Vec3u>();
  }

  Levels takeLevels() override { return numberedLevels(std::move(levels_)); }

  Mesh coarseForm() override {
    const FileView view(work_.file(taskFile("coarse", 0, 0)));
    Mesh mesh = cloud_.layout.meshOf(floatsOf(view.bytes()));
    moveToSource(mesh);
    return mesh;
  }

  RegionedCloud cloud_;
  PointLevels levels_;                     ///< those that have been built
  std::vector<std::uint32_t> firstGroups_; ///< by file of the last of these: the number of its first group
};

} // namespace

std::unique_ptr<LargeLevels> largeCloudLevels(const LargeTask& task) {
  return std::make_unique<LargeCloudLevels>(task);
}

} // namespace imgeo
