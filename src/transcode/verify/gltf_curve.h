#pragma once
// The values over time that a channel of glTF has, of an interpolator or of another one that is to equal it.

#include "base/vec.h"
#include "scene/animation.h"

#include <vector>

namespace imgeo {

/// What an interpolator sets in the time of a cycle of its TimeSensor.
struct GltfCurve {
  const Interpolator* interpolator = nullptr; ///< null: it is constant
  double seconds = 1;                         ///< of the cycle
  Vec3d offset{};                             ///< added to positions
  double constant = 0;
};

/// Whether two curves have the same values at each time, within the rounding of glTF's numbers. Keys may be others.
bool areEqualCurves(const GltfCurve& a, const GltfCurve& b);

} // namespace imgeo
