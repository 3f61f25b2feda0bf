#pragma once
// What a stream states once for all frames of an epoch: docs/live.md.

#include "base/vec.h"
#include "live/frame.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo::live {

struct Description {
  FrameLayout layout;
  Box3d box;                                     ///< as the publisher stated it
  std::vector<std::array<double, 2>> valueRange; ///< minimum and maximum of each value component
  double rate = 0;                               ///< frames per second that the publisher announces; 0: none
  std::string viewToken{};                       ///< that viewers state; empty: that of the server. Nobody is told it

  /// The lattice of positions: the box's minimum, and its longest edge divided by 2^positionBits - 1.
  Vec3d origin() const { return box.min; }
  double step() const;

  friend bool operator==(const Description&, const Description&) = default;
};

constexpr std::size_t maxTokenBytes = 256;

/// Throws Error{malformed, limit} with `location` unless the layout is valid, the box is finite and has an extent, each
/// value component has a finite range, the rate is 0 .. 1000, and the token has at most maxTokenBytes.
void checkDescription(const Description& description, const std::string& location);

/// The description as the fields of a JSON object, without braces and without the token: "vertices": 16384, ...
std::string describe(const Description& description);

/// Reads the JSON object that announces an epoch. Safe for untrusted text. Throws Error{malformed, limit}.
Description readDescription(std::string_view json, const std::string& location);

/// Whether a stream may have this name: 1 .. 64 of a-z A-Z 0-9 _ -
bool isStreamName(std::string_view name);

} // namespace imgeo::live
