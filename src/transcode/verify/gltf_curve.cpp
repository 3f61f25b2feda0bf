#include "transcode/verify/gltf_curve.h"

#include "scene/transform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace imgeo {

namespace {

using Numbers = std::vector<double>;

bool isRotation(const GltfCurve& curve) {
  return curve.interpolator && curve.interpolator->kind == InterpolatorKind::orientation;
}

/// The value at a time; of a rotation its quaternion.
Numbers valueAt(const GltfCurve& curve, double seconds) {
  if (!curve.interpolator)
    return {curve.constant};
  Numbers value = valueAt(*curve.interpolator, seconds / curve.seconds);
  if (isRotation(curve)) {
    const std::array<double, 4> quaternion = quaternionOf({{value[0], value[1], value[2]}, value[3]});
    return {quaternion.begin(), quaternion.end()};
  }
  for (std::size_t i = 0; i < value.size() && i < 3; ++i)
    value[i] += curve.offset[static_cast<int>(i)];
  return value;
}

double dot(const Numbers& a, const Numbers& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += a[i] * b[i];
  return sum;
}

/// The largest difference of a component. A quaternion and its negative are the same rotation.
double distance(const Numbers& a, const Numbers& b, bool areRotations) {
  const double sign = areRotations && dot(a, b) < 0 ? -1 : 1;
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(a[i] - sign * b[i]));
  return largest;
}

double largestOf(const Numbers& value) {
  double largest = 1;
  for (const double number : value)
    largest = std::max(largest, std::abs(number));
  return largest;
}

/// The times of the keys of both, in order.
Numbers keyTimes(const GltfCurve& a, const GltfCurve& b) {
  Numbers times{0};
  for (const GltfCurve* curve : {&a, &b})
    for (std::size_t i = 0; curve->interpolator && i < curve->interpolator->keys.size(); ++i)
      times.push_back(curve->interpolator->keys[i] * curve->seconds);
  std::ranges::sort(times);
  times.push_back(times.back() + 1); // the last values hold on
  return times;
}

} // namespace

bool areEqualCurves(const GltfCurve& a, const GltfCurve& b) {
  const bool areRotations = isRotation(a);
  if (areRotations != isRotation(b))
    return false;
  const Numbers times = keyTimes(a, b);
  // Numbers of glTF are single floats, those of documents have seven digits.
  constexpr double rounding = 1e-6;
  const double roundedTime = rounding * times.back();
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const double from = times[i], length = times[i + 1] - from;
    if (length <= 2 * roundedTime)
      continue; // the same key of both, or a step
    const auto isEqualAt = [&](double t, double slack) {
      const Numbers left = valueAt(a, from + t * length), right = valueAt(b, from + t * length);
      return distance(left, right, areRotations) <= slack + rounding * largestOf(left);
    };
    // Both are linear in between, so that two values decide.
    const double first = std::max(1e-3, roundedTime / length);
    const Numbers begin = valueAt(a, from + first * length), end = valueAt(a, from + (1 - first) * length);
    // Which way half a turn goes is a matter of rounding.
    const bool isHalfTurn = areRotations && std::abs(dot(begin, end)) < 0.01;
    const double change = distance(begin, end, areRotations);
    const double slack = isHalfTurn ? 4 * first : change * roundedTime / length;
    for (const double t : isHalfTurn ? std::array{first, 1 - first} : std::array{0.25, 0.75})
      if (!isEqualAt(t, slack))
        return false;
  }
  return true;
}

} // namespace imgeo
