#pragma once
// Animations of vertices that a scene holds as joints, displacements or lists of coordinates, as frames of a sequence.

#include "import/import.h"
#include "transcode/source/frame_source.h"

#include <memory>
#include <string>
#include <vector>

namespace imgeo {

/// A shape whose vertices move from frame to frame.
struct Recording {
  std::size_t shape = 0;        ///< index into SceneGraph::nodes
  std::size_t interpolator = 0; ///< a child of the Shape, whose url will name the frames
  std::shared_ptr<const FrameSource> frames;
  double rate = 0; ///< frames per second
  FrameSurvey survey;
};

/// Makes a Recording, without a survey, of every shape that animations of joints and displacers deform. The shape gets
/// the mesh of its first frame, and the interpolator, to which the animation's TimeSensor is routed; joints and
/// displacers lose their part in all shapes. There are about `rate` frames a second: the first and the last moment of
/// the animation are frames, unless they are equal: then it has the first one only. Of several animations the first
/// that is enabled counts, with a warning. Throws Error{unsupported} with `location` if there is no such shape, and
/// Error{limit} for more than maxSequenceFrames.
std::vector<Recording> recordDeformations(Scene& scene, double rate, const std::string& location,
                                          std::vector<std::string>& warnings);

/// Adds the TimeSensor, the interpolator and the route that play the frames of a scene's only shape.
Recording recordingOfFiles(SceneGraph& graph, std::shared_ptr<const FrameSource> frames, double rate);

} // namespace imgeo
