#include "transcode/out_of_core/large_levels.h"

#include "base/error.h"
#include "base/narrow.h"
#include "base/parallel.h"
#include "containers/encodings.h"
#include "containers/option_checks.h"
#include "containers/stored_coords.h"
#include "import/mesh/add_shape.h"
#include "transcode/options/resolve_options.h"
#include "transcode/out_of_core/image_verdict.h"
#include "transcode/out_of_core/memory_needs.h"
#include "transcode/out_of_core/region_triangles.h"
#include "transcode/site/site_files.h"
#include "transcode/source/scene_names.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <ranges>
#include <thread>

namespace imgeo {

namespace {

constexpr std::uint64_t workBytes = 24; ///< of an element on disk beside its records

/// While an image is decoded, and of one that is, with its charts.
constexpr std::uint64_t decodingBytesAPixel = 16, bytesAPixel = 5;

} // namespace

LargeLevels::LargeLevels(const LargeTask& task)
    : mesh_(task.mesh), importOptions_(task.importOptions), options_(task.options), ranks_(task.ranks),
      work_(task.ranks.work()),
      passes_(task.ranks, task.progress, task.share), levelOptions_{.groupTriangles = task.options.groupTriangles,
                                                                    .regionTriangles = task.options.regionTriangles},
      laterElements_(task.laterElements) {}

void LargeLevels::buildShared() {
  survey_ = surveySource(pieces(), passes_);
  describe();
  if (ranks_.isFirst())
    requireDisk();
  buildLevels();
  if (images_)
    settleImages();
}

/// Finds whether images of groups are of use when all have been counted, and builds the levels again if they are not:
/// with new charts, if these have not been tried, else without.
void LargeLevels::settleImages() {
  const char* const verdictFile = imageVerdictFile(resamples_);
  if (ranks_.isFirst()) {
    buildRest();
    hasRest_ = true;
    const bool isOfUse = images_->failure().empty() && (!resamples_ || images_->newCharts());
    const std::string obstacle = isOfUse ? "" : !imageObstacle_.empty() ? imageObstacle_ : images_->failure();
    if (!work_.has(verdictFile))
      work_.write(verdictFile, writeImageVerdict({obstacle, imageObstacle_.empty()}));
  }
  ranks_.barrier([&] { passes_.advance("waiting for the levels above", 0); });
  pollUntil([&] { return work_.has(verdictFile); }, [&] { ranks_.check(); });
  if (storedImageVerdict(work_, resamples_).obstacle.empty())
    return;
  forgetLevels();
  storedLevels_.clear(), rest_.clear(), restBytes_.clear(), restChips_.clear();
  hasRest_ = false;
  images_.reset();
  imageBytes_ = 0;
  result_ = {};
  describe(); // finds the verdict
  buildLevels();
  if (images_)
    settleImages();
}

LargeMesh LargeLevels::finish(ContentFiles& files) {
  if (!hasRest_)
    buildRest();
  std::vector<GroupFile> groups;
  std::vector<ChipRow> chips;
  std::vector<double> texelEdges;
  for (auto level = restChips_.rbegin(); level != restChips_.rend(); ++level)
    std::ranges::transform(*level, std::back_inserter(chips), chipRowOf);
  for (auto level = rest_.rbegin(); level != rest_.rend(); ++level)
    groups.insert(groups.end(), level->begin(), level->end());
  for (auto level = storedLevels_.rbegin(); level != storedLevels_.rend(); ++level)
    for (const RegionGroups& region : *level)
      for (const GroupRow& row : region.rows)
        groups.push_back(row.file), chips.push_back(row.chip);
  for (const ChipRow& chip : chips)
    texelEdges.push_back(chip.texelEdge);
  Levels levels = takeLevels();
  if (images_)
    addTexelErrors(levels, texelEdges);
  else
    chips.clear();
  LevelIndex index = levelIndexOf(levels, groups, lattice_.bits);
  if (images_)
    addChips(index, chips);
  const std::string url = writeFiles(index, groups, chips, files) + "/" + levelIndexName;
  describeLevels(result_.encoded, url, std::move(index), groups);
  result_.encoded.geometry.levels->chipSet = images_ ? narrow<std::uint32_t>(images_->set()) : 0;
  result_.encoded.hasResampledImages = images_ && images_->newCharts();
  result_.number = mesh_.number();
  result_.coarse = coarseForm();
  result_.box = survey_.box;
  result_.attributes = std::move(survey_.attributes);
  result_.warnings = std::move(survey_.warnings);
  result_.tasks = taskCount();
  return std::move(result_);
}

/// Lays the lattice and describes the node.
void LargeLevels::describe() {
  lattice_ =
      latticeFor(survey_.box, options_.coordType.value_or(ElementType::uint32), positionBitsFor(survey_.box, options_));
  const std::optional<SourceLattice> source = mesh_.topology() == Topology::points
                                                  ? findSourceLattice(pieces(), passes_, survey_.sample, lattice_)
                                                  : std::nullopt;
  if (source)
    lattice_ = source->lattice;
  if (lattice_.bits > maxLevelBits)
    throw Error(ErrorKind::unsupported, "--position-bits",
                fmt::format("levels of detail have positions of at most {} bits, not {}", maxLevelBits, lattice_.bits));
  extremes_ = extremesOf(survey_);
  Mesh& extremes = extremes_;
  const std::vector<Vec3u> points = quantise(extremes.positions, lattice_);
  maximum_ = std::max({points[1].x, points[1].y, points[1].z});
  encoding_ = encodeOptionsFrom(options_);
  computesNormals_ = survey_.lacksNormals(true);
  if (computesNormals_)
    extremes.normals.assign(2, {0, 0, 1});
  findTexture();
  result_.normalsComputed = computesNormals_;
  if (computesNormals_)
    creaseDegrees_ = survey_.creaseDegrees(result_.edges);
  else
    result_.edges.flat = survey_.lacksNormals(false);
  result_.colorError = survey_.colorError;
  result_.encoded.geometry = describeLeveledMesh(extremes, points, lattice_, encoding_);
  noteAttributes(result_.encoded, extremes, options_);
  result_.encoded.positionError = source ? source->error : positionErrorBound(result_.encoded.geometry);
  sample_ = latticePoints(survey_.sample, &lattice_);
}

/// Prepares the images of groups, where the source has a texture of which they are made.
void LargeLevels::findTexture() {
  if (mesh_.topology() != Topology::triangles || survey_.layout.texCoordSets == 0)
    return;
  Imported scene = mesh_.source().readScene({}, importOptions_);
  nameScene(scene.scene.graph, options_.title, mesh_.source().name()); // for warnings
  const Atlas atlas = atlasOf(scene.scene.graph, mesh_.number(), extremes_);
  const ImageVerdict verdict = storedImageVerdict(work_, false);
  resamples_ = !verdict.obstacle.empty() && verdict.mayResample && storedImageVerdict(work_, true).obstacle.empty();
  imageObstacle_ = verdict.obstacle;
  std::string obstacle = resamples_ ? "" : verdict.obstacle;
  if (obstacle.empty()) {
    const std::uint64_t minimum = minimumMemory(options_.regionTriangles);
    const std::uint64_t pixels = (memory() - std::min(memory(), minimum)) / decodingBytesAPixel;
    try {
      images_ = LevelImages::of(extremes_, options_, atlas, obstacle, std::min(pixels, maxAtlasPixels));
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::limit)
        throw;
      refuseOption("--memory", fmt::format("the texture takes {} bytes a pixel while it is decoded, beside at least {} "
                                           "MB, and {}",
                                           decodingBytesAPixel, (minimum + 999'999) / 1'000'000, error.what()));
    }
  }
  if (!obstacle.empty())
    result_.encoded.warnings.push_back(wholeImageWarning(atlas, obstacle));
  if (!images_)
    return;
  imageBytes_ = bytesAPixel * images_->size().width * images_->size().height;
  images_->addWholeImage(extremes_);
}

Bytes LargeLevels::withinMemory(const std::function<Bytes(std::uint64_t maxBytes)>& make) const {
  try {
    return make(memory() - std::min(memory(), processBytes));
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::limit)
      throw;
    refuseOption("--memory", fmt::format("the texture is resampled beside {} MB, and {}",
                                         (imageBytes_ + processBytes) / 1'000'000, error.what()));
  }
}

void LargeLevels::setResampled(ResampledTexture texture) {
  const std::uint64_t layerBytes = texture.charts.layers.size() * sizeof(NewCharts::Layer);
  images_->setResampled(std::move(texture));
  imageBytes_ = bytesAPixel * images_->size().width * images_->size().height + layerBytes;
  const std::uint64_t minimum = minimumMemory(options_.regionTriangles);
  if (imageBytes_ + minimum > options_.memoryBytes)
    refuseOption("--memory", fmt::format("the resampled texture takes {} bytes, beside at least {} MB", imageBytes_,
                                         (minimum + 999'999) / 1'000'000));
}

/// Refuses to begin where the disk will be full.
void LargeLevels::requireDisk() const {
  if (work_.has("scatter-0-done"))
    return;
  const std::uint64_t labels = images_ ? 3 * sizeof(Vec2f) : 0;
  const std::uint64_t each = survey_.layout.recordFloats() * sizeof(float) + labels + workBytes;
  work_.requireDisk((survey_.elements + laterElements_) * each);
}

std::size_t LargeLevels::atOnce(std::uint64_t bytesEach) const {
  const std::uint64_t fitting = (memory() - std::min(memory(), processBytes)) / bytesEach;
  return std::clamp<std::size_t>(fitting, 1, std::max(std::thread::hardware_concurrency(), 1u));
}

SourcePieces LargeLevels::pieces() const {
  return {mesh_, importOptions_, options_, work_, piecesAtOnce()};
}

std::size_t LargeLevels::piecesAtOnce() const {
  return atOnce(recordBytes * pieceRecords(options_.regionTriangles));
}

std::size_t LargeLevels::regionsAtOnce() const {
  return atOnce(regionBytes * options_.regionTriangles);
}

void LargeLevels::moveToSource(Mesh& mesh) const {
  for (Vec3f& position : mesh.positions)
    position = Vec3f(lattice_.point(Vec3u(position)));
}

std::string LargeLevels::writeFiles(const LevelIndex& index, std::span<const GroupFile> groups,
                                    std::span<const ChipRow> chips, ContentFiles& files) {
  FolderName name;
  const std::vector<Bytes> pages = writeLevelIndex(index);
  for (std::size_t page = 0; page < pages.size(); ++page)
    name.add(levelPageUrl(levelIndexName, page), ByteSpan(pages[page]));
  addGroupNames(name, groups);
  for (std::uint32_t number = 0; number < chips.size(); ++number)
    name.add(chipFileName(number), chips[number].contentName);
  return files.writeFolder(name, [&](const std::function<void(const FolderFile&)>& write) {
    for (std::size_t page = 0; page < pages.size(); ++page)
      write({levelPageUrl(levelIndexName, page), pages[page]});
    std::uint32_t number = 0, chipNumber = 0;
    for (auto level = restBytes_.rbegin(); level != restBytes_.rend(); ++level)
      for (const Bytes& bytes : *level)
        write({groupFileName(number++), bytes});
    for (const auto& level : std::views::reverse(restChips_))
      for (const ChipFile& image : level)
        write({chipFileName(chipNumber++), image.bytes});
    for (std::size_t level = storedLevels_.size(); level-- > 0;)
      for (std::size_t region = 0; region < storedLevels_[level].size(); ++region) {
        const FileView view(work_.file(taskFile("groups", fileNumber(static_cast<std::uint32_t>(level)), region)));
        const RegionGroups& groupsOfRegion = storedLevels_[level][region];
        std::size_t at = groupsOfRegion.dataOffset;
        for (const GroupRow& row : groupsOfRegion.rows) {
          write({groupFileName(number++), view.bytes().subspan(at, row.file.bytes)});
          at += row.file.bytes;
        }
        for (std::size_t i = 0; images_ && i < groupsOfRegion.rows.size(); ++i) {
          const ChipRow& chip = groupsOfRegion.rows[i].chip;
          write({chipFileName(chipNumber++), view.bytes().subspan(at, chip.bytes)});
          at += chip.bytes;
        }
        passes_.advance("writing", 0);
      }
  });
}

} // namespace imgeo
