#pragma once
// Guesses which axis of a source points up, for formats that do not say it.

#include "imgeo/source_axes.h"
#include "scene/surface_samples.h"

#include <string>
#include <vector>

namespace imgeo {

struct UpGuess {
  AxisDirection up = AxisDirection::y; ///< x, y or z; y where nothing speaks for another axis
  std::string reason;                  ///< part of a sentence: "it stands on its -z side: ..."
};

/// The axis along which the samples stand upright:
/// - a thin surface that faces one side is a terrain;
/// - whatever stands has a wide foot and a narrow top: the convex hull of its lowest samples covers more of its ground
///   plan than that of its highest ones, and its centre is above its foot;
/// - what is longest between two flat ends is a column.
/// Negative directions are not guessed: such sources are rare, and a wrong guess turns a model upside down.
UpGuess guessUp(const std::vector<SurfaceSample>& samples);

} // namespace imgeo
