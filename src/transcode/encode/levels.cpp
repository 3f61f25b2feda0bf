#include "transcode/encode/levels.h"

#include "base/error.h"
#include "base/file.h"
#include "base/narrow.h"
#include "containers/encodings.h"
#include "containers/levels/group_file.h"
#include "containers/levels/level_patches.h"
#include "containers/normals.h"
#include "containers/stored_coords.h"
#include "prepare/degenerate_elements.h"
#include "prepare/levels/point_levels.h"
#include "scene/skin.h"
#include "transcode/encode/level_images.h"
#include "transcode/site/site_files.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

namespace imgeo {

namespace {

/// The encoded groups of all levels.
class EncodedLevels {
public:
  EncodedLevels(const GeometryDescription& geometry, const EncodeOptions& options, const ElementsDone& done,
                LevelImages* images)
      : geometry_(geometry), options_(options), done_(done), images_(images) {}

  PointGroupSink pointSink() {
    return {[this](std::uint32_t, std::size_t groupCount) { byLevel_.emplace_back(groupCount); },
            [this](std::uint32_t level, std::size_t group, std::vector<Patch> segments) {
              byLevel_[level][group] = encodePointGroup(std::move(segments), geometry_, options_);
              if (level == 0)
                done_(byLevel_[level][group].vertices);
            }};
  }

  GroupSink sink() {
    return {[this](std::uint32_t, std::size_t groupCount) {
              byLevel_.emplace_back(groupCount);
              if (images_)
                images_->addLevel(groupCount);
            },
            [this](std::uint32_t level, std::size_t group, GroupMesh mesh) {
              const std::size_t elementCount = mesh.patch.elementCount();
              if (!images_ || images_->make(mesh.patch, level, group))
                byLevel_[level][group] = encodeGroup(std::move(mesh), geometry_, options_);
              if (level == 0)
                done_(elementCount);
            }};
  }

