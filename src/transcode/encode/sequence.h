#pragma once
// Encodes the frames of a sequence: a static mesh in SIG classic, which is its first frame, and files of frames beside
// it (docs/formats/sequence.md).

#include "documents/documents.h"
#include "imgeo/convert.h"
#include "transcode/encode/encode_mesh.h"
#include "transcode/source/frame_files.h"

namespace imgeo {

/// Writes the static files and the frames of the only mesh of `scene`, which has been prepared, and adds a TimeSensor,
/// an interpolator with the frames, and the route between them. `done` gets numbers of frames. Deterministic. Throws
/// Error for frames that cannot be read, {limit} for meshes that are no single patch, {usage} for frames without
/// extent.
SceneDocument encodeSequence(Scene&& scene, const FrameFiles& frames, const FrameSurvey& survey,
                             const ConvertOptions& options, ContentFiles& files, ConvertReport& report,
                             const ElementsDone& done);

} // namespace imgeo
