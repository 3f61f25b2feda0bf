#pragma once
// Encodes the frames of a sequence: a static mesh in SIG classic, which is its first frame, and files of frames beside
// it (docs/formats/sequence.md).

#include "imgeo/convert.h"
#include "sequence/sequence_index.h"
#include "transcode/encode/encode_mesh.h"
#include "transcode/source/recordings.h"

#include <string>

namespace imgeo {

/// The files of the frames. `video` is empty where there is none.
struct EncodedFrames {
  SequenceIndex index;
  std::string url, video;
  std::uint64_t videoBytes = 0;
};

struct EncodedSequence {
  EncodedMesh still; ///< the first frame
  EncodedFrames frames;
};

/// Writes the static files and the frames of a prepared mesh whose vertices have been numbered. `options`: those of SIG
/// classic. `done` gets numbers of frames. Deterministic. Throws Error for frames that cannot be read, {limit} for
/// meshes that are no single patch, {usage} for frames without extent.
EncodedSequence encodeSequence(Mesh mesh, const Recording& recording, const ConvertOptions& options,
                               ContentFiles& files, const ElementsDone& done);

} // namespace imgeo
