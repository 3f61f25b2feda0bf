#pragma once
// Animation of a scene, as X3D has it (ISO/IEC 19775-1, chapters 8 and 19, and 4.4.8): a TimeSensor counts, routes take
// its fraction to interpolators, and their values to the fields of other nodes.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

/// X3D TimeSensor. Times are in seconds.
struct TimeSensor {
  double cycleInterval = 1; ///< above 0
  bool enabled = true;
  bool loop = false;
  double startTime = 0, stopTime = 0, pauseTime = 0, resumeTime = 0;
  friend bool operator==(const TimeSensor&, const TimeSensor&) = default;
};

/// The interpolators of X3D that are linear between their keys.
enum class InterpolatorKind : std::uint8_t {
  color,
  coordinate,
  coordinate2D,
  normal,
  orientation,
  position,
  position2D,
  scalar
};

struct Interpolator {
  InterpolatorKind kind = InterpolatorKind::position;
  std::vector<float> keys; ///< fractions, in ascending order; equal ones are steps
  /// componentsOf(kind) numbers for each key; for the kinds with isList() any multiple of them. An orientation is an
  /// axis and an angle in radians.
  std::vector<float> values;
  /// A CoordinateInterpolator without keys and values states the index of the sequence (sequence/sequence_index.h) that
  /// has its frames. The node is a child of the Shape whose vertices it moves.
  std::string url = {};
  /// A lossless video of the same frames (video/sequence_video.h). With one, documents have a MovieTexture in place of
  /// the CoordinateInterpolator, which names the video and, for pages that cannot decode it, the index.
  std::string video = {};
  /// For the coordinates and normals of a document that are to become the frames of a sequence, as a child of the Shape
  /// whose vertices they move: by the wedge of its mesh the number of its value. Empty for other interpolators.
  std::vector<std::uint32_t> points = {};
  /// For such coordinates of faces without normals of their own: the crease angle by which normals follow the
  /// triangles, in radians.
  std::optional<double> creaseAngle = {};
  friend bool operator==(const Interpolator&, const Interpolator&) = default;
};

/// X3D ROUTE: events of a field of one node set a field of another. Nodes are indices into SceneGraph::nodes.
struct Route {
  std::size_t fromNode = 0;
  std::string fromField;
  std::size_t toNode = 0;
  std::string toField;
  friend bool operator==(const Route&, const Route&) = default;
};

/// "PositionInterpolator" …
const char* nodeNameOf(InterpolatorKind kind);
/// The kind of an element, whose letters may be in another case; empty for another element.
std::optional<InterpolatorKind> interpolatorKindOf(std::string_view element);

/// Numbers of one value: 1 to 4.
std::size_t componentsOf(InterpolatorKind kind);
/// Whether each key has a list of values: for coordinates and normals.
bool isList(InterpolatorKind kind);

/// Steps of equal length into which a recording of an interpolator divides its cycle. Where the keys are equally far
/// apart from 0 to 1, each of them is the end of a step, and two neighbours have the number of steps between them that
/// comes closest to `rate` a second; otherwise there are `rate` a second. `seconds` for fractions from 0 to 1, above 0.
double recordedSteps(const std::vector<float>& keys, double seconds, double rate);

/// Whether keys are equally far apart from 0 to 1, within the rounding to few decimal digits.
bool areEven(const std::vector<float>& keys);

/// The numbers of a well-formed interpolator with keys at a fraction, linear between keys; of an orientation on the
/// shorter way.
std::vector<double> valueAt(const Interpolator& interpolator, double fraction);

/// What is wrong with an interpolator: "its keys are not in ascending order"; "" for one that is well formed or empty.
std::string faultOf(const Interpolator& interpolator);

} // namespace imgeo
