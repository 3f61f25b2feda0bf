#include "base/file.h"
#include "cli/commands.h"
#include "cli/element_counts.h"
#include "cli/interruption.h"
#include "cli/terminal.h"
#include "containers/encodings.h"
#include "imgeo/site.h"
#include "transcode/site/inspect_geometry_file.h"
#include "transcode/source/inspect_source.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <nlohmann/json.hpp>

namespace imgeo::cli {

namespace {

using Json = nlohmann::ordered_json;

void printJson(const Json& json) {
  fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
}

Json jsonOf(const SiteInfo& info) {
  Json json{{"triangles", info.elements.triangles},
            {"lines", info.elements.lines},
            {"points", info.elements.points},
            {"vertices", info.vertices},
            {"patches", info.patches},
            {"timeSensors", info.timeSensors},
            {"interpolators", info.interpolators},
            {"skins", info.skins},
            {"displacers", info.displacers},
            {"routes", info.routes},
            {"documentBytes", info.documentBytes},
            {"containerBytes", info.containerBytes},
            {"textureBytes", info.textureBytes},
            {"sourceTextureBytes", info.sourceTextureBytes},
            {"runtimeBytes", info.runtimeBytes},
            {"bytesPerTriangle", info.bytesPerTriangle}};
  json["geometries"] = Json::array();
  for (const GeometryInfo& geometry : info.geometries) {
    Json levels = Json::array();
    for (const LevelInfo& level : geometry.levels)
      levels.push_back({{"groups", level.groups},
                        {"triangles", level.triangles},
                        {"points", level.points},
                        {"bytes", level.bytes},
                        {"error", level.error}});
    json["geometries"].push_back({{"container", rowOf(geometry.encoding).container},
                                  {"profile", rowOf(geometry.encoding).node.profile},
                                  {"positionBits", geometry.positionBits},
                                  {"coordType", geometry.coordType},
                                  {"indexType", geometry.indexType},
                                  {"normalEncoding", geometry.normalEncoding},
                                  {"normalBits", geometry.normalBits},
                                  {"texCoordBits", geometry.texCoordBits},
                                  {"texCoordSets", geometry.texCoordSets},
                                  {"colorBits", geometry.colorBits},
                                  {"attributes", geometry.attributes},
                                  {"grid", geometry.grid},
                                  {"surfaceDistance", geometry.surfaceDistance},
                                  {"levels", levels}});
  }
  json["missing"] = info.missing;
  json["warnings"] = info.warnings;
  json["files"] = Json::array();
  for (const SiteFile& file : info.files)
    json["files"].push_back({{"path", file.path}, {"role", file.role}, {"bytes", file.bytes}});
  return json;
}

bool isFetched(const std::string& role) {
  return role != "scene" && role != "marker";
}

/// "sig: positions of 16 bits, Uint16 indices, octahedral normals of 8 bits"
std::string textOf(const GeometryInfo& geometry) {
  const EncodingRow& row = rowOf(geometry.encoding);
  const std::string profile = row.node.isDefaultProfile ? "" : std::string(" ") + row.node.profile;
  std::string text = fmt::format("{}{}: positions of {} bits", row.container, profile, geometry.positionBits);
  if (!geometry.coordType.empty())
    text += " as " + geometry.coordType;
  if (row.storage != PatchStorage::packed)
    text += geometry.indexType.empty() ? ", no index" : ", " + geometry.indexType + " indices";
  text += geometry.normalEncoding.empty()
              ? ", no normals"
              : fmt::format(", {} normals of {} bits", geometry.normalEncoding, geometry.normalBits);
  if (!geometry.grid.empty())
    text += ", grids: " + geometry.grid;
  if (geometry.surfaceDistance > 0)
    text += fmt::format(" of another mesh, off by at most {:.4g}", geometry.surfaceDistance);
  if (!geometry.attributes.empty())
    text += fmt::format(", further attributes {}", fmt::join(geometry.attributes, ", "));
  return text;
}

/// Prints a line for each level of detail.
void printLevels(const std::vector<LevelInfo>& levels) {
  if (levels.empty())
    return;
  const bool hasPoints = levels[0].points > 0;
  fmt::print("{}\n", bold(fmt::format("{:>6} {:>7} {:>14} {:>14}  {}", "level", "groups",
                                      hasPoints ? "points" : "triangles", "bytes", "largest error")));
  for (std::size_t level = 0; level < levels.size(); ++level)
    fmt::print("{:>6} {:>7} {:>14} {:>14}  {:.4g}\n", level, levels[level].groups,
               grouped(hasPoints ? levels[level].points : levels[level].triangles), grouped(levels[level].bytes),
               levels[level].error);
}

/// Prints each distinct way in which geometries are stored.
void printGeometries(const std::vector<GeometryInfo>& geometries) {
  for (auto it = geometries.begin(); it != geometries.end(); ++it)
    if (std::find(geometries.begin(), it, *it) == it)
      fmt::print("{}\n", textOf(*it));
  for (const GeometryInfo& geometry : geometries)
    printLevels(geometry.levels);
}

/// "animation: 1 TimeSensor, 3 interpolators, 6 routes", and "moving vertices: 1 skin, 2 displacers"
template <typename Info> void printAnimation(const Info& info) {
  if (info.timeSensors + info.interpolators + info.routes > 0)
    fmt::print("animation: {} {}, {} {}, {} {}\n", info.timeSensors,
               info.timeSensors == 1 ? "TimeSensor" : "TimeSensors", info.interpolators,
               info.interpolators == 1 ? "interpolator" : "interpolators", info.routes,
               info.routes == 1 ? "route" : "routes");
  if (info.skins + info.displacers > 0)
    fmt::print("moving vertices: {} {}, {} {}\n", info.skins, info.skins == 1 ? "skin" : "skins", info.displacers,
               info.displacers == 1 ? "displacer" : "displacers");
}

void warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings)
    fmt::print(stderr, "imgeo: warning: {}\n", warning);
}

