// convert(): the order of the steps from an input file to a published site.

#include "imgeo/convert.h"

#include "base/error.h"
#include "base/file.h"
#include "containers/option_checks.h"
#include "imgeo/site.h"
#include "imgeo/version.h"
#include "import/warnings.h"
#include "scene/deformation.h"
#include "scene/fog_depths.h"
#include "scene/moving_boxes.h"
#include "scene/source_axes.h"
#include "transcode/convert/peak_memory.h"
#include "transcode/convert/precompress.h"
#include "transcode/default_scene/default_appearances.h"
#include "transcode/default_scene/default_nodes.h"
#include "transcode/encode/encode_report.h"
#include "transcode/encode/encode_scene.h"
#include "transcode/encode/textures.h"
#include "transcode/options/resolve_options.h"
#include "transcode/out_of_core/choose.h"
#include "transcode/out_of_core/out_of_core.h"
#include "transcode/picture/write_pictures.h"
#include "transcode/site/site_files.h"
#include "transcode/site/site_manifest.h"
#include "transcode/site/site_pages.h"
#include "transcode/site/staged_site.h"
#include "transcode/source/detect_axes.h"
#include "transcode/source/frame_files.h"
#include "transcode/source/preparation.h"
#include "transcode/source/recordings.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mutex>
#include <set>

