#pragma once
// Numbers of a source as people would write them: documents are read by people too,
// and what stands in a thousand places is written a thousand times.

#include "scene/transform.h"

namespace imgeo {

/// A number that single precision holds, with the fewest digits that mean it there
/// (0.3, not 0.30000001192092896); any other to `digits`, behind which is only what
/// computing has left. Off by less than the last bit of single precision where
/// `digits` are 8 or more.
double rounded(double value, int digits);

/// Where it moves things to 12 digits, since places may be far from the origin; how it
/// turns and stretches them to 8.
Transform rounded(const Transform& transform);

} // namespace imgeo
