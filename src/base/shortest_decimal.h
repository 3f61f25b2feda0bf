#pragma once
// Numbers for documents, which say no more than they have to.

namespace imgeo {

/// The number with the fewest significant digits that is off from `value` by no more than
/// `tolerance`; never -0.
double shortestWithin(double value, double tolerance);

} // namespace imgeo
