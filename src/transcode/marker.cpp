#include "transcode/marker.h"

#include "base/error.h"

#include <array>
#include <nlohmann/json.hpp>

namespace imgeo {

namespace {

constexpr std::array containers{Container::sig, Container::bg};
constexpr std::array profiles{Profile::classic, Profile::compact};
constexpr std::array primitiveKinds{Primitives::triangles, Primitives::strips, Primitives::points};
constexpr std::array weightings{NormalWeighting::area, NormalWeighting::angle, NormalWeighting::uniform};

template <typename Value, std::size_t count>
Value valueNamed(const std::array<Value, count>& values, const std::string& name, const std::string& location) {
  for (const Value value : values)
    if (nameOf(value) == name)
      return value;
  throw Error(ErrorKind::malformed, location, "says \"" + name + "\", which is nothing we know");
}

} // namespace

const char* nameOf(Primitives primitives) {
  return primitives == Primitives::triangles ? "triangles" : primitives == Primitives::strips ? "strips" : "points";
}

const char* nameOf(NormalWeighting weighting) {
  return weighting == NormalWeighting::area ? "area" : weighting == NormalWeighting::angle ? "angle" : "uniform";
}

std::string writeMarker(const Marker& marker) {
  nlohmann::ordered_json json;
  json["generator"] = marker.generator;
  json["source"] = marker.source;
  json["container"] = nameOf(marker.container);
  json["profile"] = nameOf(marker.profile);
  json["primitives"] = nameOf(marker.primitives);
  json["normals"] = marker.normalsComputed ? nameOf(marker.normalWeighting) : "source";
  json["triangles"] = marker.elements.triangles;
  json["lines"] = marker.elements.lines;
  json["points"] = marker.elements.points;
  if (marker.dropped.degenerate)
    json["droppedDegenerate"] = true;
  if (marker.dropped.repeated)
    json["droppedRepeated"] = true;
  if (!marker.attributes.empty())
    json["attributes"] = marker.attributes;
  if (marker.normalErrorDegrees > 0)
    json["normalErrorDegrees"] = marker.normalErrorDegrees;
  if (marker.sourceTextureBytes > 0)
    json["sourceTextureBytes"] = marker.sourceTextureBytes;
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Marker readMarker(std::string_view text, const std::string& name) {
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    Marker marker;
    marker.generator = json.at("generator");
    marker.source = json.at("source");
    marker.container = valueNamed(containers, json.at("container"), name);
    marker.profile = valueNamed(profiles, json.value("profile", nameOf(Profile::classic)), name);
    marker.primitives = valueNamed(primitiveKinds, json.at("primitives"), name);
    const std::string normals = json.at("normals");
    marker.normalsComputed = normals != "source";
    if (marker.normalsComputed)
      marker.normalWeighting = valueNamed(weightings, normals, name);
    marker.elements = {json.at("triangles"), json.value("lines", std::size_t{0}), json.at("points")};
    marker.dropped = {json.value("droppedDegenerate", false), json.value("droppedRepeated", false)};
    marker.attributes = json.value("attributes", std::vector<std::string>{});
    marker.normalErrorDegrees = json.value("normalErrorDegrees", 0.0);
    marker.sourceTextureBytes = json.value("sourceTextureBytes", std::uint64_t{0});
    return marker;
  } catch (const nlohmann::json::exception&) {
    throw Error(ErrorKind::malformed, name, "is not the marker of a site");
  }
}

} // namespace imgeo
