#include "transcode/out_of_core/out_of_core.h"

#include "base/error.h"
#include "base/parallel.h"
#include "containers/encodings.h"
#include "containers/stored_coords.h"
#include "import/mesh/add_shape.h"
#include "prepare/degenerate_elements.h"
#include "transcode/encode/levels.h"
#include "transcode/options/resolve_options.h"
#include "transcode/out_of_core/level_regions.h"
#include "transcode/out_of_core/passes.h"
#include "transcode/out_of_core/survey.h"
#include "transcode/site/site_files.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <thread>

namespace imgeo {

namespace {

// Measured with scripts/bench massive; docs/massive.md has the figures.
constexpr std::uint64_t regionBytes = 300;        ///< memory of a triangle while its region is built
constexpr std::uint64_t recordBytes = 384;        ///< of a face of a piece of the source that is scattered
constexpr std::uint64_t processBytes = 64u << 20; ///< of everything else
constexpr std::uint64_t inCoreBytes = 110;        ///< of a triangle of a mesh that is converted in memory
constexpr std::uint64_t workBytes = 24;           ///< of a triangle on disk beside its records

constexpr std::uint64_t maxPieceRecords = 1u << 18;

/// Coarse forms whose level has at most so many groups stand in for the mesh where it is looked at.
constexpr std::size_t maxCoarseGroups = 16;

/// Shares of the whole work of the passes over level 0; each further level takes a quarter of the one below.
constexpr double wholeOfLevels = 4.0 / 3, surveyShare = 0.05, scatterShare = 0.12, normalsShare = 0.13,
                 buildShare = 0.7;

class OutOfCore {
public:
  OutOfCore(const ChunkedSource& source, const ImportOptions& importOptions, const ConvertOptions& options,
            Ranks& ranks, const Progress& progress)
      : source_(source), importOptions_(importOptions), options_(options), ranks_(ranks), work_(ranks.work()),
        passes_(ranks, progress, 0, 1), levelOptions_{.groupTriangles = options.groupTriangles,
                                                      .regionTriangles = options.regionTriangles} {}

  /// Builds the levels that memory does not hold. All ranks do this together.
  void buildLargeLevels() {
    surveySource();
    describe();
    if (ranks_.isFirst())
      requireDisk();
    triangles_ = survey_.triangles;
    while (triangles_ > 0 && !buildsInMemory(triangles_))
      triangles_ = buildLevel(triangles_);
  }

  LargeMesh finish(ContentFiles& files) {
    if (triangles_ > 0)
      buildRest();
    return finishLevels(files);
  }

  std::size_t taskCount() const { return passes_.taskCount(); } ///< of all ranks

private:
  void surveySource() {
    std::vector<std::uint64_t> first(source_.chunkCount());
    for (std::size_t chunk = 1; chunk < first.size(); ++chunk)
      first[chunk] = first[chunk - 1] + source_.trianglesOf(chunk - 1);
    const auto fileOf = [](std::size_t chunk) { return taskFile("survey", 0, chunk); };
    passes_.run(
        "reading", surveyShare / wholeOfLevels, source_.chunkCount(), piecesAtOnce(), "survey-done", fileOf,
        [&](std::size_t chunk) {
          return writeSurvey(surveyPiece(source_, chunk, first[chunk], importOptions_, options_));
        },
        [] { return Bytes(); });
    for (std::size_t chunk = 0; chunk < source_.chunkCount(); ++chunk) {
      const std::string path = work_.file(fileOf(chunk));
      survey_.add(readSurvey(readFile(path), path));
    }
  }

  /// Lays the lattice and describes the node.
  void describe() {
    lattice_ = latticeFor(survey_.box, options_.coordType.value_or(ElementType::uint32),
                          positionBitsFor(survey_.box, options_));
    if (lattice_.bits > maxLevelBits)
      throw Error(
          ErrorKind::unsupported, "--position-bits",
          fmt::format("levels of detail have positions of at most {} bits, not {}", maxLevelBits, lattice_.bits));
    Mesh extremes = extremesOf(survey_);
    const std::vector<Vec3u> points = quantise(extremes.positions, lattice_);
    maximum_ = std::max({points[1].x, points[1].y, points[1].z});
    encoding_ = encodeOptionsFrom(options_);
    computesNormals_ = !survey_.layout.normals;
    if (computesNormals_)
      extremes.normals.assign(2, {0, 0, 1});
    result_.normalsComputed = computesNormals_;
    result_.colorError = survey_.colorError;
    result_.encoded.geometry = describeLeveledMesh(extremes, points, lattice_, encoding_);
    noteAttributes(result_.encoded, extremes, options_);
    result_.encoded.positionError = positionErrorBound(result_.encoded.geometry);
    std::vector<Vec3f> sample;
    for (const Vec3u& point : quantise(survey_.sample, lattice_))
      sample.emplace_back(point);
    grid_ = gridOfSample(sample);
    sample_ = std::move(sample);
    layout_ = survey_.layout;
  }

