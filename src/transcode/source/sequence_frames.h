#pragma once
// The sequences that a source document refers to: sites are sources, too.

#include "scene/scene.h"
#include "transcode/source/recording.h"

#include <vector>

namespace imgeo {

/// Makes a Recording, without a survey, of every shape with an interpolator whose url is the path of an index. Throws
/// Error for an index that cannot be read or has another number of vertices than the shape; its FrameSource for files
/// of frames that cannot be read.
std::vector<Recording> recordedSequences(Scene& scene);

} // namespace imgeo
