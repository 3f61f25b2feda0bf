// The steps from a source to encoded meshes.

#include "transcode/convert/conversion.h"

#include "prepare/instances/share_meshes.h"
#include "prepare/lattice.h"
#include "scene/deformation.h"
#include "scene/moving_boxes.h"
#include "scene/source_axes.h"
#include "transcode/convert/sequence_options.h"
#include "transcode/convert/source_attributes.h"
#include "transcode/convert/x3dom_limits.h"
#include "transcode/default_scene/default_appearances.h"
#include "transcode/encode/encode_scene.h"
#include "transcode/encode/tiny_meshes.h"
#include "transcode/options/resolve_options.h"
#include "transcode/out_of_core/choose.h"
#include "transcode/out_of_core/large_meshes.h"
#include "transcode/out_of_core/memory_needs.h"
#include "transcode/site/site_files.h"
#include "transcode/source/detect_axes.h"
#include "transcode/source/frame_files.h"
#include "transcode/source/preparation.h"
#include "transcode/source/scene_names.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

/// In scenes in which small meshes share geometry nodes, those of fewer elements take about as many bytes as the
/// Transform of an instance, and fewer than that and a geometry node of their own if few are equal:
/// docs/decisions/instances.md.
constexpr std::size_t minInstanceElements = 48, minSmallClass = 16;

} // namespace

Conversion::Conversion(const std::vector<fs::path>& frames, const fs::path& directory, const ConvertOptions& options,
                       const Progress& progress, std::unique_ptr<ChunkedSource> source)
    : input_(frames.front()), frames_(frames), options_(options), progress_(progress), source_(std::move(source)),
      site_(directory, options.force), workFolder_(workFolderOf(directory, options)) {}

void Conversion::readSource() {
  reportProgress(0, "reading");
  ImportOptions importOptions =
      importOptionsFor(options_, frames_.size() > 1 ? RecordingChoice{} : recordingChoice(options_));
  Imported imported = source_ ? buildLarge(importOptions) : importInput(input_, importOptions, report_.sourceBytes);
  requireAttributes(imported, options_);
  report_.format = imported.format;
  report_.warnings = std::move(imported.warnings);
  source_.reset(); // what it knows of many meshes takes memory
  report_.axes = detectAxes(imported, options_.axes, stored_.get());
  report_.origin = {imported.origin.x, imported.origin.y, imported.origin.z};
  scene_ = std::move(imported.scene);
  applySourceAxes(scene_.graph, report_.axes.axes);
  nameScene(scene_.graph, options_.title, frames_.size() > 1 ? withoutNumber(input_) : input_);
  if (frames_.size() > 1) {
    importOptions.origin = imported.origin;
    recordFiles(importOptions);
  } else
    recordings_ = recordScene(scene_, options_.rate, recordsAll(options_), locationOf(input_), report_.warnings);
  if (!recordings_.empty())
    requireSequenceOptions(options_);
  for (Recording& recording : recordings_)
    recording.hasVideo = options_.form == MeshForm::video || (recording.hasVideo && !recordsAll(options_));
  surveyRecordings();
}

void Conversion::resolveOptions() {
  if (!recordings_.empty())
    sequenceOptions_ = resolvedFor(scene_, ofSequences(options_));
  options_ = resolvedFor(scene_, options_);
  report_.encoding = *options_.encoding;
  report_.normalEncoding = options_.normals;
  report_.normalBits = options_.normalBits;
  report_.texCoordBits = options_.texCoordBits;
  report_.colorBits = options_.colorBits;
  report_.importSeconds = step_.lapSeconds();
}

