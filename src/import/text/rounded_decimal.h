#pragma once
// Rounding of a source's numbers to few decimal digits, so that documents are short and readable.

#include "scene/transform.h"

namespace imgeo {

/// A number that single precision represents is rounded to its shortest single-precision decimal (0.3, not
/// 0.30000001192092896); any other number is rounded to `digits` significant digits. With 8 or more digits the result
/// converts to the same single-precision number.
double rounded(double value, int digits);

/// Rounds translation and center to 12 digits, since they may be far from the origin, and rotations and scales to 8.
Transform rounded(const Transform& transform);

} // namespace imgeo