namespace imgeo {

namespace fs = std::filesystem;

namespace {

class Stopwatch {
public:
  /// Seconds since construction or since the last call.
  double lapSeconds() {
    const Clock::time_point now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(lap_, now)).count();
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point lap_ = Clock::now();
};

/// Refuses an input inside the target directory: publishing the site would remove it.
void requireOutside(const fs::path& input, const fs::path& directory) {
  std::error_code ignored;
  const fs::path file = fs::weakly_canonical(input, ignored), target = fs::weakly_canonical(directory, ignored);
  if (std::mismatch(target.begin(), target.end(), file.begin(), file.end()).first == target.end())
    throw Error(ErrorKind::usage, input.string(), "lies inside the directory that is to be replaced");
}

/// The input's file name without extensions: "statue" for "scans/statue.ply.gz".
std::string titleFrom(const fs::path& input) {
  if (input == "-")
    return "Untitled";
  fs::path name = input.filename();
  if (name.extension() == ".gz")
    name = name.stem();
  return name.stem();
}

/// "frames/cloth.ply" for "frames/cloth-0001.ply".
fs::path withoutNumber(const fs::path& frame) {
  std::string stem = frame.stem();
  while (!stem.empty() && std::string_view("0123456789-_. ").find(stem.back()) != std::string_view::npos)
    stem.pop_back();
  return stem.empty() ? frame : frame.parent_path() / (stem + frame.extension().string());
}

void requireAttributes(const Imported& imported, const ConvertOptions& options) {
  for (const std::string& name : options.keepAttributes.names)
    if (std::ranges::find(imported.attributes, name) == imported.attributes.end())
      throw Error(ErrorKind::usage, "--keep-attributes",
                  imported.attributes.empty() ? fmt::format("the input has no attribute \"{}\", nor any other", name)
                                              : fmt::format("the input has no attribute \"{}\" but {}", name,
                                                            fmt::join(imported.attributes, ", ")));
}

/// Sets the scene's title: the stated one, else the source's own, else the file's name.
void nameScene(SceneGraph& graph, const std::string& statedTitle, const fs::path& input) {
  if (!statedTitle.empty())
    graph.title = statedTitle;
  else if (graph.title.empty())
    graph.title = titleFrom(input);
  if (graph.isComplete)
    return;
  // Scripts find shapes by name, and files with one object rarely name it.
  const std::vector<std::size_t> shapes = shapeNodes(graph);
  if (shapes.size() == 1 && graph.nodes[shapes[0]].name.empty())
    graph.nodes[shapes[0]].name = graph.title;
}

/// Refuses options that contradict sequences.
void requireSequenceOptions(const ConvertOptions& options) {
  if (options.encoding.value_or(Encoding::classic) == Encoding::bg)
    refuseOption("--container", "the static files of a sequence are SIG classic");
  if (options.target == Target::x3dom)
    refuseOption("--target", "X3DOM plays no sequences of frames");
  if (options.primitives != Primitives::triangles || !options.indexed)
    refuseOption(options.indexed ? "--primitives" : "--index", "sequences have an index of triangles");
  if (!(options.rate > 0 && options.rate <= 1000))
    refuseOption("--rate", "a sequence has more than 0 and at most 1000 frames per second");
}

/// The options of the meshes of sequences, whose static files are SIG classic.
ConvertOptions ofSequences(ConvertOptions options) {
  options.encoding = Encoding::classic;
  options.form = MeshForm::mesh;
  return options;
}

/// The options for frames in files of their own.
ConvertOptions optionsForFiles(const std::vector<fs::path>& frames, const ConvertOptions& options) {
  if (std::ranges::find(frames, fs::path("-")) != frames.end())
    throw Error(ErrorKind::usage, "-", "standard input is one file; a sequence has one for each frame");
  if (options.encoding.value_or(Encoding::classic) != Encoding::classic)
    refuseOption("--profile", "the static files of a sequence are SIG classic");
  if (options.form == MeshForm::geometryImage || options.form == MeshForm::heightMap)
    refuseOption("--as", "the frames of a sequence are meshes, or a video");
  requireSequenceOptions(options);
  ConvertOptions ofFiles = ofSequences(options);
  ofFiles.form = options.form;
  return ofFiles;
}

/// Whether everything that moves the vertices of a source is to be recorded.
bool recordsAll(const ConvertOptions& options) {
  return options.form == MeshForm::sequence || options.form == MeshForm::video;
}

/// The animations of vertices of a document that become sequences although nobody asked for it: those whose text is
/// long, unless other options contradict.
RecordingChoice recordingChoice(const ConvertOptions& options) {
  RecordingChoice choice{.rate = options.rate, .all = recordsAll(options), .files = true};
  const bool allowsSequences = options.encoding.value_or(Encoding::classic) != Encoding::bg &&
                               options.target != Target::x3dom && options.primitives == Primitives::triangles &&
                               options.indexed && options.form == MeshForm::mesh;
  if (allowsSequences)
    choice.minBytes = longKeyValueBytes;
  return choice;
}

/// Fog needs depths, whatever else is kept.
ImportOptions importOptionsFor(const ConvertOptions& options, RecordingChoice recordings) {
  AttributeChoice attributes = options.keepAttributes;
  attributes.names.insert(fogDepthName);
  return {.attributes = std::move(attributes),
          .folder = {},
          .outside = options.outside,
          .inlineBytes = inlineBytes,
          .recordings = recordings,
          .strict = options.strict};
}

/// Warns if more than 1 % of the elements collapsed on the lattice. Fewer are normal: scans contain slivers.
void warnOfCollapsed(ConvertReport& report) {
  const auto warn = [&](Topology topology, const char* lost) {
    if (const std::size_t count = report.collapsed.of(topology); 100 * count > report.elements.of(topology))
      report.warnings.push_back(fmt::format("{} of {} {} have no {} at {} bits", count, report.elements.of(topology),
                                            nameOf(topology), lost, report.minPositionBits));
  };
  warn(Topology::triangles, "area");
  warn(Topology::lines, "length");
}

/// Bytes by role, in the order of the roles' first files.
std::vector<RoleBytes> sumByRole(const std::vector<SiteFile>& files) {
  std::vector<RoleBytes> roles;
  for (const SiteFile& file : files) {
    auto role = std::ranges::find(roles, file.role, &RoleBytes::role);
    if (role == roles.end())
      role = roles.insert(role, {file.role, 0, 0});
    role->bytes += file.bytes;
    ++role->files;
  }
  return roles;
}

/// The share of building levels in the work of a conversion out of core.
constexpr double levelShare = 0.97;

/// What the other ranks are told of one that ends by what is no Error.
constexpr const char* interruptedRank = "it was interrupted";

Progress progressOutOfCore(const Progress& progress) {
  return [&progress](double share, const std::string& step) {
    if (progress)
      progress(levelShare * share, step);
  };
}

/// The options of building levels out of core.
ConvertOptions outOfCoreOptions(const ConvertOptions& given) {
  ConvertOptions options = resolved(given);
  options.memoryBytes = memoryLimit(options);
  return options;
}

/// Opens the work folder, with the other ranks.
std::unique_ptr<Ranks> openRanks(const fs::path& input, const fs::path& workFolder, const ConvertOptions& options,
                                 const Progress& progress) {
  return std::make_unique<Ranks>(options.ranks, workFolder, jobOf(input, options), options.resume, [&] {
    if (progress)
      progress(0, "waiting for the other ranks");
  });
}

/// The conversion by another rank than 0, whose source may be none that is converted out of core.
ConvertReport convertShare(const fs::path& input, const fs::path& directory, const ConvertOptions& given,
                           const Progress& progress, const ChunkedSource* source) {
  ConvertReport report;
  Stopwatch total;
  if (source) {
    const ConvertOptions options = outOfCoreOptions(given);
    const std::unique_ptr<Ranks> ranks = openRanks(input, workFolderOf(directory, options), options, progress);
    try {
      report.tasks =
          shareOutOfCore(*source, importOptionsFor(options, {}), options, *ranks, progressOutOfCore(progress));
      report.tasksTaken = ranks->tasksTaken();
      ranks->leave([&] {
        if (progress)
          progress(levelShare, "waiting for rank 0");
      });
    } catch (const Error& error) {
      ranks->fail(error.what());
      throw;
    } catch (...) {
      ranks->fail(interruptedRank);
      throw;
    }
  }
  report.totalSeconds = total.lapSeconds();
  report.peakMemoryBytes = peakMemoryBytes();
  return report;
}

/// One conversion: each member function is one step of convert().
class Conversion {
public:
  /// `frames`: those of a sequence; otherwise one file.
  Conversion(const std::vector<fs::path>& frames, const fs::path& directory, const ConvertOptions& options,
             const Progress& progress, std::unique_ptr<ChunkedSource> source)
      : input_(frames.front()), frames_(frames), options_(options), progress_(progress), source_(std::move(source)),
        site_(directory, options.force), workFolder_(workFolderOf(directory, options)) {}

