#include "cli/convert_json.h"

#include "cli/choices.h"
#include "cli/embed_snippet.h"
#include "containers/encodings.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace imgeo::cli {

namespace {

using Json = nlohmann::ordered_json;

/// "source", or the weighting of computed normals.
std::string normalSourceName(const Arguments& arguments, const ConvertReport& report) {
  return report.normalsComputed ? arguments.text("normal-weighting") : "source";
}

/// The orientation and the scale of the source.
void addAxes(Json& json, const ConvertReport& report) {
  const SourceAxesReport& source = report.axes;
  json["up"] = nameOf(source.axes.up);
  json["upReason"] = source.upReason;
  json["isUpGuessed"] = source.isGuess;
  json["rotate"] = Json::array();
  for (const AxisRotation& rotation : source.axes.rotations)
    json["rotate"].push_back(fmt::format("{}:{}", static_cast<char>('x' + rotation.axis), rotation.degrees));
  json["scale"] = source.axes.scale;
  json["origin"] = report.origin;
  json["exaggeration"] = source.axes.exaggeration;
}

Json attributesJson(const ConvertReport& report) {
  Json attributes = Json::array();
  for (const AttributeReport& attribute : report.attributes)
    attributes.push_back({{"name", attribute.name},
                          {"components", attribute.components},
                          {"bits", attribute.bits},
                          {"error", attribute.error}});
  return attributes;
}

Json texturesJson(const Arguments& arguments, const ConvertReport& report) {
  const TextureReport& textures = report.textures;
  return {{"format", arguments.text("textures")},
          {"files", textures.files},
          {"resized", textures.resized},
          {"reencoded", textures.reencoded},
          {"previews", textures.previews},
          {"sourceBytes", textures.sourceBytes},
          {"bytes", textures.bytes},
          {"previewBytes", textures.previewBytes},
          {"resampledMeshes", report.resampledTextures}};
}

/// The meshes that are geometry images.
Json resampledJson(const ConvertReport& report) {
  Json meshes = Json::array();
  for (const ResampledMesh& mesh : report.resampled)
    meshes.push_back({{"name", mesh.name},
                      {"geometryImages", mesh.geometryImages},
                      {"texels", mesh.texels},
                      {"largestDistance", mesh.largestDistance},
                      {"meanDistance", mesh.meanDistance},
                      {"diagonal", mesh.diagonal}});
  return meshes;
}

Json weldJson(const Arguments& arguments, const WeldReport& weld) {
  return {{"mergedPositions", weld.mergedPositions},
          {"mergedWedges", weld.mergedWedges},
          {"unreferencedPositions", weld.unreferencedPositions},
          {"degenerateElements", weld.degenerateElements},
          {"duplicateElements", weld.duplicateElements},
          {"drop", arguments.text("drop")}};
}

Json rolesJson(const ConvertReport& report) {
  Json roles = Json::array();
  for (const RoleBytes& role : report.roles)
    roles.push_back({{"role", role.role}, {"files", role.files}, {"bytes", role.bytes}});
  return roles;
}

} // namespace

std::string convertJson(const Arguments& arguments, const ConvertReport& report) {
  Json json;
  json["input"] = arguments.list("input").front();
  json["output"] = arguments.text("output");
  if (report.x3domUrl.empty())
    json["embed"] = embedSnippet(arguments.text("output"));
  json["format"] = report.format;
  json["sourceBytes"] = report.sourceBytes;
  addAxes(json, report);
  json["view"] = arguments.text("view");
  json["container"] = arguments.text("container");
  json["profile"] = rowOf(report.encoding).profile;
  for (const char* name : {"target", "primitives", "index"})
    json[name] = arguments.text(name);
  if (!report.x3domUrl.empty())
    json["x3dom"] = {{"version", report.x3domVersion}, {"url", report.x3domUrl}};
  json["positionBits"] = report.maxPositionBits;
  json["minPositionBits"] = report.minPositionBits;
  json["coordType"] = arguments.text("coord-type");
  json["layout"] = arguments.text("layout");
  json["normalEncoding"] = nameOf(report.normalEncoding);
  json["normalBits"] = report.normalBits;
  json["normalErrorDegrees"] = report.normalErrorDegrees;
  json["attributes"] = attributesJson(report);
  json["textures"] = texturesJson(arguments, report);
  json["as"] = arguments.text("as");
  json["resampled"] = resampledJson(report);
  if (report.instances.shapes > 0)
    json["instances"] = {{"shapes", report.instances.shapes},
                         {"meshes", report.instances.meshes},
                         {"largestDistance", report.instances.largestDistance}};
  json["texCoordBits"] = report.texCoordBits;
  if (report.texCoordError)
    json["texCoordError"] = *report.texCoordError;
  json["colorBits"] = report.colorBits;
  if (report.hasColors)
    json["colorError"] = 255 * report.colorError;
  json["patchVertices"] = arguments.integer("patch-vertices");
  json["effort"] = arguments.integer("effort");
  json["normals"] = normalSourceName(arguments, report);
  if (const EdgeReport& edges = report.edges; edges.guessedSharp + edges.guessedSmooth > 0)
    json["guessedEdges"] = {{"creaseDegrees", manMadeCreaseDegrees},
                            {"sharpMeshes", edges.guessedSharp},
                            {"smoothMeshes", edges.guessedSmooth}};
  if (report.edges.flat > 0)
    json["flatMeshes"] = report.edges.flat;
  json["step"] = report.maxStep;
  json["positionError"] = report.positionError;
  json["collapsed"] = {{"triangles", report.collapsed.triangles}, {"lines", report.collapsed.lines}};
  json["triangles"] = report.elements.triangles;
  json["lines"] = report.elements.lines;
  json["points"] = report.elements.points;
  json["vertices"] = report.vertices;
  json["patches"] = report.patches;
  json["largestPatch"] = report.largestPatch;
  json["grids"] = report.grids;
  json["weld"] = weldJson(arguments, report.weld);
  if (report.frames > 0)
    json["sequence"] = {{"frames", report.frames}, {"rate", report.frameRate}, {"bytes", report.frameBytes}};
  if (report.videoBytes > 0)
    json["video"] = {{"codec", "vp9"}, {"bytes", report.videoBytes}};
  json["roles"] = rolesJson(report);
  json["bytesPerTriangle"] = report.bytesPerTriangle;
  if (report.precompressed.files > 0)
    json["precompressed"] = {{"files", report.precompressed.files},
                             {"bytes", report.precompressed.bytes},
                             {"brotliBytes", report.precompressed.brotliBytes},
                             {"gzipBytes", report.precompressed.gzipBytes},
                             {"seconds", report.precompressSeconds}};
  json["warnings"] = report.warnings;
  json["seconds"] = {{"import", report.importSeconds},
                     {"prepare", report.prepareSeconds},
                     {"encode", report.encodeSeconds},
                     {"total", report.totalSeconds}};
  json["peakMemoryBytes"] = report.peakMemoryBytes;
  if (report.tasks > 0)
    json["ranks"] = {{"tasks", report.tasks}, {"tasksTaken", report.tasksTaken}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string shareJson(const RankOptions& ranks, const ConvertReport& report) {
  const Json json = {{"rank", ranks.rank},
                     {"ranks", {{"tasks", report.tasks}, {"tasksTaken", report.tasksTaken}}},
                     {"seconds", {{"total", report.totalSeconds}}},
                     {"peakMemoryBytes", report.peakMemoryBytes}};
  return json.dump(2) + "\n";
}

} // namespace imgeo::cli
