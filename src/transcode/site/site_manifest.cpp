#include "transcode/site/site_manifest.h"

#include "base/error.h"
#include "base/file.h"
#include "containers/encodings.h"
#include "transcode/site/site_files.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace imgeo {

namespace {

constexpr std::array primitiveKinds{Primitives::triangles, Primitives::strips, Primitives::points};
constexpr std::array axisDirections{AxisDirection::x,      AxisDirection::y,      AxisDirection::z,
                                    AxisDirection::minusX, AxisDirection::minusY, AxisDirection::minusZ};
constexpr std::array weightings{NormalWeighting::area, NormalWeighting::angle, NormalWeighting::uniform};

template <typename Value, std::size_t count>
Value valueNamed(const std::array<Value, count>& values, const std::string& name, const std::string& location) {
  for (const Value value : values)
    if (nameOf(value) == name)
      return value;
  throw Error(ErrorKind::malformed, location, "has the unknown value \"" + name + "\"");
}

/// Writes the steps that change something.
void writeAxes(nlohmann::ordered_json& json, const SourceAxes& axes) {
  if (axes.up != AxisDirection::y)
    json["up"] = nameOf(axes.up);
  for (const AxisRotation& rotation : axes.rotations)
    json["rotate"].push_back({{"axis", nameOf(axisDirections[rotation.axis])}, {"degrees", rotation.degrees}});
  if (axes.scale != 1)
    json["scale"] = axes.scale;
  if (axes.exaggeration != 1)
    json["exaggeration"] = axes.exaggeration;
}

SourceAxes readAxes(const nlohmann::json& json, const std::string& location) {
  SourceAxes axes;
  axes.up = valueNamed(axisDirections, json.value("up", "y"), location);
  for (const nlohmann::json& rotation : json.value("rotate", nlohmann::json::array())) {
    const AxisDirection axis = valueNamed(axisDirections, rotation.at("axis"), location);
    if (axis > AxisDirection::z)
      throw Error(ErrorKind::malformed, location, "rotates about a negative axis");
    axes.rotations.push_back({static_cast<int>(axis), rotation.at("degrees")});
  }
  axes.scale = json.value("scale", 1.0);
  axes.exaggeration = json.value("exaggeration", 1.0);
  for (const double factor : {axes.scale, axes.exaggeration})
    if (!(factor > 0) || !std::isfinite(factor))
      throw Error(ErrorKind::malformed, location, "has a scale or an exaggeration that is not a positive number");
  return axes;
}

Encoding encodingNamed(const std::string& container, const std::string& profile, const std::string& location) {
  const EncodingRow* row = findEncoding(container, profile);
  if (row == nullptr)
    throw Error(ErrorKind::malformed, location, "has the unknown encoding \"" + container + "\" \"" + profile + "\"");
  return row->encoding;
}

} // namespace

const char* nameOf(Primitives primitives) {
  return primitives == Primitives::triangles ? "triangles" : primitives == Primitives::strips ? "strips" : "points";
}

const char* nameOf(NormalWeighting weighting) {
  return weighting == NormalWeighting::area ? "area" : weighting == NormalWeighting::angle ? "angle" : "uniform";
}

