#include "transcode/encode/levels.h"

#include "base/error.h"
#include "base/file.h"
#include "base/narrow.h"
#include "containers/encodings.h"
#include "containers/levels/group_file.h"
#include "containers/levels/level_patches.h"
#include "containers/normals.h"
#include "containers/stored_coords.h"
#include "images/decode_image.h"
#include "images/encode_image.h"
#include "images/image_type.h"
#include "images/resize.h"
#include "prepare/degenerate_elements.h"
#include "prepare/levels/point_levels.h"
#include "scene/skin.h"
#include "transcode/encode/group_chips.h"
#include "transcode/site/site_files.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

namespace imgeo {

namespace {

/// The name of the set of texture coordinates of groups' images.
constexpr const char* chipMapping = "chips";

/// The image of a group, in a file.
struct ChipFile {
  Bytes bytes;
  RasterSize size;
  double texelEdge = 0; ///< in lattice steps
};

/// What makes images of groups.
struct Chips {
  ChipSource source;
  std::size_t set = 0;                        ///< of their texture coordinates
  std::optional<int> quality{};               ///< of lossy WebP; nothing: lossless
  std::vector<std::vector<ChipFile>> files{}; ///< by level
  std::atomic<bool> hasFailed = false;        ///< an image would be too large
  std::atomic<std::uint64_t> texels = 0;