void printSite(const SiteInfo& info) {
  fmt::print("{}, {} vertices, {} {}\n", listed(info.elements), grouped(info.vertices), info.patches,
             info.patches == 1 ? "patch" : "patches");
  printGeometries(info.geometries);
  printAnimation(info);
  fmt::print("\n");
  struct Sum {
    std::size_t files = 0;
    std::uint64_t bytes = 0;
  };
  std::vector<std::string> roles;
  std::map<std::string, Sum> sums;
  std::uint64_t fetched = 0;
  for (const SiteFile& file : info.files) {
    if (!sums.contains(file.role))
      roles.push_back(file.role);
    sums[file.role].files += 1;
    sums[file.role].bytes += file.bytes;
    if (isFetched(file.role))
      fetched += file.bytes;
  }
  const auto share = [&](std::uint64_t bytes) {
    return fmt::format("{:.2f} %", 100.0 * static_cast<double>(bytes) / static_cast<double>(fetched));
  };
  fmt::print("{}\n", bold(fmt::format("{:10} {:>7} {:>14} {:>9}", "role", "files", "bytes", "share")));
  for (const std::string& role : roles)
    fmt::print("{:10} {:>7} {:>14} {:>9}\n", role, sums[role].files, grouped(sums[role].bytes),
               isFetched(role) ? share(sums[role].bytes) : "");
  fmt::print("{:10} {:>7} {:>14}\n\n", "fetched", "", grouped(fetched));
  fmt::print("The document is {} of what a browser fetches.\n", share(info.documentBytes));
  if (info.sourceTextureBytes > 0)
    fmt::print("Textures take {} with their previews; the source's were {}.\n", byteSize(info.textureBytes),
               byteSize(info.sourceTextureBytes));
  if (info.elements.triangles > 0)
    fmt::print("Geometry takes {:.3f} bytes a triangle, its nodes in the document included.\n", info.bytesPerTriangle);
  for (const std::string& url : info.missing)
    warn({fmt::format("{} is named by the document but is no file of the site.", url)});
  warn(info.warnings);
}