  /// The groups in the order of the index: from the highest level down.
  std::vector<EncodedGroup> take() {
    std::vector<EncodedGroup> all;
    for (auto level = byLevel_.rbegin(); level != byLevel_.rend(); ++level)
      std::ranges::move(*level, std::back_inserter(all));
    return all;
  }

private:
  const GeometryDescription& geometry_;
  const EncodeOptions& options_;
  const ElementsDone& done_;
  LevelImages* images_; ///< null: none
  std::vector<std::vector<EncodedGroup>> byLevel_;
};

/// Writes all files into a folder that has the name of their contents. Returns the url of the index.
std::string writeFiles(const LevelIndex& index, const std::vector<EncodedGroup>& groups,
                       const std::vector<ChipFile>& chips, ContentFiles& files) {
  std::vector<FolderFile> all;
  const std::vector<Bytes> pages = writeLevelIndex(index);
  for (std::size_t page = 0; page < pages.size(); ++page)
    all.push_back({levelPageUrl(levelIndexName, page), pages[page]});
  for (std::uint32_t number = 0; number < groups.size(); ++number)
    all.push_back({groupFileName(number), groups[number].bytes});
  for (std::uint32_t number = 0; number < chips.size(); ++number)
    all.push_back({chipFileName(number), chips[number].bytes});
  return files.writeFolder(all) + "/" + levelIndexName;
}

} // namespace

bool getsLevels(const Mesh& mesh, const Lattice& lattice, const ConvertOptions& options) {
  if (options.levels == LevelChoice::never || !rowOf(*options.encoding).capabilities.levels)
    return false;
  const bool isCloud = mesh.topology == Topology::points;
  if ((mesh.topology != Topology::triangles && !isCloud) || mesh.corners.empty() ||
      (!isCloud && options.primitives != Primitives::triangles) || isDeformed(mesh) || lattice.bits > maxLevelBits)
    return false;
  const std::size_t maxElements =
      options.levels == LevelChoice::always ? options.groupTriangles : maxElementsWithoutLevels;
  return (isCloud ? mesh.wedgeCount() : mesh.elementCount()) > maxElements;
}

GeometryDescription describeLeveledMesh(Mesh& mesh, const std::vector<Vec3u>& points, const Lattice& lattice,
                                        const EncodeOptions& options) {
  PatchedMesh whole;
  whole.lattice = lattice;
  Patch& patch = whole.patches.emplace_back();
  patch.topology = mesh.topology;
  static_cast<VertexAttributes&>(patch) = std::move(static_cast<VertexAttributes&>(mesh));
  patch.positions = points;
  whole.box = boxOf(patch, lattice);
  GeometryDescription geometry = describe(whole, options);
  static_cast<VertexAttributes&>(mesh) = std::move(static_cast<VertexAttributes&>(patch));
  return geometry;
}

LevelIndex levelIndexOf(const Levels& levels, std::span<const GroupFile> files, std::uint32_t bits) {
  LevelIndex index;
  index.positionBits = bits;
  index.hasPoints = std::ranges::all_of(files, [](const GroupFile& file) { return file.triangles == 0; });
  index.rootCount = levels.rootCount;
  std::vector<GroupBounds> bounds;
  for (std::size_t number = 0; number < files.size(); ++number) {
    const LeveledGroup& group = levels.groups[number];
    LevelGroup row;
    row.level = static_cast<std::uint8_t>(group.level);
    row.vertices = narrow<std::uint32_t>(files[number].vertices);
    row.triangles = narrow<std::uint32_t>(files[number].triangles);
    row.bytes = files[number].bytes;
    row.children = group.children;
    index.groups.push_back(std::move(row));
    bounds.push_back({group.center, group.radius, group.error});
  }
  setBounds(index, bounds);
  return index;
}

GroupFile groupFileOf(const EncodedGroup& group) {
  return {group.vertices, group.triangles, narrow<std::uint32_t>(group.bytes.size()), group.normalError,
          contentName(group.bytes)};
}

ChipRow chipRowOf(const ChipFile& image) {
  return {image.size, image.texelEdge, narrow<std::uint32_t>(image.bytes.size()), contentName(image.bytes)};
}

void addChips(LevelIndex& index, std::span<const ChipRow> chips) {
  index.hasChips = true;
  for (std::size_t number = 0; number < chips.size(); ++number) {
    index.groups[number].chipColumns = chips[number].size.width;
    index.groups[number].chipRows = chips[number].size.height;
    index.groups[number].chipBytes = chips[number].bytes;
  }
}

void addGroupNames(FolderName& name, std::span<const GroupFile> files) {
  for (std::uint32_t number = 0; number < files.size(); ++number)
    name.add(groupFileName(number), files[number].contentName);
}

void describeLevels(EncodedMesh& mesh, const std::string& indexUrl, LevelIndex index,
                    std::span<const GroupFile> files) {
  const Topology topology = index.hasPoints ? Topology::points : Topology::triangles;
  if (index.rootCount == 1 && index.levelCount() > 1 && !index.hasPoints)
    mesh.geometry.base = Reference{groupUrl(indexUrl, 0), PatchLocation{0}};
  double normalError = 0;
  for (std::size_t number = 0; number < files.size(); ++number) {
    normalError = std::max(normalError, files[number].normalError);
    if (index.groups[number].level > 0)
      continue;
    mesh.vertices += files[number].vertices;
    mesh.elements.of(topology) += index.hasPoints ? files[number].vertices : files[number].triangles;
  }
  mesh.geometry.levels = LevelsDescription{indexUrl, topology, std::move(index)};
  choosePatchesOfLevel(mesh.geometry, 0, {}); // reads no file
  if (mesh.hasNormals)
    mesh.normalErrorDegrees = std::max(normalErrorBound(mesh.geometry), normalError) * (180 / std::numbers::pi);
}

namespace {

/// Encodes a mesh with levels, in several attempts where images of groups would be too large.
class LevelsEncoder {
public:
  LevelsEncoder(const Lattice& lattice, const ConvertOptions& options, ContentFiles& files, ElementsDone done,
                std::string obstacle)
      : lattice_(lattice), options_(options), files_(files), done_(std::move(done)), obstacle_(std::move(obstacle)) {}

