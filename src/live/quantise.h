#pragma once
// Turns the arrays of a publisher into the integers of a frame.

#include "live/description.h"

namespace imgeo::live {

/// Arrays of floats, vertex after vertex; empty where the layout lacks the attribute.
struct Arrays {
  std::span<const float> positions; ///< x y z
  std::span<const float> normals;   ///< x y z of any length; a normal without length becomes +z
  std::span<const float> colors;    ///< red green blue (alpha), 0..1, in sRGB
  std::span<const float> values;    ///< the components in their order
};

/// Throws Error{usage} with `location` unless each array has the numbers that the layout requires.
void checkArrays(const Arrays& arrays, const FrameLayout& layout, const std::string& location);

/// Fills frame.components. Numbers outside of their box or range are clamped, and those that are no numbers become the
/// minimum. Returns the count of both.
std::uint64_t quantise(const Arrays& arrays, const Description& description, Frame& frame);

} // namespace imgeo::live
