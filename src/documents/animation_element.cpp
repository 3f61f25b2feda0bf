#include "documents/animation_element.h"

#include "markup/find_x3d.h"
#include "scene/mf_string.h"

#include <utility>

namespace imgeo {

namespace {

constexpr const char* movieElement = "MovieTexture";

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
  if (!interpolator.video.empty())
    return {movieElement,
            {names, {{"containerField", "coord"}, {"url", quoteStrings({interpolator.video, interpolator.url})}}}};
  if (!interpolator.url.empty())
    return {nodeNameOf(interpolator.kind), {names, {{"containerField", "coord"}, {"url", interpolator.url}}}};
  return {nodeNameOf(interpolator.kind),
          {names, {{"key", textOf(interpolator.keys)}, {"keyValue", textOf(interpolator.values)}}}};
}

Element routeElement(const Route& route, const std::string& fromName, const std::string& toName) {
  return {"ROUTE",
          {{{"fromNode", fromName}, {"fromField", route.fromField}, {"toNode", toName}, {"toField", route.toField}}}};
}

std::optional<Interpolator> readMovie(const FieldReader& fields) {
  if (!equalIgnoringCase(fields.node().name(), movieElement) ||
      !equalIgnoringCase(fields.text("containerField"), "coord"))
    return {};
  Interpolator frames{InterpolatorKind::coordinate, {}, {}};
  for (const std::string& url : fields.strings("url")) {
    std::string& named = std::string_view(url).substr(0, url.find('?')).ends_with(".json") ? frames.url : frames.video;
    if (named.empty())
      named = url;
  }
  if (frames.url.empty() || frames.video.empty())
    return {};
  return frames;
}

Interpolator readInterpolator(InterpolatorKind kind, const FieldReader& fields) {
  const std::vector<std::string> urls = fields.strings("url");
  return {kind, floatsOf(fields.reals("key")), floatsOf(fields.reals("keyValue")),
          urls.empty() || kind != InterpolatorKind::coordinate ? "" : urls[0]};
}

} // namespace imgeo
