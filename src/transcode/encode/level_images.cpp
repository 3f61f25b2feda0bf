#include "transcode/encode/level_images.h"

#include "base/error.h"
#include "base/parallel.h"
#include "images/decode_image.h"
#include "images/encode_image.h"
#include "images/image_type.h"
#include "images/resize.h"
#include "transcode/encode/rebaked_atlas.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace imgeo {

namespace {

/// The name of the set of texture coordinates of groups' images.
constexpr const char* chipMapping = "chips";

/// The least texels of the images of level 0. All texels of a chart are in its chips there, and no chips of so many
/// texels together are smaller than a square one.
double minTexelsOf(const std::vector<ChartMask>& charts) {
  double min = 0;
  for (const ChartMask& chart : charts)
    if (const auto texels = std::ranges::count(chart.bits(), true); texels > 0)
      min += std::pow(std::sqrt(static_cast<double>(texels)) + 2 * chipGutter, 2);
  return min;
}

/// Replaces a set of texture coordinates by one that states the chart of each triangle; wedges of several are doubled.
void setChartsOfTriangles(Mesh& mesh, std::size_t set, std::span<const std::uint32_t> charts) {
  constexpr std::uint32_t none = UINT32_MAX;
  struct Copy {
    std::uint32_t wedge, chart, next;
  };
  std::vector<Copy> copies;
  std::vector<std::uint32_t> firstCopy(mesh.wedgeCount(), none), sources;
  for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner) {
    std::uint32_t& wedge = mesh.corners[corner];
    std::uint32_t copy = firstCopy[wedge];
    while (copy != none && copies[copy].chart != charts[corner / 3])
      copy = copies[copy].next;
    if (copy == none) {
      copy = static_cast<std::uint32_t>(copies.size());
      copies.push_back({wedge, charts[corner / 3], firstCopy[wedge]});
      firstCopy[wedge] = copy;
      sources.push_back(wedge);
    }
    wedge = copy;
  }
  mesh.wedgePositions = gather(mesh.wedgePositions, sources);
  static_cast<VertexAttributes&>(mesh) = gather(mesh, sources);
  std::vector<Vec2f>& numbers = texCoordsOf(mesh, set);
  for (std::size_t wedge = 0; wedge < copies.size(); ++wedge)
    numbers[wedge] = {static_cast<float>(copies[wedge].chart), 0};
}

/// Why the groups of a mesh whose texture is an atlas have no images, or nullptr.
const char* obstacleIn(const Mesh& mesh) {
  if (texCoordSetCount(mesh) == maxTexCoordSets)
    return "it has as many sets of texture coordinates as a mesh can have";
  const auto isInside = [](Vec2f at) { return at.x >= 0 && at.x <= 1 && at.y >= 0 && at.y <= 1; };
  return std::ranges::all_of(mesh.texCoords, isInside) ? nullptr : "its texture coordinates leave 0 .. 1";
}

} // namespace

std::unique_ptr<LevelImages> LevelImages::of(const Mesh& mesh, const ConvertOptions& options, const Atlas& atlas,
                                             std::string& reason, std::uint64_t maxPixels) {
  reason = mesh.topology == Topology::triangles ? atlas.obstacle : "";
  if (!atlas.image || mesh.topology != Topology::triangles)
    return nullptr;
  if (const char* obstacle = obstacleIn(mesh)) {
    reason = obstacle;
    return nullptr;
  }
  const ImageFile& image = *atlas.image;
  auto images = std::make_unique<LevelImages>();
  const TextureOptions& textures = options.textures;
  Raster& raster = images->source_.image;
  try {
    raster = decodeRaster(image.bytes, image.url.empty() ? "an embedded image" : image.url, maxPixels);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::limit && maxPixels < maxAtlasPixels)
      throw;
    if (isWebImageType(imageType(image.bytes))) // others are reported where textures are written
      reason = error.what();
    return nullptr;
  }
  if (textures.size != 0)
    raster = downscaled(raster, sizeWithin({raster.width, raster.height}, textures.size), PixelContent::color);
  constexpr int defaultQuality = 90;
  if (textures.format == TextureFormat::webp || textures.format == TextureFormat::avif ||
      (textures.format == TextureFormat::keep && imageType(image.bytes) == ".jpg"))
    images->quality_ = textures.quality.value_or(defaultQuality);
  images->texelsOfWhole_ = std::uint64_t{raster.width} * raster.height;
  images->set_ = texCoordSetCount(mesh);
  images->groupTriangles_ = options.groupTriangles;
  return images;
}

void LevelImages::addWholeImage(Mesh& mesh) const {
  texCoordsOf(mesh, set_).assign(mesh.wedgeCount(), Vec2f{0, 0});
  texCoordsOf(mesh, set_).back() = {1, 1};
  mesh.texCoordMappings.resize(set_);
  mesh.texCoordMappings.emplace_back(chipMapping);
}

