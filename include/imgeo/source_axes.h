#pragma once
/// @file
/// How the coordinates of a source become those of a document, whose y axis points up and whose unit is the metre.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace imgeo {

/// A direction along a coordinate axis.
enum class AxisDirection : std::uint8_t { x, y, z, minusX, minusY, minusZ };

/// "x", "y", "z", "-x", "-y", "-z".
const char* nameOf(AxisDirection direction);

/// A rotation about a coordinate axis.
struct AxisRotation {
  int axis = 0;       ///< 0: x, 1: y, 2: z
  double degrees = 0; ///< counterclockwise seen from the axis's positive end
  /// Whether all members are equal.
  friend bool operator==(const AxisRotation&, const AxisRotation&) = default;
};

/// The steps from source to document coordinates, in their order: `up` becomes y, the rotations, the scale, the
/// exaggeration.
struct SourceAxes {
  AxisDirection up = AxisDirection::y;   ///< the source's direction that becomes y
  std::vector<AxisRotation> rotations{}; ///< about the document's axes, the first one first
  double scale = 1;                      ///< document units in a unit of the source
  double exaggeration = 1;               ///< factor of heights, along y
  /// Whether all members are equal.
  friend bool operator==(const SourceAxes&, const SourceAxes&) = default;
};

/// Options for the axes and the unit of a source.
struct SourceAxesOptions {
  std::optional<AxisDirection> up{};     ///< nothing: what the format says, otherwise a guess by the shape
  std::vector<AxisRotation> rotations{}; ///< see SourceAxes
  double scale = 1;                      ///< a factor, greater than 0
  double exaggeration = 1;               ///< a factor of heights, greater than 0
  std::optional<double> metres{};        ///< length of the source's unit; nothing: what the file says, otherwise 1
};

/// The axes of a conversion, and why they were chosen.
struct SourceAxesReport {
  SourceAxes axes{};        ///< the steps from source to document coordinates
  std::string upReason{};   ///< "stated", "by the format", or for a guess what it follows from
  bool isGuess = false;     ///< `axes.up` was guessed
  std::string unitReason{}; ///< likewise; "not stated" if the source's numbers count as metres
};

} // namespace imgeo
