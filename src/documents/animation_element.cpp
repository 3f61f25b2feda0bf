#include "documents/animation_element.h"

#include <utility>

namespace imgeo {

namespace {

std::string textOf(const std::vector<float>& values) {
  std::string text;
  for (const float value : values) {
    if (!text.empty())
      text += ' ';
    text += number(value);
  }
  return text;
}

std::vector<float> floatsOf(const std::vector<double>& numbers) {
  std::vector<float> floats;
  floats.reserve(numbers.size());
  for (const double value : numbers)
    floats.push_back(static_cast<float>(value));
  return floats;
}

} // namespace

Element interpolatorElement(const Interpolator& interpolator, const Attributes& names) {
  if (!interpolator.url.empty())
    return {nodeNameOf(interpolator.kind), {names, {{"containerField", "coord"}, {"url", interpolator.url}}}};
  return {nodeNameOf(interpolator.kind),
          {names, {{"key", textOf(interpolator.keys)}, {"keyValue", textOf(interpolator.values)}}}};
}

Element routeElement(const Route& route, const std::string& fromName, const std::string& toName) {
  return {"ROUTE",
          {{{"fromNode", fromName}, {"fromField", route.fromField}, {"toNode", toName}, {"toField", route.toField}}}};
}

Interpolator readInterpolator(InterpolatorKind kind, const FieldReader& fields) {
  const std::vector<std::string> urls = fields.strings("url");
  return {kind, floatsOf(fields.reals("key")), floatsOf(fields.reals("keyValue")),
          urls.empty() || kind != InterpolatorKind::coordinate ? "" : urls[0]};
}

} // namespace imgeo
