#pragma once
// Rounding of numbers that are written as decimal text.

namespace imgeo {

/// The number with the fewest significant decimal digits within `tolerance` of `value`; 0 rather than -0.
double shortestWithin(double value, double tolerance);

} // namespace imgeo