  /// Refuses to begin where the disk will be full.
  void requireDisk() const {
    if (work_.has("scatter-0-done"))
      return;
    const std::uint64_t each = layout_.recordFloats() * sizeof(float) + workBytes;
    const std::uint64_t needed = survey_.triangles * each;
    std::error_code reason;
    const auto space = std::filesystem::space(work_.path(), reason);
    if (!reason && space.available < needed)
      throw Error(ErrorKind::io, work_.path().string(),
                  fmt::format("has {} MB left, and the work files take about {}; --work names another folder",
                              space.available / 1'000'000, needed / 1'000'000));
  }

  bool buildsInMemory(std::uint64_t triangles) const { return level_ > 0 && triangles <= options_.regionTriangles; }

  std::uint64_t memory() const { return options_.memoryBytes; }
  std::size_t atOnce(std::uint64_t bytesEach) const {
    const std::uint64_t fitting = (memory() - std::min(memory(), processBytes)) / bytesEach;
    return std::clamp<std::size_t>(fitting, 1, std::max(std::thread::hardware_concurrency(), 1u));
  }
  std::size_t piecesAtOnce() const { return atOnce(recordBytes * pieceRecords(options_.regionTriangles)); }
  std::size_t regionsAtOnce() const { return atOnce(regionBytes * options_.regionTriangles); }
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
          ScatteredTriangles sums;
          for (std::size_t task = 0; task < level.scatterTasks; ++task) {
            const ScatteredTriangles each = readScatteredSums(work_.file(fileOf(task)));
            sums.lengths.add(each.lengths);
            sums.collapsed += each.collapsed;
          }
          return writeScattered(sums);
        });
    const ScatteredTriangles sums = readScatteredSums(work_.file(doneFile));
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
      first.push_back(first.back() + region.formTriangles);
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
    const std::uint64_t samples = sampledTriangleCount(triangles);
    std::vector<Vec3f> sample;
    for (std::uint64_t i = first * samples / triangles; i < samples && sampledTriangle(i, triangles) < end; ++i)
      for (std::size_t corner = 0; corner < 3 && sampledTriangle(i, triangles) >= first; ++corner)
        sample.push_back(positionOf(&records[(sampledTriangle(i, triangles) - first) * size], corner));
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
      triangles += built.formTriangles;
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
  void buildRest() {
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

  LargeMesh finishLevels(ContentFiles& files) {
    if (!finished_) // the highest level that was built out of core has the roots
      finished_ = numberedLevels(std::move(levels_));
    std::vector<GroupFile> groups;
    for (auto level = rest_.rbegin(); level != rest_.rend(); ++level)
      groups.insert(groups.end(), level->begin(), level->end());
    for (auto level = storedLevels_.rbegin(); level != storedLevels_.rend(); ++level)
      for (const RegionGroups& region : *level)
        for (const GroupRow& row : region.rows)
          groups.push_back(row.file);
    LevelIndex index = levelIndexOf(*finished_, groups, lattice_.bits);
    const std::string url = writeFiles(index, groups, files) + "/" + levelIndexName;
    describeLevels(result_.encoded, url, std::move(index), groups);
    setCoarse();
    result_.tasks = taskCount();
    return std::move(result_);
  }

  std::string writeFiles(const LevelIndex& index, std::span<const GroupFile> groups, ContentFiles& files) {
    FolderName name;
    const std::vector<Bytes> pages = writeLevelIndex(index);
    for (std::size_t page = 0; page < pages.size(); ++page)
      name.add(levelPageUrl(levelIndexName, page), ByteSpan(pages[page]));
    addGroupNames(name, groups);
    return files.writeFolder(name, [&](const std::function<void(const FolderFile&)>& write) {
      for (std::size_t page = 0; page < pages.size(); ++page)
        write({levelPageUrl(levelIndexName, page), pages[page]});
      std::uint32_t number = 0;
      for (auto level = restBytes_.rbegin(); level != restBytes_.rend(); ++level)
        for (const Bytes& bytes : *level)
          write({groupFileName(number++), bytes});
      for (std::size_t level = storedLevels_.size(); level-- > 0;)
        for (std::size_t region = 0; region < storedLevels_[level].size(); ++region) {
          const FileView view(work_.file(taskFile("groups", static_cast<std::uint32_t>(level), region)));
          const RegionGroups& groupsOfRegion = storedLevels_[level][region];
          std::size_t at = groupsOfRegion.dataOffset;
          for (const GroupRow& row : groupsOfRegion.rows) {
            write({groupFileName(number++), view.bytes().subspan(at, row.file.bytes)});
            at += row.file.bytes;
          }
          passes_.advance("writing", 0);
        }
    });
  }

  /// A scene in the place of the source's.
  void setCoarse() {
    Imported& coarse = result_.coarse;
    coarse.format = survey_.format;
    coarse.attributes = survey_.attributes;
    coarse.warnings = survey_.warnings;
    coarse.up = survey_.up;
    LevelTriangles level;
    for (const Patch& patch : coarse_)
      appendForm(level, patch, 0);
    if (coarse_.empty()) { // of unconnected pieces, which do not become fewer
      level.mesh.positions = survey_.sample;
      for (std::uint32_t corner = 0; corner < survey_.sample.size(); ++corner)
        level.mesh.corners.push_back(corner);
      level.mesh.wedgePositions = level.mesh.corners;
    } else {
      for (Vec3f& position : level.mesh.positions)
        position = Vec3f(lattice_.point(Vec3u(position)));
    }
    level.mesh.name = survey_.meshName;
    addShape(coarse.scene, std::move(level.mesh), "");
  }

  const ChunkedSource& source_;
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

  std::uint64_t triangles_ = 0;                         ///< of the next level to be built
  std::uint32_t level_ = 0;                             ///< the next to be built
  RecordLayout layout_;                                 ///< of its triangles
  std::optional<VertexGrid> grid_;                      ///< of its positions
  std::vector<Vec3f> sample_;                           ///< corners of its sampled triangles
  std::vector<RegionGroups> regionGroups_;              ///< of the level below
  std::vector<std::uint32_t> firstGroups_;              ///< by region of the level below: the number of its first group
  std::vector<std::vector<LeveledGroup>> levels_;       ///< those that have been built out of core
  std::vector<std::vector<RegionGroups>> storedLevels_; ///< without `group`, which is in levels_

  std::vector<std::vector<GroupFile>> rest_; ///< levels that have been built in memory
  std::vector<std::vector<Bytes>> restBytes_;
  std::optional<Levels> finished_;
  std::uint32_t coarseLevel_ = UINT32_MAX;
  std::vector<Patch> coarse_; ///< the groups of that level
};

} // namespace

std::uint64_t pieceRecords(std::uint32_t regionTriangles) {
  return std::min(maxPieceRecords, std::uint64_t{4} * regionTriangles);
}

std::uint64_t minimumMemory(std::uint32_t regionTriangles) {
  return processBytes + std::max(recordBytes * pieceRecords(regionTriangles), regionBytes * regionTriangles);
}

std::uint64_t inCoreMemory(const ChunkedSource& source) {
  return processBytes + inCoreBytes * source.triangleCount();
}

LargeMesh buildOutOfCore(const ChunkedSource& source, const ImportOptions& importOptions, const ConvertOptions& options,
                         Ranks& ranks, ContentFiles& files, const Progress& progress) {
  OutOfCore work(source, importOptions, options, ranks, progress);
  work.buildLargeLevels();
  return work.finish(files);
}

std::size_t shareOutOfCore(const ChunkedSource& source, const ImportOptions& importOptions,
                           const ConvertOptions& options, Ranks& ranks, const Progress& progress) {
  OutOfCore work(source, importOptions, options, ranks, progress);
  work.buildLargeLevels();
  return work.taskCount();
}

} // namespace imgeo
