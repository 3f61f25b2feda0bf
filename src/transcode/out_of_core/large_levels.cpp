#include "transcode/out_of_core/large_levels.h"

#include "base/error.h"
#include "base/narrow.h"
#include "base/parallel.h"
#include "containers/encodings.h"
#include "containers/option_checks.h"
#include "containers/stored_coords.h"
#include "import/mesh/add_shape.h"
#include "transcode/options/resolve_options.h"
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

// Measured with scripts/bench massive; docs/massive.md has the figures.
constexpr std::uint64_t regionBytes = 300;        ///< memory of an element while its region is built
constexpr std::uint64_t recordBytes = 384;        ///< of a face or point of a piece of the source that is scattered
constexpr std::uint64_t processBytes = 64u << 20; ///< of everything else
constexpr std::uint64_t inCoreBytes = 110;        ///< of an element of a source that is converted in memory
constexpr std::uint64_t structureBytes = 7000;    ///< of a mesh, while the page is read back: docs/massive.md
constexpr std::uint64_t workBytes = 24;           ///< of an element on disk beside its records

constexpr std::uint64_t maxPieceRecords = 1u << 18;

/// While an image is decoded, and of one that is, with its charts.
constexpr std::uint64_t decodingBytesAPixel = 16, bytesAPixel = 5;

/// The work file that says why images of groups are of no use.
const char* imageVerdict(bool resamples) {
  return resamples ? "new-images-done" : "images-done";
}

struct ImageVerdict {
  std::string obstacle;     ///< empty: they are of use, or not known to be of none
  bool mayResample = false; ///< whether new charts have not been tried
};

ImageVerdict storedVerdict(const WorkFolder& work, bool resamples) {
  const char* const name = imageVerdict(resamples);
  if (!work.has(name))
    return {};
  const Bytes bytes = readFile(work.file(name));
  WorkReader in(bytes, work.file(name));
  ImageVerdict verdict;
  verdict.obstacle = in.takeText();
  verdict.mayResample = in.take<bool>();
  return verdict;
}

/// The share of the whole work that the first pass has.
constexpr double surveyShare = 0.04;

} // namespace

LargeLevels::LargeLevels(const LargeTask& task)
    : mesh_(task.mesh), importOptions_(task.importOptions), options_(task.options), ranks_(task.ranks),
      work_(task.ranks.work()),
      passes_(task.ranks, task.progress, task.share), levelOptions_{.groupTriangles = task.options.groupTriangles,
                                                                    .regionTriangles = task.options.regionTriangles},
      laterElements_(task.laterElements) {}

