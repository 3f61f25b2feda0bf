#include "transcode/node_geometry/prepare_as.h"

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

} // namespace imgeo