  /// The first reason why images of groups were of no use with the charts of the source; empty where there was none.
  const std::string& obstacle() const { return obstacle_; }

  /// Nothing where the images of groups would be too large, or there are no new charts. `isResampled`: from new charts,
  /// whatever the source's are.
  std::optional<EncodedMesh> encode(Mesh mesh, LevelImages* images, bool isResampled) {
    EncodedMesh result;
    const EncodeOptions encoding = encodeOptionsFrom(options_);
    const std::vector<Vec3u> points = quantise(mesh.positions, lattice_);
    result.collapsed.of(mesh.topology) = countCollapsedElements(mesh, points, lattice_.bits);
    if (images)
      images->addWholeImage(mesh);
    result.geometry = describeLeveledMesh(mesh, points, lattice_, encoding);
    noteAttributes(result, mesh, options_);
    result.positionError = positionErrorBound(result.geometry);
    if (images)
      images->addCharts(mesh);
    if (images && (isResampled || images->areTooFragmented())) {
      noteObstacle(*images);
      if (!images->resample(mesh, points) || images->areTooFragmented())
        return std::nullopt;
      result.hasResampledImages = true;
    }

    EncodedLevels encodedLevels(result.geometry, encoding, done_, images);
    const LevelOptions levelOptions{.groupTriangles = options_.groupTriangles,
                                    .regionTriangles = options_.regionTriangles};
    Levels levels = mesh.topology == Topology::points
                        ? buildPointLevels(mesh, points, levelOptions, encodedLevels.pointSink())
                        : buildLevels(std::move(mesh), points, levelOptions, encodedLevels.sink());
    done_ = [](std::size_t) {}; // of another attempt nothing is told
    if (images && !images->failure().empty()) {
      noteObstacle(*images);
      return std::nullopt;
    }
    const std::vector<EncodedGroup> groups = encodedLevels.take();
    const std::vector<ChipFile> chips = images ? images->take() : std::vector<ChipFile>{};
    std::vector<ChipRow> chipRows;
    std::vector<double> texelEdges;
    for (const ChipFile& image : chips) {
      chipRows.push_back(chipRowOf(image));
      texelEdges.push_back(image.texelEdge);
    }
    if (images)
      addTexelErrors(levels, texelEdges);
    std::vector<GroupFile> facts;
    std::ranges::transform(groups, std::back_inserter(facts), groupFileOf);
    LevelIndex index = levelIndexOf(levels, facts, lattice_.bits);
    if (images)
      addChips(index, chipRows);
    const std::string url = writeFiles(index, groups, chips, files_);
    describeLevels(result, url, std::move(index), facts);
    result.geometry.levels->chipSet = images ? narrow<std::uint32_t>(images->set()) : 0;
    return result;
  }

private:
  void noteObstacle(const LevelImages& images) {
    if (obstacle_.empty())
      obstacle_ = images.failure();
  }

  const Lattice& lattice_;
  const ConvertOptions& options_;
  ContentFiles& files_;
  ElementsDone done_;
  std::string obstacle_;
};

} // namespace

EncodedMesh encodeLevels(Mesh mesh, const Lattice& lattice, const ConvertOptions& options, ContentFiles& files,
                         const ElementsDone& done, const Atlas& atlas) {
  std::string obstacle;
  const std::unique_ptr<LevelImages> images = LevelImages::of(mesh, options, atlas, obstacle);
  LevelsEncoder encoder(lattice, options, files, done, obstacle);
  if (images) {
    if (std::optional<EncodedMesh> encoded = encoder.encode(mesh, images.get(), false))
      return *std::move(encoded);
    if (!images->newCharts() && !images->areTooFragmented()) { // else that has been tried
      images->restart();
      if (std::optional<EncodedMesh> encoded = encoder.encode(mesh, images.get(), true))
        return *std::move(encoded);
    }
  }
  EncodedMesh encoded = encoder.encode(std::move(mesh), nullptr, false).value();
  if (!encoder.obstacle().empty())
    encoded.warnings.push_back(wholeImageWarning(atlas, encoder.obstacle()));
  return encoded;
}

} // namespace imgeo