void LargeLevels::buildShared() {
  surveySource();
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
  const char* const verdictFile = imageVerdict(resamples_);
  if (ranks_.isFirst()) {
    buildRest();
    hasRest_ = true;
    const bool isOfUse = images_->failure().empty() && (!resamples_ || images_->newCharts());
    WorkWriter verdict;
    verdict.addText(isOfUse ? "" : !imageObstacle_.empty() ? imageObstacle_ : images_->failure());
    verdict.add(imageObstacle_.empty());
    if (!work_.has(verdictFile))
      work_.write(verdictFile, verdict.bytes);
  }
  ranks_.barrier([&] { passes_.advance("waiting for the levels above", 0); });
  pollUntil([&] { return work_.has(verdictFile); }, [&] { ranks_.check(); });
  if (storedVerdict(work_, resamples_).obstacle.empty())
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

void LargeLevels::surveySource() {
  const auto fileOf = [](std::size_t chunk) { return taskFile("survey", 0, chunk); };
  passes_.run(
      {.name = "reading",
       .share = surveyShare,
       .count = mesh_.chunkCount(),
       .atOnce = piecesAtOnce(),
       .doneFile = "survey-done",
       .fileOf = fileOf,
       .task = [&](std::size_t chunk) { return writeSurvey(surveyPiece(mesh_, chunk, importOptions_, options_)); }});
  for (std::size_t chunk = 0; chunk < mesh_.chunkCount(); ++chunk) {
    const std::string path = work_.file(fileOf(chunk));
    survey_.add(readSurvey(readFile(path), path));
  }
}

/// Lays the lattice and describes the node.
void LargeLevels::describe() {
  lattice_ =
      latticeFor(survey_.box, options_.coordType.value_or(ElementType::uint32), positionBitsFor(survey_.box, options_));
  const std::optional<SourceLattice> source =
      mesh_.topology() == Topology::points ? findLattice(lattice_) : std::nullopt;
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
  const ImageVerdict verdict = storedVerdict(work_, false);
  resamples_ = !verdict.obstacle.empty() && verdict.mayResample && storedVerdict(work_, true).obstacle.empty();
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

/// Finds the lattice on which all positions of the source lie already, by at most two passes over them.
std::optional<SourceLattice> LargeLevels::findLattice(const Lattice& requested) {
  const std::optional<Lattice> guess = guessSourceLattice(survey_.sample, requested);
  if (!guess)
    return std::nullopt;
  const Lattice centered = centeredLattice(*guess, residualsOf(*guess, 0), requested);
  return acceptedLattice(centered, residualsOf(centered, 1), requested);
}

/// The residuals of all positions. `pass`: 0 or 1.
LatticeResiduals LargeLevels::residualsOf(const Lattice& lattice, std::uint32_t pass) {
  const auto fileOf = [&](std::size_t chunk) { return taskFile("lattice", pass, chunk); };
  passes_.run({.name = "finding the lattice of the source",
               .count = mesh_.chunkCount(),
               .atOnce = piecesAtOnce(),
               .doneFile = fmt::format("lattice-{}-done", pass),
               .fileOf = fileOf,
               .task = [&](std::size_t chunk) {
                 const Imported piece = readPiece(mesh_, chunk, importOptions_, options_);
                 WorkWriter out;
                 out.add(residualsOn(piece.scene.meshes.at(0).positions, lattice));
                 return std::move(out.bytes);
               }});
  LatticeResiduals residuals;
  for (std::size_t chunk = 0; chunk < mesh_.chunkCount(); ++chunk) {
    const std::string path = work_.file(fileOf(chunk));
    const Bytes bytes = readFile(path);
    residuals.add(WorkReader(bytes, path).take<LatticeResiduals>());
  }
  return residuals;
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

std::uint64_t pieceRecords(std::uint32_t regionTriangles) {
  return std::min(maxPieceRecords, std::uint64_t{4} * regionTriangles);
}

std::uint64_t minimumMemory(std::uint32_t regionTriangles) {
  return processBytes + std::max(recordBytes * pieceRecords(regionTriangles), regionBytes * regionTriangles);
}

std::uint64_t inCoreMemory(std::uint64_t elements) {
  return processBytes + inCoreBytes * elements;
}

std::uint64_t structureMemory(std::uint64_t meshes) {
  return structureBytes * meshes;
}

std::vector<std::size_t> largeMeshes(const ChunkedSource& source, const ConvertOptions& options) {
  const std::uint64_t withoutLevels =
      options.levels == LevelChoice::always ? options.groupTriangles : maxElementsWithoutLevels;
  std::vector<std::size_t> large;
  for (std::size_t i = 0; i < source.meshCount(); ++i)
    if (source.mesh(i).elementCount() > std::max<std::uint64_t>(withoutLevels, options.regionTriangles))
      large.push_back(i);
  return large;
}

std::uint64_t elementsOf(const ChunkedSource& source, std::span<const std::size_t> meshes) {
  std::uint64_t elements = 0;
  for (const std::size_t mesh : meshes)
    elements += source.mesh(mesh).elementCount();
  return elements;
}

namespace {

/// Calls visit(levels) for each large mesh of a source.
template <typename Visit>
void forEachMesh(const ChunkedSource& source, const ImportOptions& importOptions, const ConvertOptions& options,
                 Ranks& ranks, const Progress& progress, Visit visit) {
  const std::vector<std::size_t> meshes = largeMeshes(source, options);
  const auto all = static_cast<double>(elementsOf(source, meshes));
  std::uint64_t before = 0;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const ChunkedMesh mesh = source.mesh(meshes[i]);
    const std::uint64_t behind = before + mesh.elementCount();
    const Progress named = [&](double share, const std::string& step) {
      if (progress)
        progress(share, meshes.size() == 1 ? step : fmt::format("mesh {} of {}: {}", i + 1, meshes.size(), step));
    };
    ranks.beginMesh(mesh.number());
    const LargeTask task{mesh,
                         importOptions,
                         options,
                         ranks,
                         named,
                         {static_cast<double>(before) / all, static_cast<double>(behind) / all},
                         elementsOf(source, std::span(meshes).subspan(i + 1))};
    visit(*(mesh.topology() == Topology::points ? largeCloudLevels(task) : largeMeshLevels(task)));
    before = behind;
  }
}

} // namespace

std::vector<LargeMesh> buildOutOfCore(const ChunkedSource& source, const ImportOptions& importOptions,
                                      const ConvertOptions& options, Ranks& ranks, ContentFiles& files,
                                      const Progress& progress) {
  std::vector<LargeMesh> meshes;
  forEachMesh(source, importOptions, options, ranks, progress, [&](LargeLevels& levels) {
    levels.buildShared();
    meshes.push_back(levels.finish(files));
  });
  return meshes;
}

std::size_t shareOutOfCore(const ChunkedSource& source, const ImportOptions& importOptions,
                           const ConvertOptions& options, Ranks& ranks, const Progress& progress) {
  std::size_t tasks = 0;
  forEachMesh(source, importOptions, options, ranks, progress, [&](LargeLevels& levels) {
    levels.buildShared();
    tasks += levels.taskCount();
  });
  return tasks;
}

} // namespace imgeo
