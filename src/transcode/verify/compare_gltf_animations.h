#pragma once
// Compares what glTF can express of a site's animations with those of a glTF file: an export of the site has no other
// interpolators, routes and sensors, and states an interpolator again for each node that it moves.

#include "documents/documents.h"
#include "transcode/verify/findings.h"

#include <cstddef>

namespace imgeo {

/// What a site has of animations that glTF cannot express: how many.
struct BeyondGltf {
  std::size_t routes = 0, interpolators = 0;
  std::size_t timeSensors = 0; ///< that drive no channel of glTF
  std::size_t clocks = 0;      ///< that drive some, and whose fields are not as importers set those of glTF
};

/// Compares values over time of each field of each instance of a Transform that has shapes or is a joint, and weights
/// of displacers. Adds a finding for animations that are not in the input, and for those that are not in the site.
BeyondGltf compareGltfAnimations(const SceneDocument& site, const SceneGraph& input, Findings& findings);

} // namespace imgeo
