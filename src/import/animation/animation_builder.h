#pragma once
// Writes the animations of a source as X3D's nodes: a TimeSensor each, interpolators, and routes
// (docs/decisions/animation.md).

#include "scene/scene.h"

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace imgeo {

/// What a channel of a source animates; `weights`: the weight of one Displacer.
enum class AnimatedField : std::uint8_t { translation, rotation, scale, weights };

/// How values follow from keys, with glTF's meaning: cubicSpline has an in-tangent and an out-tangent for each key.
enum class KeyInterpolation : std::uint8_t { step, linear, cubicSpline };

/// The keys of a channel.
struct AnimationKeys {
  KeyInterpolation interpolation = KeyInterpolation::linear;
  std::vector<float> seconds; ///< finite, not negative, ascending; not empty
  /// `components` for each key; for cubicSpline in-tangent, value and out-tangent. Rotations are quaternions x y z w.
  std::vector<float> values;
  std::size_t components = 3;
};

/// The greatest differences of a resampled cubicSpline from the curve: of lengths and factors relative to the extent of
/// the curve's values, of rotations in radians.
inline constexpr double resampledTolerance = 5e-4, resampledAngle = 1e-3;

class AnimationBuilder {
public:
  /// `graph` must outlive this.
  explicit AnimationBuilder(SceneGraph& graph) : graph_(graph) {}

  /// Begins an animation that takes `seconds`. It gets a TimeSensor if it moves anything. The first one of a scene that
  /// does plays by itself, the others do not.
  void begin(const std::string& name, double seconds);

  /// Animates a field of a node with these keys, unless the node has nothing below it that is seen or lights, and no
  /// joint of a skin. Channels with the same `source` share an interpolator; it may be null.
  void animate(std::size_t node, AnimatedField field, const AnimationKeys& keys, const void* source);

private:
  std::size_t sensor();
  std::size_t interpolatorOf(std::size_t node, AnimatedField field, const AnimationKeys& keys, const void* source);
  bool showsAnything(std::size_t node);

  SceneGraph& graph_;
  std::string name_;
  double seconds_ = 1;
  std::optional<std::size_t> sensor_;
  std::map<std::size_t, bool> showsAnything_; ///< by node
  bool hasPlaying_ = false;
  std::map<std::tuple<const void*, AnimatedField>, std::size_t> interpolators_; ///< of the animation
};

/// The keys as an X3D interpolator over `duration` seconds: exact but for cubicSpline, which is resampled.
Interpolator interpolatorOf(AnimatedField field, const AnimationKeys& keys, double duration);

} // namespace imgeo