void Conversion::prepareMeshes() {
  reportProgress(0.2, "preparing");
  const bool lackNormals = anyLacksNormals();
  const PreparationReport prepared = prepareScene(scene_, preparationFor(options_), locationOf(input_));
  roundingOfColors_ = prepared.colorError;
  const bool isWhole = large_.empty() && !stored_;
  report_.weld = isWhole ? prepared.weld : WeldReport{}; // regions do not count what the whole mesh has
  report_.normalsComputed = isWhole ? prepared.normalsComputed : lackNormals;
  if (stored_)
    roundingOfColors_ = std::max(roundingOfColors_, stored_->colorError());
  for (const LargeMesh& mesh : large_)
    roundingOfColors_ = std::max(roundingOfColors_, mesh.colorError);
  std::ranges::copy(prepared.warnings, std::back_inserter(report_.warnings));
  report_.edges = stored_ ? stored_->edges() : prepared.edges;
  for (const LargeMesh& mesh : large_)
    report_.edges += mesh.edges;
  if (options_.target == Target::x3dom) {
    hasOnlyFirstTexCoords_ = leaveOutForX3dom(scene_, report_.warnings);
  }
  report_.prepareSeconds = step_.lapSeconds();
}

bool Conversion::isLarge(std::size_t mesh) const {
  return std::ranges::find(large_, mesh, &LargeMesh::number) != large_.end();
}

/// Whether a mesh of the source has no normals; what stands in for large ones may have none although these have.
bool Conversion::anyLacksNormals() const {
  bool any = std::ranges::any_of(large_, &LargeMesh::normalsComputed);
  for (std::size_t i = 0; i < scene_.meshes.size(); ++i) {
    const Mesh& mesh = scene_.meshes[i];
    any |= !isLarge(i) && mesh.topology == Topology::triangles && mesh.normals.empty() && mesh.creaseDegrees != 0 &&
           mesh.elementCount() > 0;
  }
  return any;
}

void Conversion::shareEqualMeshes() {
  if (!options_.findInstances)
    return;
  std::vector<std::size_t> excluded;
  for (const Recording& recording : recordings_)
    excluded.push_back(shapeOf(scene_.graph, recording.shape).mesh);
  for (const LargeMesh& mesh : large_)
    excluded.push_back(mesh.number);
  const SharedMeshes shared = shareMeshes(
      scene_,
      {.tolerance = [&](const Box3d& box) { return latticeFor(box, positionBitsFor(box, options_)).step / 2; },
       .minElements = scene_.meshes.size() >= minTinyMeshScene ? minInstanceElements : 0,
       .minSmallClass = minSmallClass,
       .maxTexturedElements = options_.groupTriangles},
      excluded, stored_.get());
  report_.instances = {shared.shapes, shared.meshes, shared.distance};
  report_.prepareSeconds += step_.lapSeconds();
}

void Conversion::sampleSurfaces() {
  setMovingBoxes(scene_);
  const std::optional<Scene> rest = atRest(scene_);
  const Scene& scene = rest ? *rest : scene_;
  if (options_.pictures)
    pictureSamples_ = pictureSamplesOf(scene, maxPictureSamples, stored_.get());
  if (!scene_.graph.isComplete && (options_.view != StartView::automatic || !hasViewpoint(scene_.graph)))
    viewSamples_ = viewSamplesOf(scene, stored_.get());
}

void Conversion::encodeMeshes() {
  reportProgress(0.3, "writing");
  std::map<std::size_t, WrittenMesh> written;
  for (LargeMesh& mesh : large_)
    written[mesh.number] = {std::move(mesh.encoded), mesh.box};
  std::size_t elementCount = 0, elementsDone = 0;
  const SceneMeshes meshes(scene_.meshes, stored_.get());
  for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh)
    elementCount += meshes.elementCount(mesh);
  for (const Recording& recording : recordings_)
    elementCount += recording.frames->count();
  std::mutex doneMutex;
  ContentFiles files(site_.path(), geometryFolder);
  const ElementsDone done = [&](std::size_t count) {
    const std::lock_guard lock(doneMutex);
    elementsDone += count;
    reportProgress(0.3 + 0.69 * static_cast<double>(elementsDone) / static_cast<double>(elementCount), "writing");
  };
  EncodedScene encoded = encodeScene({std::move(scene_), recordings_, std::move(written), stored_.get()},
                                     {options_, sequenceOptions_, files, report_, done});
  document_ = std::move(encoded.document);
  if (options_.target == Target::x3dom) // which lights triangles alone
    encoded.hasNormals.assign(encoded.hasNormals.size(), false);
  if (!document_.graph.isComplete)
    assignDefaultAppearances(document_, encoded.hasNormals);
  stored_.reset();
  report_.colorError += roundingOfColors_;
}