void LevelImages::addCharts(Mesh& mesh) {
  Charts charts = chartsOf(mesh, source_.image.width, source_.image.height);
  setCharts(std::move(charts.masks));
  std::vector<Vec2f>& numbers = texCoordsOf(mesh, set_);
  numbers.clear();
  for (const std::uint32_t chart : charts.ofWedge)
    numbers.push_back({static_cast<float>(chart), 0});
}

void LevelImages::setCharts(std::vector<ChartMask> charts) {
  source_.charts = std::move(charts);
  minTexels_ = minTexelsOf(source_.charts);
}

bool LevelImages::areTooFragmented() const {
  return minTexels_ > maxTexels();
}

bool LevelImages::resample(Mesh& mesh, std::span<const Vec3u> points) {
  const auto triangleOf = [&](std::size_t triangle) {
    TexturedTriangle textured;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t wedge = mesh.corners[3 * triangle + i];
      textured.points[i] = points[mesh.wedgePositions[wedge]];
      textured.texCoords[i] = mesh.texCoords[wedge];
      textured.chart = static_cast<std::uint32_t>(texCoordsOf(mesh, set_)[wedge].x);
    }
    return textured;
  };
  const TriangleVisits triangles = [&](const auto& visit) {
    for (std::size_t triangle = 0; triangle < mesh.elementCount(); ++triangle)
      visit(triangleOf(triangle));
  };
  std::optional<ResampledTexture> texture = resampled(triangles);
  if (!texture)
    return false;
  setResampled(*std::move(texture));
  std::vector<std::uint32_t> charts(mesh.elementCount());
  parallelForBlocks(charts.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t triangle = begin; triangle < end; ++triangle)
      charts[triangle] = newCharts_->chartOf(triangleOf(triangle));
  });
  setChartsOfTriangles(mesh, set_, charts);
  return true;
}

std::optional<ResampledTexture> LevelImages::resampled(const TriangleVisits& triangles, std::uint64_t maxBytes) const {
  std::optional<NewCharts> charts = NewCharts::of(triangles, size(), groupTriangles_, maxBytes);
  if (!charts)
    return std::nullopt;
  ChipSource source = rebakedAtlas(*charts, triangles, source_);
  return ResampledTexture{*std::move(charts), std::move(source)};
}

void LevelImages::setResampled(ResampledTexture texture) {
  newCharts_ = std::move(texture.charts);
  source_ = std::move(texture.source);
  minTexels_ = minTexelsOf(source_.charts);
}

void LevelImages::restart() {
  files_.clear();
  texels_ = 0, hasLargeImage_ = false;
}

bool LevelImages::make(Patch& patch, std::uint32_t level, std::size_t group) {
  files_[level][group] = makeFile(patch, level);
  return !files_[level][group].bytes.empty();
}

ChipFile LevelImages::makeFile(Patch& patch, std::uint32_t level) {
  const std::optional<RasterSize> size = chipImageSize(patch, level, set_, source_);
  if (!size)
    hasLargeImage_ = true;
  else
    texels_ += std::uint64_t{size->width} * size->height;
  if (!size || hasFailed())
    return {{}, size.value_or(RasterSize{})};
  const GroupChips chips = makeChips(patch, level, set_, source_).value();
  return {quality_ ? encodeWebp(chips.image, *quality_) : encodeLosslessWebp(chips.image), *size, chips.texelEdge};
}

bool LevelImages::hasFailed() const {
  return areTooFragmented() || hasLargeImage_ || static_cast<double>(texels_) > maxTexels();
}

std::string LevelImages::failure() const {
  if (areTooFragmented())
    return fmt::format(
        "its charts are so small that these would have at least {:.0f} texels, more than {} times the {} "
        "of the whole image",
        minTexels_, maxChipShare, texelsOfWhole_);
  if (hasLargeImage_)
    return fmt::format("one of these would have an edge of more than {} texels", maxChipEdge);
  if (hasFailed())
    return fmt::format("these would have {} texels, more than {} times the {} of the whole image", texels_.load(),
                       maxChipShare, texelsOfWhole_);
  return "";
}

std::vector<ChipFile> LevelImages::take() {
  std::vector<ChipFile> all;
  for (auto level = files_.rbegin(); level != files_.rend(); ++level)
    std::ranges::move(*level, std::back_inserter(all));
  return all;
}

void addTexelErrors(Levels& levels, std::span<const double> texelEdges) {
  for (std::size_t number = levels.rootCount; number < levels.groups.size(); ++number)
    levels.groups[number].error = std::max(levels.groups[number].error, 2 * texelEdges[number]);
}

} // namespace imgeo
