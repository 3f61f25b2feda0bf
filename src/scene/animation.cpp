#include "scene/animation.h"

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

std::string faultOf(const Interpolator& interpolator) {
  const auto& [kind, keys, values, url, video] = interpolator;
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