void Conversion::tellOthers(const std::string& sentence) {
  if (ranks_)
    ranks_->fail(sentence);
}

void Conversion::recordFiles(const ImportOptions& importOptions) {
  const auto files = std::make_shared<FrameFiles>(frames_, scene_, importOptions);
  report_.sourceBytes = files->bytes();
  recordings_.push_back(recordingOfFiles(scene_.graph, files, options_.rate));
}

void Conversion::surveyRecordings() {
  std::size_t read = 0, count = 0;
  for (const Recording& recording : recordings_)
    count += recording.frames->count();
  for (Recording& recording : recordings_) {
    recording.survey = survey(*recording.frames, locationOf(input_), [&] {
      reportProgress(0.2 * static_cast<double>(++read) / static_cast<double>(count), "reading");
    });
    numberVertices(scene_.meshes[shapeOf(scene_.graph, recording.shape).mesh]);
  }
}

void Conversion::reportProgress(double fraction, const std::string& step) const {
  if (progress_)
    progress_(std::lerp(shareOfLevels_, 1.0, fraction), step);
}

Imported Conversion::buildLarge(const ImportOptions& importOptions) {
  ConvertOptions options = outOfCoreOptions(options_);
  if (largeMeshes(*source_, options).empty())
    options.ranks = {}; // the others have nothing to do
  report_.sourceBytes = source_->fileBytes();
  ranks_ = openRanks(input_, workFolder_, options, progress_);
  ContentFiles files(site_.path(), geometryFolder);
  shareOfLevels_ = shareOfLevels(*source_, options);
  ConvertOptions ofLevels = options;
  ofLevels.memoryBytes =
      std::max(options.memoryBytes - std::min(options.memoryBytes, structureMemory(source_->meshCount())),
               minimumMemory(options.regionTriangles));
  large_ =
      buildOutOfCore(*source_, importOptions, ofLevels, *ranks_, files, progressOutOfCore(progress_, shareOfLevels_));

  Imported imported = readSmall(importOptions, options);
  for (LargeMesh& mesh : large_) {
    Mesh& standIn = imported.scene.meshes.at(mesh.number);
    mesh.coarse.name = std::move(standIn.name);
    standIn = std::move(mesh.coarse);
    addMissing(imported.attributes, mesh.attributes);
    addMissing(imported.warnings, mesh.warnings);
    if (ranks_->count() > 1)
      report_.tasks += mesh.tasks;
  }
  if (ranks_->count() > 1)
    report_.tasksTaken = ranks_->tasksTaken();
  return imported;
}

/// Reads the scene with the small meshes, which are stored where memory does not hold them together.
Imported Conversion::readSmall(const ImportOptions& importOptions, const ConvertOptions& options) {
  if (fitTogether(*source_, options))
    return source_->readScene(smallMeshes(*source_, options), importOptions);
  stored_ = storeSmallMeshes(*source_, importOptions, options, *ranks_,
                             [&](double share, const std::string& step) { reportProgress(0.2 * share, step); });
  Imported imported = source_->readScene({}, importOptions);
  for (const std::size_t mesh : stored_->emptyMeshes())
    imported.scene.meshes.at(mesh) = {};
  addMissing(imported.attributes, stored_->attributes());
  addMissing(imported.warnings, stored_->warnings());
  return imported;
}

} // namespace imgeo
