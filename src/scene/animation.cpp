#include "scene/animation.h"

#include "scene/transform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace imgeo {

namespace {

struct InterpolatorRow {
  const char* name;
  std::size_t components;
  bool isList;
};

// In the order of InterpolatorKind.
constexpr std::array<InterpolatorRow, 8> interpolatorRows{{{"ColorInterpolator", 3, false},
                                                           {"CoordinateInterpolator", 3, true},
                                                           {"CoordinateInterpolator2D", 2, true},
                                                           {"NormalInterpolator", 3, true},
                                                           {"OrientationInterpolator", 4, false},
                                                           {"PositionInterpolator", 3, false},
                                                           {"PositionInterpolator2D", 2, false},
                                                           {"ScalarInterpolator", 1, false}}};

const InterpolatorRow& rowOf(InterpolatorKind kind) {
  return interpolatorRows[static_cast<std::size_t>(kind)];
}

Rotation between(const Rotation& a, const Rotation& b, double t) {
  std::array<double, 4> from = quaternionOf(a), to = quaternionOf(b);
  double cosine = 0;
  for (std::size_t i = 0; i < 4; ++i)
    cosine += from[i] * to[i];
  const double sign = cosine < 0 ? -1 : 1, angle = std::acos(std::min(1.0, std::abs(cosine)));
  const double f = angle > 1e-6 ? std::sin((1 - t) * angle) / std::sin(angle) : 1 - t;
  const double g = sign * (angle > 1e-6 ? std::sin(t * angle) / std::sin(angle) : t);
  for (std::size_t i = 0; i < 4; ++i)
    from[i] = f * from[i] + g * to[i];
  return rotationOfQuaternion(from[0], from[1], from[2], from[3]);
}

bool equalIgnoringCase(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  return std::ranges::equal(a, b, {}, lower, lower);
}

} // namespace

const char* nodeNameOf(InterpolatorKind kind) {
  return rowOf(kind).name;
}

std::optional<InterpolatorKind> interpolatorKindOf(std::string_view element) {
  for (std::size_t i = 0; i < interpolatorRows.size(); ++i)
    if (equalIgnoringCase(interpolatorRows[i].name, element))
      return static_cast<InterpolatorKind>(i);
  return std::nullopt;
}

std::size_t componentsOf(InterpolatorKind kind) {
  return rowOf(kind).components;
}

bool isList(InterpolatorKind kind) {
  return rowOf(kind).isList;
}

bool areEven(const std::vector<float>& keys) {
  if (keys.size() < 2)
    return false;
  const auto intervals = static_cast<double>(keys.size() - 1);
  const double slack = std::min(1e-3, 0.2 / intervals);
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (std::abs(keys[i] - static_cast<double>(i) / intervals) > slack)
      return false;
  return true;
}

double recordedSteps(const std::vector<float>& keys, double seconds, double rate) {
  if (!areEven(keys))
    return std::max(1.0, std::round(seconds * rate));
  const auto intervals = static_cast<double>(keys.size() - 1);
  return intervals * std::max(1.0, std::round(seconds * rate / intervals));
}

std::vector<double> valueAt(const Interpolator& interpolator, double fraction) {
  const std::vector<float>& keys = interpolator.keys;
  const std::size_t components =
      isList(interpolator.kind) ? interpolator.values.size() / keys.size() : componentsOf(interpolator.kind);
  const auto numbers = [&](std::size_t key) {
    const auto begin = interpolator.values.begin() + static_cast<std::ptrdiff_t>(key * components);
    return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(components));
  };
  const auto after = static_cast<std::size_t>(std::ranges::upper_bound(keys, fraction) - keys.begin());
  if (after == 0 || after == keys.size())
    return numbers(after == 0 ? 0 : after - 1);
  const double t = (fraction - keys[after - 1]) / (double{keys[after]} - keys[after - 1]);
  std::vector<double> a = numbers(after - 1), b = numbers(after);
  if (interpolator.kind == InterpolatorKind::orientation) {
    const Rotation r = between({{a[0], a[1], a[2]}, a[3]}, {{b[0], b[1], b[2]}, b[3]}, t);
    return {r.axis.x, r.axis.y, r.axis.z, r.angle};
  }
  for (std::size_t c = 0; c < components; ++c)
    a[c] += t * (b[c] - a[c]);
  return a;
}

std::string faultOf(const Interpolator& interpolator) {
  const InterpolatorKind kind = interpolator.kind;
  const std::vector<float>&keys = interpolator.keys, &values = interpolator.values;
  const auto isFinite = [](float number) { return std::isfinite(number); };
  if (!std::ranges::all_of(keys, isFinite) || !std::ranges::all_of(values, isFinite))
    return "its keys or values are not all finite";
  if (!std::ranges::is_sorted(keys))
    return "its keys are not in ascending order";
  if (keys.empty() && !values.empty())
    return "it has values but no keys";
  const std::size_t perKey = componentsOf(kind);
  const bool fits = isList(kind) ? (keys.empty() || (!values.empty() && values.size() % (keys.size() * perKey) == 0))
                                 : values.size() == keys.size() * perKey;
  return fits ? "" : fmt::format("it has {} numbers in keyValue for {} keys", values.size(), keys.size());
}

} // namespace imgeo