  ChipFile fileOf(Patch& patch, std::uint32_t level) {
    const std::optional<GroupChips> chips = hasFailed ? std::nullopt : makeChips(patch, level, set, source);
    if (chips)
      texels += std::uint64_t{chips->image.width} * chips->image.height;
    if (!chips || static_cast<double>(texels) > maxTexels()) {
      hasFailed = true;
      return {};
    }
    return {quality ? encodeWebp(chips->image, *quality) : encodeLosslessWebp(chips->image),
            {chips->image.width, chips->image.height},
            chips->texelEdge};
  }

private:
  double maxTexels() const { return maxChipShare * source.image.width * source.image.height; }
};

/// The encoded groups of all levels.
class EncodedLevels {
public:
  EncodedLevels(const GeometryDescription& geometry, const EncodeOptions& options, const ElementsDone& done,
                Chips* chips)
      : geometry_(geometry), options_(options), done_(done), chips_(chips) {}

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
              if (chips_)
                chips_->files.emplace_back(groupCount);
            },
            [this](std::uint32_t level, std::size_t group, GroupMesh mesh) {
              const std::size_t elementCount = mesh.patch.elementCount();
              if (chips_)
                chips_->files[level][group] = chips_->fileOf(mesh.patch, level);
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
  Chips* chips_; ///< null: none
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

/// What makes the images of the groups of a mesh; null where they cannot have any.
std::unique_ptr<Chips> chipsOf(const Mesh& mesh, const ConvertOptions& options, const ImageFile* atlas) {
  const std::size_t set = texCoordSetCount(mesh);
  const auto isInside = [](Vec2f at) { return at.x >= 0 && at.x <= 1 && at.y >= 0 && at.y <= 1; };
  if (!atlas || mesh.topology != Topology::triangles || set == 0 || set == maxTexCoordSets ||
      !std::ranges::all_of(mesh.texCoords, isInside))
    return nullptr;
  auto chips = std::make_unique<Chips>();
  const TextureOptions& textures = options.textures;
  try {
    chips->source.image = decodeRaster(atlas->bytes, atlas->url, maxAtlasPixels);
  } catch (const Error&) {
    return nullptr; // the image is reported where textures are written
  }
  Raster& image = chips->source.image;
  if (textures.size != 0)
    image = downscaled(image, sizeWithin({image.width, image.height}, textures.size), PixelContent::color);
  constexpr int defaultQuality = 90;
  if (textures.format == TextureFormat::webp || textures.format == TextureFormat::avif ||
      (textures.format == TextureFormat::keep && imageType(atlas->bytes) == ".jpg"))
    chips->quality = textures.quality.value_or(defaultQuality);
  chips->set = set;
  return chips;
}

/// Adds a set of texture coordinates that states the chart of each wedge.
void addCharts(Mesh& mesh, Chips& chips) {
  Charts charts = chartsOf(mesh, chips.source.image.width, chips.source.image.height);
  chips.source.charts = std::move(charts.masks);
  std::vector<Vec2f>& numbers = texCoordsOf(mesh, chips.set);
  numbers.clear();
  for (const std::uint32_t chart : charts.ofWedge)
    numbers.push_back({static_cast<float>(chart), 0});
}

/// Adds a set of texture coordinates over all of an image, for the description of the node.
void addWholeImage(Mesh& mesh, std::size_t set) {
  texCoordsOf(mesh, set).assign(mesh.wedgeCount(), Vec2f{0, 0});
  texCoordsOf(mesh, set).back() = {1, 1};
  mesh.texCoordMappings.resize(set);
  mesh.texCoordMappings.emplace_back(chipMapping);
}

/// Also counts the resolution of images as an error: a coarse form has half of its group's.
void addTexelErrors(Levels& levels, std::span<const ChipFile> chips) {
  for (std::size_t number = levels.rootCount; number < levels.groups.size(); ++number)
    levels.groups[number].error = std::max(levels.groups[number].error, 2 * chips[number].texelEdge);
}

std::vector<ChipFile> takeChips(Chips& chips) {
  std::vector<ChipFile> all;
  for (auto level = chips.files.rbegin(); level != chips.files.rend(); ++level)
    std::ranges::move(*level, std::back_inserter(all));
  return all;
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

/// Nothing where the images of groups would be too large.
std::optional<EncodedMesh> encodeWithChips(Mesh mesh, const Lattice& lattice, const ConvertOptions& options,
                                           ContentFiles& files, const ElementsDone& done, Chips* chips) {
  EncodedMesh result;
  const EncodeOptions encoding = encodeOptionsFrom(options);
  const std::vector<Vec3u> points = quantise(mesh.positions, lattice);
  result.collapsed.of(mesh.topology) = countCollapsedElements(mesh, points, lattice.bits);
  if (chips)
    addWholeImage(mesh, chips->set);
  result.geometry = describeLeveledMesh(mesh, points, lattice, encoding);
  noteAttributes(result, mesh, options);
  result.positionError = positionErrorBound(result.geometry);
  if (chips)
    addCharts(mesh, *chips);

  EncodedLevels encodedLevels(result.geometry, encoding, done, chips);
  const LevelOptions levelOptions{.groupTriangles = options.groupTriangles, .regionTriangles = options.regionTriangles};
  Levels levels = mesh.topology == Topology::points
                      ? buildPointLevels(mesh, points, levelOptions, encodedLevels.pointSink())
                      : buildLevels(std::move(mesh), points, levelOptions, encodedLevels.sink());
  if (chips && chips->hasFailed)
    return std::nullopt;
  const std::vector<EncodedGroup> groups = encodedLevels.take();
  const std::vector<ChipFile> images = chips ? takeChips(*chips) : std::vector<ChipFile>{};
  if (chips)
    addTexelErrors(levels, images);
  std::vector<GroupFile> facts;
  std::ranges::transform(groups, std::back_inserter(facts), groupFileOf);
  LevelIndex index = levelIndexOf(levels, facts, lattice.bits);
  index.hasChips = chips != nullptr;
  for (std::size_t number = 0; number < images.size(); ++number) {
    const ChipFile& image = images[number];
    index.groups[number].chipColumns = image.size.width;
    index.groups[number].chipRows = image.size.height;
    index.groups[number].chipBytes = narrow<std::uint32_t>(image.bytes.size());
  }
  const std::string url = writeFiles(index, groups, images, files);
  describeLevels(result, url, std::move(index), facts);
  result.geometry.levels->chipSet = chips ? narrow<std::uint32_t>(chips->set) : 0;
  return result;
}

} // namespace

EncodedMesh encodeLevels(Mesh mesh, const Lattice& lattice, const ConvertOptions& options, ContentFiles& files,
                         const ElementsDone& done, const ImageFile* atlas) {
  bool hasTried = false;
  if (const std::unique_ptr<Chips> chips = chipsOf(mesh, options, atlas)) {
    if (std::optional<EncodedMesh> encoded = encodeWithChips(mesh, lattice, options, files, done, chips.get()))
      return *std::move(encoded);
    hasTried = true; // and told how many elements are done
  }
  const ElementsDone& told = hasTried ? ElementsDone([](std::size_t) {}) : done;
  return encodeWithChips(std::move(mesh), lattice, options, files, told, nullptr).value();
}

} // namespace imgeo