Json jsonOf(const SourceInfo& info) {
  const auto vector = [](Vec3d v) { return Json{v.x, v.y, v.z}; };
  return {{"format", info.format},
          {"bytes", info.bytes},
          {"shapes", info.shapes},
          {"triangles", info.elements.triangles},
          {"lines", info.elements.lines},
          {"points", info.elements.points},
          {"timeSensors", info.timeSensors},
          {"interpolators", info.interpolators},
          {"skins", info.skins},
          {"displacers", info.displacers},
          {"routes", info.routes},
          {"vertices", info.vertices},
          {"normals", info.normals},
          {"texCoords", info.texCoords},
          {"texCoordSets", info.texCoordSets},
          {"colors", info.colors},
          {"attributes", info.attributes},
          {"boxMin", vector(info.box.min)},
          {"boxMax", vector(info.box.max)},
          {"warnings", info.warnings}};
}

void printSource(const SourceInfo& info) {
  const auto has = [](bool isPresent, const char* name) { return fmt::format("{}{}", isPresent ? "" : "no ", name); };
  fmt::print("{}, {}: {}, {} vertices in {} {}\n", info.format, byteSize(info.bytes), listed(info.elements),
             grouped(info.vertices), info.shapes, info.shapes == 1 ? "shape" : "shapes");
  fmt::print("{}, {}, {}\n", has(info.normals, "normals"),
             info.texCoordSets > 1 ? fmt::format("{} sets of texture coordinates", info.texCoordSets)
                                   : has(info.texCoords, "texture coordinates"),
             has(info.colors, "colours"));
  printAnimation(info);
  if (!info.attributes.empty())
    fmt::print("further attributes of vertices: {}\n", fmt::join(info.attributes, ", "));
  if (!info.box.empty())
    fmt::print("box {:.6g} {:.6g} {:.6g} to {:.6g} {:.6g} {:.6g}\n", info.box.min.x, info.box.min.y, info.box.min.z,
               info.box.max.x, info.box.max.y, info.box.max.z);
  warn(info.warnings);
}

Json jsonOf(const GeometryFileInfo& info) {
  Json json{{"kind", info.kind}, {"bytes", info.bytes}, {"namedByContent", info.namedByContent}};
  if (info.channels > 0)
    json.update({{"width", info.width}, {"height", info.height}, {"channels", info.channels}});
  return json;
}

void printGeometryFile(const GeometryFileInfo& info) {
  const std::string size =
      info.channels > 0 ? fmt::format(", {} x {} pixels of {} channels", info.width, info.height, info.channels) : "";
  fmt::print("{}{}, {} bytes; its name {} its content\n", info.kind, size, grouped(info.bytes),
             info.namedByContent ? "says" : "does not say");
}

template <typename Info> int print(const Arguments& arguments, const Info& info, void (*asText)(const Info&)) {
  if (arguments.has("json"))
    printJson(jsonOf(info));
  else
    asText(info);
  return 0;
}

/// Whether an X3D file is the document of a site and not a source: its geometry is in containers.
bool refersToContainers(const std::filesystem::path& file) {
  const Bytes bytes = readFile(file);
  std::string text(asText(bytes));
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text.find("<imagegeometry") != text.npos || text.find("<binarygeometry") != text.npos;
}

/// Whether a PNG is an elevation model, of 16 bits: images of geometry have 8.
bool holdsHeights(const std::filesystem::path& file) {
  constexpr std::size_t bitDepthAt = 24;
  const Bytes bytes = readFile(file);
  return bytes.size() > bitDepthAt && bytes[bitDepthAt] == 16;
}

} // namespace

int runInfo(const Arguments& arguments) {
  handleSignals();
  const std::filesystem::path path = arguments.text("path");
  std::error_code ignored;
  const std::string extension = path.extension();
  if (std::filesystem::is_directory(path, ignored) || extension == ".html" ||
      (extension == ".x3d" && refersToContainers(path)))
    return print(arguments, inspect(path), printSite);
  if ((extension == ".png" && !holdsHeights(path)) || extension == ".webp" || extension == ".bin")
    return print(arguments, inspectGeometryFile(path), printGeometryFile);
  return print(arguments, inspectSource(path, arguments.has("outside")), printSource);
}

} // namespace imgeo::cli
