#include "transcode/verify/prepare_input.h"

#include "transcode/source/preparation.h"

namespace imgeo {

namespace {

/// What convert() recorded.
RecordingChoice recordingsOf(const SiteManifest& manifest) {
  RecordingChoice choice{.files = true};
  if (manifest.sequenceRate > 0) {
    choice.rate = manifest.sequenceRate;
    choice.all = !manifest.onlyLongSequences;
    if (manifest.onlyLongSequences)
      choice.minBytes = longKeyValueBytes;
  }
  return choice;
}

} // namespace

ImportOptions importOptionsFor(const std::optional<SiteManifest>& manifest, bool outside) {
  ImportOptions options;
  options.outside = outside;
  options.inlineBytes = inlineBytes;
  if (manifest) {
    options.attributes.names = {manifest->attributes.begin(), manifest->attributes.end()};
    options.recordings = recordingsOf(*manifest);
    options.creaseDegrees = manifest->creaseDegrees;
    options.smoothsUnstated = !manifest->guessesCreases;
  }
  return options;
}

void prepareAs(const SiteManifest& manifest, Scene& scene, const std::string& location) {
  prepareScene(scene,
               {.dropped = manifest.dropped,
                .weighting = manifest.normalWeighting,
                .flatWithoutNormals = manifest.flatWithoutNormals,
                .byteColors = manifest.colorBits <= 8},
               location);
  if (manifest.onlyFirstTexCoords)
    keepFirstTexCoords(scene);
}

Imported preparedInput(const std::filesystem::path& input, const std::optional<SiteManifest>& manifest, bool outside,
                       std::vector<Recording>& recordings) {
  std::uint64_t bytes = 0;
  const ImportOptions options = importOptionsFor(manifest, outside);
  Imported imported = importInput(input, options, bytes);
  if (manifest) {
    recordings = recordScene(imported.scene, options.recordings.rate, options.recordings.all, locationOf(input),
                             imported.warnings);
    prepareAs(*manifest, imported.scene, locationOf(input));
    return imported;
  }
  std::vector<bool> hadNormals;
  for (const Mesh& mesh : imported.scene.meshes)
    hadNormals.push_back(!mesh.normals.empty());
  prepareScene(imported.scene, {.byteColors = false}, locationOf(input));
  for (std::size_t i = 0; i < hadNormals.size(); ++i)
    if (!hadNormals[i])
      imported.scene.meshes[i].normals.clear();
  return imported;
}

} // namespace imgeo