std::string writeManifest(const SiteManifest& manifest) {
  nlohmann::ordered_json json;
  json["generator"] = manifest.generator;
  json["source"] = manifest.source;
  json["container"] = rowOf(manifest.encoding).container;
  json["profile"] = rowOf(manifest.encoding).profile;
  json["primitives"] = nameOf(manifest.primitives);
  json["normals"] = manifest.normalsComputed ? nameOf(manifest.normalWeighting) : "source";
  if (manifest.creaseDegrees)
    json["creaseDegrees"] = *manifest.creaseDegrees;
  if (manifest.guessesCreases)
    json["guessedCreases"] = true;
  if (manifest.flatWithoutNormals)
    json["flatWithoutNormals"] = true;
  json["triangles"] = manifest.elements.triangles;
  json["lines"] = manifest.elements.lines;
  json["points"] = manifest.elements.points;
  writeAxes(json, manifest.axes);
  if (manifest.dropped.degenerate)
    json["droppedDegenerate"] = true;
  if (manifest.dropped.repeated)
    json["droppedRepeated"] = true;
  if (manifest.colorBits > 8)
    json["colorBits"] = manifest.colorBits;
  if (!manifest.attributes.empty())
    json["attributes"] = manifest.attributes;
  if (manifest.sequenceRate > 0)
    json["sequenceRate"] = manifest.sequenceRate;
  if (manifest.sequenceRate > 0 && manifest.onlyLongSequences)
    json["onlyLongSequences"] = true;
  if (manifest.onlyFirstTexCoords)
    json["onlyFirstTexCoords"] = true;
  if (manifest.instanceDistance)
    json["instanceDistance"] = *manifest.instanceDistance;
  if (manifest.normalErrorDegrees > 0)
    json["normalErrorDegrees"] = manifest.normalErrorDegrees;
  if (manifest.sourceTextureBytes > 0)
    json["sourceTextureBytes"] = manifest.sourceTextureBytes;
  if (manifest.pictures)
    json["pictures"] = *manifest.pictures;
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::optional<SiteManifest> manifestOf(const SiteDocument& document) {
  return manifestIn(document.root);
}

std::optional<SiteManifest> manifestIn(const std::filesystem::path& root) {
  const std::filesystem::path file = root / manifestName;
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    return std::nullopt;
  return readManifest(asText(readFile(file)), file.string());
}

SiteManifest readManifest(std::string_view text, const std::string& name) {
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    SiteManifest manifest;
    manifest.generator = json.at("generator");
    manifest.source = json.at("source");
    manifest.encoding = encodingNamed(json.at("container"), json.value("profile", "classic"), name);
    manifest.primitives = valueNamed(primitiveKinds, json.at("primitives"), name);
    const std::string normals = json.at("normals");
    manifest.normalsComputed = normals != "source";
    if (manifest.normalsComputed)
      manifest.normalWeighting = valueNamed(weightings, normals, name);
    if (json.contains("creaseDegrees"))
      manifest.creaseDegrees = json.at("creaseDegrees").get<double>();
    if (const double degrees = manifest.creaseDegrees.value_or(0); !(degrees >= 0 && degrees <= smoothDegrees))
      throw Error(ErrorKind::malformed, name, "states a crease angle that is not within 0 .. 180 degrees");
    manifest.guessesCreases = json.value("guessedCreases", false);
    manifest.flatWithoutNormals = json.value("flatWithoutNormals", false);
    manifest.elements = {json.at("triangles"), json.value("lines", std::size_t{0}), json.at("points")};
    manifest.axes = readAxes(json, name);
    manifest.dropped = {json.value("droppedDegenerate", false), json.value("droppedRepeated", false)};
    manifest.colorBits = json.value("colorBits", 8u);
    manifest.attributes = json.value("attributes", std::vector<std::string>{});
    manifest.sequenceRate = json.value("sequenceRate", 0.0);
    manifest.onlyLongSequences = json.value("onlyLongSequences", false);
    manifest.onlyFirstTexCoords = json.value("onlyFirstTexCoords", false);
    if (json.contains("instanceDistance"))
      manifest.instanceDistance = json.at("instanceDistance").get<double>();
    if (const double distance = manifest.instanceDistance.value_or(0); !(distance >= 0) || !std::isfinite(distance))
      throw Error(ErrorKind::malformed, name, "states a negative distance of instances");
    manifest.normalErrorDegrees = json.value("normalErrorDegrees", 0.0);
    manifest.sourceTextureBytes = json.value("sourceTextureBytes", std::uint64_t{0});
    if (json.contains("pictures"))
      manifest.pictures = json.at("pictures").get<std::map<std::string, std::string>>();
    return manifest;
  } catch (const nlohmann::json::exception&) {
    throw Error(ErrorKind::malformed, name, "is not the manifest of a site");
  }
}

} // namespace imgeo
