#pragma once
// Animations of the vertices of a scene, as frames of sequences.

#include "import/import.h"
#include "transcode/source/recording.h"

#include <memory>
#include <string>
#include <vector>

namespace imgeo {

/// Makes a Recording, without a survey, of every shape whose vertices move: of sequences that the source refers to, of
/// interpolators with points, and, if `deformations`, of animations of joints and displacers. In the order of the
/// document. The shape gets the mesh of its first frame, and the interpolator, to which the animation's TimeSensor is
/// routed.
///
/// Joints and displacers lose their part in all shapes. There are about `rate` frames a second: the first and the last
/// moment of the animation are frames, unless they are equal: then it has the first one only. Of several animations the
/// first that is enabled counts, with a warning. Throws Error for sequences that cannot be read, and Error{limit} for
/// more than maxSequenceFrames; if `deformations`, Error{unsupported} with `location` where no vertices move.
std::vector<Recording> recordScene(Scene& scene, double rate, bool deformations, const std::string& location,
                                   std::vector<std::string>& warnings);

/// Adds the TimeSensor, the interpolator and the route that play the frames of a scene's only shape.
Recording recordingOfFiles(SceneGraph& graph, std::shared_ptr<const FrameSource> frames, double rate);

} // namespace imgeo
