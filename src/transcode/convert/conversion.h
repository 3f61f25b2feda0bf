#pragma once
// A conversion and its steps.

#include "imgeo/convert.h"
#include "transcode/convert/large_conversion.h"
#include "transcode/convert/stopwatch.h"
#include "transcode/default_scene/default_nodes.h"
#include "transcode/out_of_core/small_meshes.h"
#include "transcode/picture/picture_samples.h"
#include "transcode/picture/write_pictures.h"
#include "transcode/site/site_manifest.h"
#include "transcode/site/staged_site.h"
#include "transcode/source/recordings.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace imgeo {

/// One conversion: each member function is one step of convert().
class Conversion {
public:
  /// `frames`: those of a sequence; otherwise one file.
  Conversion(const std::vector<std::filesystem::path>& frames, const std::filesystem::path& directory,
             const ConvertOptions& options, const Progress& progress, std::unique_ptr<ChunkedSource> source);

  void readSource();

  /// Fills in the options that depend on the source.
  void resolveOptions();

  /// Welds meshes, drops elements and computes missing normals.
  void prepareMeshes();

  /// Lets shapes with equal meshes share one.
  void shareEqualMeshes();

  /// Samples the surfaces for the page's pictures and the default viewpoints, before the meshes are encoded.
  void sampleSurfaces();

  /// Writes the geometry files, and adds the appearances that the source lacks. An X3D source is complete.
  void encodeMeshes();

  /// Writes the textures and adds the nodes that the source lacks.
  void completeScene();

  void writeDocuments();

  /// Reads the written documents back, for the sizes of files and for warnings about malformed documents.
  void inspectSite();

  void precompress();

  void publish();

  ConvertReport takeReport() { return std::move(report_); }

  /// Tells the other ranks why this one ends.
  void tellOthers(const std::string& sentence);

private:
  /// The frames of several files.
  void recordFiles(const ImportOptions& importOptions);

  /// Reads all frames, for what they have in common.
  void surveyRecordings();

  void reportProgress(double fraction, const std::string& step) const;

  /// Builds the levels of meshes that memory does not hold. Returns the source with what stands in for these in all
  /// further steps, and without meshes that are stored from then on.
  Imported buildLarge(const ImportOptions& importOptions);
  Imported readSmall(const ImportOptions& importOptions, const ConvertOptions& options);

  bool isLarge(std::size_t mesh) const;
  bool anyLacksNormals() const;

  /// The names of all sets of texture coordinates; glTF's for a set without a name.
  std::set<std::string> texCoordNames() const;

  SiteManifest manifest(const PagePictures& pictures) const;

  std::filesystem::path input_;
  std::vector<std::filesystem::path> frames_;
  ConvertOptions options_;
  const Progress& progress_;
  std::unique_ptr<ChunkedSource> source_; ///< of meshes that memory does not hold, until it has been read
  StagedSite site_;
  std::filesystem::path workFolder_;
  std::unique_ptr<Ranks> ranks_;      ///< of a conversion out of core
  std::vector<LargeMesh> large_;      ///< those meshes, when their levels have been built
  std::unique_ptr<MeshFiles> stored_; ///< the other meshes, where memory does not hold them together
  double shareOfLevels_ = 0;          ///< of building these in the work of the conversion
  ConvertReport report_;
  Stopwatch total_, step_;
  bool hasOnlyFirstTexCoords_ = false;
  double roundingOfColors_ = 0; ///< before they are encoded
  Scene scene_;                 ///< until encodeMeshes
  std::vector<Recording> recordings_;
  ConvertOptions sequenceOptions_; ///< for their meshes
  PictureSamples pictureSamples_;  ///< from sampleSurfaces on, until inspectSite
  ViewSamples viewSamples_;        ///< likewise
  SceneDocument document_;         ///< from encodeMeshes on, until inspectSite
};

} // namespace imgeo