  void readSource() {
    reportProgress(0, "reading");
    const ImportOptions importOptions =
        importOptionsFor(options_, frames_.size() > 1 ? RecordingChoice{} : recordingChoice(options_));
    Imported imported = source_ ? buildLarge(importOptions) : importInput(input_, importOptions, report_.sourceBytes);
    requireAttributes(imported, options_);
    report_.format = imported.format;
    report_.warnings = std::move(imported.warnings);
    report_.axes = detectAxes(imported, options_.axes);
    scene_ = std::move(imported.scene);
    applySourceAxes(scene_.graph, report_.axes.axes);
    nameScene(scene_.graph, options_.title, frames_.size() > 1 ? withoutNumber(input_) : input_);
    if (frames_.size() > 1)
      recordFiles(importOptions);
    else
      recordings_ = recordScene(scene_, options_.rate, recordsAll(options_), locationOf(input_), report_.warnings);
    if (!recordings_.empty())
      requireSequenceOptions(options_);
    for (Recording& recording : recordings_)
      recording.hasVideo = options_.form == MeshForm::video || (recording.hasVideo && !recordsAll(options_));
    surveyRecordings();
  }

  /// Fills in the options that depend on the source.
  void resolveOptions() {
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

  /// Welds meshes, drops elements and computes missing normals.
  void prepareMeshes() {
    reportProgress(0.2, "preparing");
    const PreparationReport prepared = prepareScene(
        scene_,
        {.dropped = options_.dropped, .weighting = options_.normalWeighting, .byteColors = options_.colorBits <= 8},
        locationOf(input_));
    roundingOfColors_ = large_ ? large_->colorError : prepared.colorError;
    report_.weld = large_ ? WeldReport{} : prepared.weld; // regions do not count what the whole mesh has
    report_.normalsComputed = large_ ? large_->normalsComputed : prepared.normalsComputed;
    std::ranges::copy(prepared.warnings, std::back_inserter(report_.warnings));
    if (options_.target == Target::x3dom) {
      leaveOutTexCoords();
      leaveOutFogDepths();
      leaveOutDeformations();
    }
    report_.prepareSeconds = step_.lapSeconds();
  }

  /// Samples the surfaces for the page's pictures and the default viewpoints, before the meshes are encoded.
  void sampleSurfaces() {
    setMovingBoxes(scene_);
    const std::optional<Scene> rest = atRest(scene_);
    const Scene& scene = rest ? *rest : scene_;
    if (options_.pictures)
      pictureSamples_ = pictureSamplesOf(scene);
    if (!scene_.graph.isComplete && (options_.view != StartView::automatic || !hasViewpoint(scene_.graph)))
      viewSamples_ = viewSamplesOf(scene);
  }

  void encodeMeshes() {
    reportProgress(0.3, "writing");
    if (large_) { // whose files have been written
      document_.graph = std::move(scene_.graph);
      addToReport(report_, large_->encoded);
      document_.geometries = {std::move(large_->encoded.geometry)};
      report_.colorError += roundingOfColors_;
      return;
    }
    std::size_t elementCount = 0, elementsDone = 0;
    for (const Mesh& mesh : scene_.meshes)
      elementCount += mesh.elementCount();
    for (const Recording& recording : recordings_)
      elementCount += recording.frames->count();
    std::mutex doneMutex;
    ContentFiles files(site_.path(), geometryFolder);
    const ElementsDone done = [&](std::size_t count) {
      const std::lock_guard lock(doneMutex);
      elementsDone += count;
      reportProgress(0.3 + 0.69 * static_cast<double>(elementsDone) / static_cast<double>(elementCount), "writing");
    };
    document_ = encodeScene(std::move(scene_), options_, recordings_, sequenceOptions_, files, report_, done);
    report_.colorError += roundingOfColors_;
  }

  /// Writes the textures and adds the appearances and nodes that the source lacks. An X3D source is complete.
  void completeScene() {
    if (!document_.graph.isComplete)
      assignDefaultAppearances(document_);
    ContentFiles files(site_.path(), textureFolder);
    report_.textures = writeTextures(document_.graph, options_, files, report_.warnings);
    if (!document_.graph.isComplete)
      addDefaultNodes(document_, options_.view, viewSamples_, report_.warnings);
  }

  void writeDocuments() {
    writeInlinedDocuments(document_, options_.target, site_.path());
    warnOfCollapsed(report_);
    const PagePictures pictures =
        options_.pictures ? writePictures(document_.graph, pictureSamples_, site_.path()) : PagePictures{};
    writeFile(site_.path() / manifestName, asBytes(writeManifest(manifest(pictures))));
    if (options_.target == Target::x3dom) {
      const X3domRelease release = x3domReleaseFor(*options_.encoding, options_.x3domUrl);
      report_.x3domVersion = release.version;
      report_.x3domUrl = release.files.scriptUrl;
      writeX3domPages(document_, release, pictures, site_.path());
    } else {
      writePages(document_, pictures, site_.path());
    }
  }

  /// Reads the written documents back, for the sizes of files and for warnings about malformed documents.
  void inspectSite() {
    const SiteInfo written = inspect(site_.path());
    report_.roles = sumByRole(written.files);
    report_.bytesPerTriangle = written.bytesPerTriangle;
    if (options_.strict && !written.warnings.empty())
      throw Error(ErrorKind::malformed, locationOf(input_), withoutFullStop(written.warnings.front()));
    std::ranges::copy(written.warnings, std::back_inserter(report_.warnings));
    report_.encodeSeconds = step_.lapSeconds();
  }

  void precompress() {
    if (!options_.precompress)
      return;
    reportProgress(0.995, "compressing");
    report_.precompressed = precompressSite(site_.path());
    report_.precompressSeconds = step_.lapSeconds();
  }

  void publish() {
    reportProgress(1, "publishing");
    site_.publish();
    if (ranks_) {
      ranks_->leave([&] { reportProgress(1, "publishing"); });
      ranks_->removeWork();
    }
    report_.totalSeconds = total_.lapSeconds();
    report_.peakMemoryBytes = peakMemoryBytes();
  }

  ConvertReport takeReport() { return std::move(report_); }

  /// Tells the other ranks why this one ends.
  void tellOthers(const std::string& sentence) {
    if (ranks_)
      ranks_->fail(sentence);
  }

private:
  /// The frames of several files.
  void recordFiles(const ImportOptions& importOptions) {
    const auto files = std::make_shared<FrameFiles>(frames_, scene_, importOptions);
    report_.sourceBytes = files->bytes();
    recordings_.push_back(recordingOfFiles(scene_.graph, files, options_.rate));
  }

  /// Reads all frames, for what they have in common.
  void surveyRecordings() {
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

  void reportProgress(double fraction, const std::string& step) const {
    if (progress_)
      progress_(source_ ? levelShare + (1 - levelShare) * fraction : fraction, step);
  }

  /// Builds the levels of a mesh that memory does not hold. Returns what stands in for it in all further steps.
  Imported buildLarge(const ImportOptions& importOptions) {
    const ConvertOptions options = outOfCoreOptions(options_);
    report_.sourceBytes = source_->fileBytes();
    ranks_ = openRanks(input_, workFolder_, options, progress_);
    ContentFiles files(site_.path(), geometryFolder);
    large_ = buildOutOfCore(*source_, importOptions, options, *ranks_, files, progressOutOfCore(progress_));
    if (ranks_->count() > 1)
      report_.tasks = large_->tasks, report_.tasksTaken = ranks_->tasksTaken();
    return std::move(large_->coarse);
  }

  /// Leaves out what X3DOM does not read.
  void leaveOutTexCoords() {
    const auto [meshes, textures] = keepFirstTexCoords(scene_);
    hasOnlyFirstTexCoords_ = meshes > 0;
    if (hasOnlyFirstTexCoords_)
      report_.warnings.push_back(
          fmt::format("X3DOM reads one set of texture coordinates: the others of {} are left out, and with them {}",
                      counted(meshes, "mesh", "meshes"), counted(textures, "texture", "textures")));
  }

  void leaveOutFogDepths() {
    std::size_t meshes = 0;
    for (Mesh& mesh : scene_.meshes)
      meshes += std::erase_if(mesh.namedAttributes,
                              [](const NamedAttribute& attribute) { return attribute.name == fogDepthName; });
    if (meshes > 0)
      report_.warnings.push_back(
          fmt::format("X3DOM reads no depths in fog: those of {} are left out", counted(meshes, "mesh", "meshes")));
  }

  void leaveOutDeformations() {
    const std::size_t meshes = removeDeformations(scene_);
    if (meshes > 0)
      report_.warnings.push_back(
          fmt::format("X3DOM reads no joints and displacements of these geometries: {} {} at rest",
                      counted(meshes, "mesh", "meshes"), meshes == 1 ? "stays" : "stay"));
  }

  /// The names of all sets of texture coordinates; glTF's for a set without a name.
  std::set<std::string> texCoordNames() const {
    std::set<std::string> names;
    for (const GeometryDescription& geometry : document_.geometries)
      for (const std::string& name : geometry.texCoordMappings)
        names.insert(name.empty() ? attributeRow<VertexRole::texCoord>.gltfName : name);
    return names;
  }

  SiteManifest manifest(const PagePictures& pictures) const {
    std::map<std::string, std::string> pictureContents;
    for (const std::string& url : {pictures.iconUrl, pictures.pictureUrl})
      if (!url.empty())
        pictureContents[url] = contentName(readFile(site_.path() / url));
    std::vector<std::string> attributeNames;
    for (const AttributeReport& attribute : report_.attributes)
      attributeNames.push_back(attribute.name);
    if (options_.keepAttributes.all)
      std::ranges::copy(texCoordNames(), std::back_inserter(attributeNames));
    return {.generator = fmt::format("imgeo {}", version()),
            .source = input_ == "-" ? "" : input_.filename().string(),
            .encoding = *options_.encoding,
            .primitives = options_.primitives,
            .normalsComputed = report_.normalsComputed,
            .normalWeighting = options_.normalWeighting,
            .elements = report_.elements,
            .normalErrorDegrees = hasStatedError(options_) ? report_.normalErrorDegrees : 0,
            .axes = report_.axes.axes,
            .dropped = options_.dropped,
            .colorBits = report_.hasColors ? options_.colorBits : 8,
            .attributes = std::move(attributeNames),
            .sequenceRate = recordings_.empty() || frames_.size() > 1 ? 0 : options_.rate,
            .onlyLongSequences = !recordsAll(options_),
            .onlyFirstTexCoords = hasOnlyFirstTexCoords_,
            .sourceTextureBytes = report_.textures.sourceBytes,
            .pictures = std::move(pictureContents)};
  }

  fs::path input_;
  std::vector<fs::path> frames_;
  ConvertOptions options_;
  const Progress& progress_;
  std::unique_ptr<ChunkedSource> source_; ///< of a mesh that memory does not hold
  StagedSite site_;
  fs::path workFolder_;
  std::unique_ptr<Ranks> ranks_;   ///< of a conversion out of core
  std::optional<LargeMesh> large_; ///< its levels, when they have been built
  ConvertReport report_;
  Stopwatch total_, step_;
  bool hasOnlyFirstTexCoords_ = false;
  double roundingOfColors_ = 0; ///< before they are encoded
  Scene scene_;                 ///< until encodeMeshes
  std::vector<Recording> recordings_;
  ConvertOptions sequenceOptions_; ///< for their meshes
  PictureSamples pictureSamples_;  ///< from sampleSurfaces on
  ViewSamples viewSamples_;        ///< from sampleSurfaces on
  SceneDocument document_;         ///< from encodeMeshes on
};

} // namespace

namespace {

ConvertReport run(const std::vector<fs::path>& inputs, const fs::path& directory, const ConvertOptions& options,
                  const Progress& progress) {
  resolved(options); // refuses contradictions before anything is written
  if (options.ranks.rank >= options.ranks.count)
    refuseOption("--rank", fmt::format("{} ranks have the numbers 0 to {}", options.ranks.count,
                                       std::max(options.ranks.count, 1u) - 1));
  if (options.ranks.count > 1 && inputs.size() > 1)
    refuseOption("--ranks", "the frames of a sequence are converted by one process");
  if (recordsAll(options))
    requireSequenceOptions(options);
  for (const fs::path& input : inputs)
    if (input != "-")
      requireOutside(input, directory);

  std::unique_ptr<ChunkedSource> source;
  if (inputs.size() == 1)
    source = chooseOutOfCore(inputs.front(), directory, options);
  if (source)
    requireOutside(workFolderOf(directory, options), directory);
  if (options.ranks.rank > 0)
    return convertShare(inputs.front(), directory, options, progress, source.get());
  Conversion conversion(inputs, directory, options, progress, std::move(source));
  try {
    conversion.readSource();
    conversion.resolveOptions();
    conversion.prepareMeshes();
    conversion.sampleSurfaces();
    conversion.encodeMeshes();
    conversion.completeScene();
    conversion.writeDocuments();
    conversion.inspectSite();
    conversion.precompress();
    conversion.publish();
  } catch (const Error& error) {
    conversion.tellOthers(error.what());
    throw;
  } catch (...) {
    conversion.tellOthers(interruptedRank);
    throw;
  }
  return conversion.takeReport();
}

} // namespace

ConvertReport convert(const fs::path& input, const fs::path& directory, const ConvertOptions& options,
                      const Progress& progress) {
  return run({input}, directory, options, progress);
}

ConvertReport convertSequence(const std::vector<fs::path>& frames, const fs::path& directory,
                              const ConvertOptions& options, const Progress& progress) {
  if (frames.empty())
    throw Error(ErrorKind::usage, "", "a sequence has no frames");
  return run(frames, directory, frames.size() > 1 ? optionsForFiles(frames, options) : options, progress);
}

} // namespace imgeo
