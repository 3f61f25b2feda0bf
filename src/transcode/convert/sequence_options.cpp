#include "transcode/convert/sequence_options.h"

#include "base/error.h"
#include "containers/option_checks.h"
#include "transcode/source/preparation.h"
#include "transcode/source/recordings.h"

#include <algorithm>

namespace imgeo {

namespace fs = std::filesystem;

bool recordsAll(const ConvertOptions& options) {
  return options.form == MeshForm::sequence || options.form == MeshForm::video;
}

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

ConvertOptions ofSequences(ConvertOptions options) {
  options.encoding = Encoding::classic;
  options.form = MeshForm::mesh;
  return options;
}

ConvertOptions optionsForFiles(const std::vector<fs::path>& frames, const ConvertOptions& options) {
  if (std::ranges::find(frames, fs::path("-")) != frames.end())
    throw Error(ErrorKind::usage, "-", "standard input is one file; a sequence has one for each frame");
  if (options.encoding.value_or(Encoding::classic) != Encoding::classic)
    refuseOption("--profile", "the static files of a sequence are SIG classic");
  if (options.creaseDegrees)
    refuseOption("--crease-angle", "the frames of a sequence have smooth normals where the files have none");
  if (options.form == MeshForm::geometryImage || options.form == MeshForm::heightMap)
    refuseOption("--as", "the frames of a sequence are meshes, or a video");
  requireSequenceOptions(options);
  ConvertOptions ofFiles = ofSequences(options);
  ofFiles.form = options.form;
  return ofFiles;
}

RecordingChoice recordingChoice(const ConvertOptions& options) {
  RecordingChoice choice{.rate = options.rate, .all = recordsAll(options), .files = true};
  const bool allowsSequences = options.encoding.value_or(Encoding::classic) != Encoding::bg &&
                               options.target != Target::x3dom && options.primitives == Primitives::triangles &&
                               options.indexed && options.form == MeshForm::mesh;
  if (allowsSequences)
    choice.minBytes = longKeyValueBytes;
  return choice;
}

} // namespace imgeo
