#pragma once
// A shape whose vertices move from frame to frame, before its frames are encoded.

#include "transcode/source/frame_source.h"

#include <memory>

namespace imgeo {

struct Recording {
  std::size_t shape = 0;        ///< index into SceneGraph::nodes
  std::size_t interpolator = 0; ///< a child of the Shape, whose url will name the frames
  std::shared_ptr<const FrameSource> frames;
  double rate = 0;       ///< frames per second, at most 1000
  bool hasVideo = false; ///< the source has a lossless video of the frames
  FrameSurvey survey = {};
};

/// The rate of frames that last some seconds, of which there is at least one.
double rateOf(const FrameSource& frames, double seconds);

/// The number of steps as an integer. Throws Error{limit} where they are more than a sequence has frames.
std::size_t requireSteps(double steps, double seconds);

} // namespace imgeo
