#pragma once
// Lists of coordinates and normals that interpolators of a document hold, as frames of a sequence.

#include "scene/scene.h"
#include "transcode/source/recording.h"

#include <vector>

namespace imgeo {

/// Makes a Recording, without a survey, of every shape that has an interpolator with points (Interpolator::points). The
/// shape gets the mesh of the first frame; the interpolator loses its keys and keeps its routes. Where the keys are
/// equally far apart, each of them is a frame (recordedSteps); without a TimeSensor the frames are the keys. The last
/// frame is left out where it equals the first. Throws Error{limit} for more than maxSequenceFrames.
std::vector<Recording> recordInterpolators(Scene& scene, double rate);

} // namespace imgeo
