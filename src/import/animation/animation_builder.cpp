#include "import/animation/animation_builder.h"

#include "import/text/rounded_decimal.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <span>

namespace imgeo {

namespace {

using Numbers = std::vector<double>;

/// Fields of X3D's nodes, in the order of AnimatedField.
constexpr const char* fieldNames[] = {"translation", "rotation", "scale", "weight"};

InterpolatorKind interpolatorKindOf(AnimatedField field) {
  switch (field) {
  case AnimatedField::rotation:
    return InterpolatorKind::orientation;
  case AnimatedField::weights:
    return InterpolatorKind::scalar;
  case AnimatedField::translation:
  case AnimatedField::scale:
    break;
  }
  return InterpolatorKind::position;
}

double dot(const Numbers& a, const Numbers& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

void normalize(Numbers& v) {
  const double size = std::sqrt(dot(v, v));
  for (double& number : v)
    number = size > 0 ? number / size : number;
}

/// The curve of a channel.
class Curve {
public:
  Curve(AnimatedField field, const AnimationKeys& keys) : isRotation_(field == AnimatedField::rotation), keys_(keys) {}

  /// The value of key i.
  Numbers key(std::size_t i) const {
    const bool isSpline = keys_.interpolation == KeyInterpolation::cubicSpline;
    Numbers value = numbers(isSpline ? 3 * i + 1 : i);
    if (isRotation_)
      normalize(value);
    return value;
  }

  /// The value between keys i and i + 1, at a fraction of the time from one to the other (glTF 2.0, appendix C).
  Numbers at(std::size_t i, double t) const {
    const double seconds = keys_.seconds[i + 1] - keys_.seconds[i], t2 = t * t, t3 = t2 * t;
    const Numbers before = numbers(3 * i + 1), out = numbers(3 * i + 2), in = numbers(3 * i + 3),
                  after = numbers(3 * i + 4);
    Numbers value(before.size());
    for (std::size_t c = 0; c < value.size(); ++c)
      value[c] = (2 * t3 - 3 * t2 + 1) * before[c] + seconds * (t3 - 2 * t2 + t) * out[c] +
                 (-2 * t3 + 3 * t2) * after[c] + seconds * (t3 - t2) * in[c];
    if (isRotation_)
      normalize(value);
    return value;
  }

  /// How far `a` is from `b`: an angle, or the largest difference of a component.
  double difference(const Numbers& a, const Numbers& b) const {
    if (isRotation_)
      return 2 * std::acos(std::min(1.0, std::abs(dot(a, b))));
    double largest = 0;
    for (std::size_t c = 0; c < a.size(); ++c)
      largest = std::max(largest, std::abs(a[c] - b[c]));
    return largest;
  }

  /// What an X3D interpolator has between two keys.
  Numbers between(const Numbers& a, const Numbers& b, double t) const {
    double from = 1 - t, to = t;
    if (isRotation_) {
      const double cosine = dot(a, b), angle = std::acos(std::min(1.0, std::abs(cosine)));
      if (angle > 1e-6) {
        from = std::sin((1 - t) * angle) / std::sin(angle);
        to = std::sin(t * angle) / std::sin(angle);
      }
      to = cosine < 0 ? -to : to;
    }
    Numbers value(a.size());
    for (std::size_t c = 0; c < a.size(); ++c)
      value[c] = from * a[c] + to * b[c];
    return value;
  }

  double tolerance() const {
    if (isRotation_)
      return resampledAngle;
    double extent = 0;
    const Numbers first = key(0);
    for (std::size_t i = 0; i + 1 < keys_.seconds.size(); ++i)
      for (const double t : {0.25, 0.5, 0.75, 1.0})
        extent = std::max(extent, difference(first, at(i, t)));
    return resampledTolerance * extent;
  }

private:
  Numbers numbers(std::size_t i) const {
    const auto begin = keys_.values.begin() + static_cast<std::ptrdiff_t>(i * keys_.components);
    return {begin, begin + static_cast<std::ptrdiff_t>(keys_.components)};
  }

  bool isRotation_;
  const AnimationKeys& keys_;
};

/// Collects the keys of an X3D interpolator.
class InterpolatorKeys {
public:
  InterpolatorKeys(AnimatedField field, double duration)
      : isRotation_(field == AnimatedField::rotation), duration_(duration) {
    interpolator.kind = interpolatorKindOf(field);
  }

  void add(double seconds, const Numbers& value) {
    interpolator.keys.push_back(static_cast<float>(duration_ > 0 ? std::min(1.0, seconds / duration_) : 0));
    if (isRotation_) {
      const Rotation rotation = rotationOfQuaternion(value[0], value[1], value[2], value[3]);
      for (const double number : {rotation.axis.x, rotation.axis.y, rotation.axis.z, rotation.angle})
        addNumber(number);
    } else
      for (const double number : value)
        addNumber(number);
  }

  Interpolator interpolator;

private:
  void addNumber(double number) { interpolator.values.push_back(static_cast<float>(rounded(number, 7))); }

  bool isRotation_;
  double duration_;
};

/// Adds keys between key i and i + 1 of a spline, where those around them do not meet the tolerance.
void addBetween(const Curve& curve, std::size_t i, double from, const Numbers& fromValue, double to,
                const Numbers& toValue, double tolerance, int depth, const auto& add) {
  constexpr int maxDepth = 8;
  double largest = 0;
  for (const double t : {0.25, 0.5, 0.75})
    largest =
        std::max(largest, curve.difference(curve.at(i, from + t * (to - from)), curve.between(fromValue, toValue, t)));
  if (largest <= tolerance || depth == maxDepth)
    return;
  const double middle = (from + to) / 2;
  const Numbers value = curve.at(i, middle);
  addBetween(curve, i, from, fromValue, middle, value, tolerance, depth + 1, add);
  add(i, middle, value);
  addBetween(curve, i, middle, value, to, toValue, tolerance, depth + 1, add);
}

} // namespace

Interpolator interpolatorOf(AnimatedField field, const AnimationKeys& keys, double duration) {
  const Curve curve(field, keys);
  InterpolatorKeys written(field, duration);
  const bool isSpline = keys.interpolation == KeyInterpolation::cubicSpline;
  const double tolerance = isSpline ? curve.tolerance() : 0;
  for (std::size_t i = 0; i < keys.seconds.size(); ++i) {
    if (i > 0 && keys.interpolation == KeyInterpolation::step)
      written.add(keys.seconds[i], curve.key(i - 1));
    if (i > 0 && isSpline)
      addBetween(curve, i - 1, 0, curve.key(i - 1), 1, curve.key(i), tolerance, 0,
                 [&](std::size_t key, double t, const Numbers& value) {
                   written.add(std::lerp(keys.seconds[key], keys.seconds[key + 1], t), value);
                 });
    written.add(keys.seconds[i], curve.key(i));
  }
  return std::move(written.interpolator);
}

void AnimationBuilder::begin(const std::string& name, double seconds) {
  name_ = name.empty() ? "animation" : name;
  seconds_ = seconds;
  sensor_.reset();
  interpolators_.clear();
}

/// The animation's TimeSensor.
std::size_t AnimationBuilder::sensor() {
  if (sensor_)
    return *sensor_;
  TimeSensor sensor;
  sensor.cycleInterval = seconds_ > 0 ? rounded(static_cast<float>(seconds_), 9) : 1;
  sensor.loop = true;
  sensor.enabled = !hasPlaying_;
  hasPlaying_ = true;
  sensor_ = addRoot(graph_, {name_, sensor, {}, ""});
  return *sensor_;
}

/// Whether a node is not a group, or has a descendant that is not: a Shape, a light or a Viewpoint, which its movement
/// affects. Joints move vertices.
bool AnimationBuilder::showsAnything(std::size_t node) {
  const auto [found, isNew] = showsAnything_.try_emplace(node);
  if (isNew) {
    const NodeContent& content = graph_.nodes[node].content;
    const Transform* transform = std::get_if<Transform>(&content);
    const bool isGroup = std::holds_alternative<Group>(content) || (transform && !transform->isJoint);
    found->second = !isGroup || std::ranges::any_of(graph_.nodes[node].children,
                                                    [&](std::size_t child) { return showsAnything(child); });
  }
  return showsAnything_[node];
}

std::size_t AnimationBuilder::interpolatorOf(std::size_t node, AnimatedField field, const AnimationKeys& keys,
                                             const void* source) {
  if (const auto found = interpolators_.find({source, field}); source && found != interpolators_.end())
    return found->second;
  const std::size_t clock = sensor();
  const std::string& name = graph_.nodes[node].name;
  const std::size_t index =
      addRoot(graph_, {fmt::format("{}-{}", name.empty() ? "node" : name, fieldNames[static_cast<std::size_t>(field)]),
                       imgeo::interpolatorOf(field, keys, seconds_),
                       {},
                       ""});
  graph_.routes.push_back({clock, "fraction_changed", index, "set_fraction"});
  if (source)
    interpolators_[{source, field}] = index;
  return index;
}

void AnimationBuilder::animate(std::size_t node, AnimatedField field, const AnimationKeys& keys, const void* source) {
  if (!showsAnything(node))
    return;
  const std::size_t interpolator = interpolatorOf(node, field, keys, source);
  graph_.routes.push_back({interpolator, "value_changed", node, fieldNames[static_cast<std::size_t>(field)]});
}

} // namespace imgeo
