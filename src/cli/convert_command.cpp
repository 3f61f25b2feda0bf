#include "base/error.h"
#include "base/file.h"
#include "base/parallel.h"
#include "cli/choices.h"
#include "cli/commands.h"
#include "cli/element_counts.h"
#include "cli/interruption.h"
#include "cli/terminal.h"
#include "containers/encodings.h"
#include "imgeo/convert.h"
#include "imgeo/site.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace imgeo::cli {

namespace {

using Json = nlohmann::ordered_json;

/// "all", "none", or names with commas between.
AttributeChoice attributesNamed(const std::string& text) {
  AttributeChoice choice;
  choice.all = text == "all";
  if (choice.all || text == "none")
    return choice;
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
    end = std::min(text.find(',', begin), text.size());
    if (end > begin)
      choice.names.insert(text.substr(begin, end - begin));
  }
  return choice;
}

/// "0.02" or "0.05%".
MaxError maxErrorFrom(const std::string& text) {
  MaxError error;
  const char* end = text.data() + text.size();
  error.isPercent = text.ends_with('%');
  const auto [last, fault] = std::from_chars(text.data(), end - error.isPercent, error.value);
  if (fault != std::errc{} || last != end - error.isPercent || !(error.value > 0) || !std::isfinite(error.value))
    throw Error(ErrorKind::usage, "--max-error", fmt::format("\"{}\" is no length, nor one of percent", text));
  return error;
}

double basePercentFrom(const std::string& text) {
  double percent = 0;
  const char* end = text.data() + text.size();
  const auto [last, fault] = std::from_chars(text.data(), end, percent);
  if (fault != std::errc{} || last != end || !std::isfinite(percent))
    throw Error(ErrorKind::usage, "--base", fmt::format("\"{}\" is no number of percent", text));
  return percent;
}

TextureOptions texturesFrom(const Arguments& arguments) {
  TextureOptions textures;
  textures.format = valueNamed(texturesChoices, arguments.text("textures"));
  if (!arguments.text("texture-size").empty())
    textures.size = static_cast<std::uint32_t>(arguments.integer("texture-size"));
  if (!arguments.text("texture-quality").empty())
    textures.quality = static_cast<int>(arguments.integer("texture-quality"));
  textures.previewEdge = static_cast<std::uint32_t>(arguments.integer("texture-preview"));
  return textures;
}

/// The encoding that --container and --profile name; nothing where convert is to choose a profile of sig.
std::optional<Encoding> encodingFrom(const Arguments& arguments) {
  const std::string container = arguments.text("container"), profile = arguments.text("profile");
  std::optional<Encoding> encoding;
  for (const EncodingRow* row : allEncodings())
    if (row->container == container && (profile == "auto" || row->profile == profile)) {
      if (encoding)
        return std::nullopt;
      encoding = row->encoding;
    }
  if (!encoding)
    throw Error(ErrorKind::usage, "--profile",
                fmt::format("{} is a profile of sig, and {} has none", profile, container));
  return encoding;
}

ConvertOptions optionsFrom(const Arguments& arguments) {
  ConvertOptions options;
  options.encoding = encodingFrom(arguments);
  options.target = valueNamed(targetChoices, arguments.text("target"));
  options.x3domUrl = arguments.text("x3dom-url");
  options.primitives = valueNamed(primitivesChoices, arguments.text("primitives"));
  options.indexed = valueNamed(indexChoices, arguments.text("index"));
  options.normalWeighting = valueNamed(normalWeightingChoices, arguments.text("normal-weighting"));
  const auto takeBits = [&](const char* name, std::uint32_t& bits) {
    if (!arguments.text(name).empty())
      bits = static_cast<std::uint32_t>(arguments.integer(name));
  };
  takeBits("position-bits", options.positionBits);
  takeBits("normal-bits", options.normalBits);
  takeBits("texcoord-bits", options.texCoordBits);
  takeBits("color-bits", options.colorBits);
  if (!arguments.text("max-error").empty())
    options.maxError = maxErrorFrom(arguments.text("max-error"));
  if (!arguments.text("base").empty())
    options.basePercent = basePercentFrom(arguments.text("base"));
  options.coordType = valueNamed(coordTypeChoices, arguments.text("coord-type"));
  options.layout = valueNamed(layoutChoices, arguments.text("layout"));
  options.normals = valueNamed(normalsChoices, arguments.text("normals"));
  options.dropped = valueNamed(dropChoices, arguments.text("drop"));
  options.keepAttributes = attributesNamed(arguments.text("keep-attributes"));
  if (!arguments.text("attribute-bits").empty())
    options.attributeBits = static_cast<std::uint32_t>(arguments.integer("attribute-bits"));
  options.textures = texturesFrom(arguments);
  options.patchVertices = static_cast<std::uint32_t>(arguments.integer("patch-vertices"));
  options.effort = static_cast<int>(arguments.integer("effort"));
  options.title = arguments.text("title");
  options.outside = arguments.has("outside");
  options.strict = arguments.has("strict");
  options.force = arguments.has("force");
  return options;
}

/// How the normals came about: "source", or the weighting.
std::string normalsOf(const Arguments& arguments, const ConvertReport& report) {
  return report.normalsComputed ? arguments.text("normal-weighting") : "source";
}

/// By which a component of 0 .. 255 may be off: half a step, and what is left of it after rounding to a whole
/// number.
double colorErrorBound(std::uint32_t bits) {
  return bits >= 8 ? 0 : std::floor(127.5 / ((1u << bits) - 1) + 0.5);
}

Json jsonOf(const Arguments& arguments, const ConvertReport& report) {
  Json json;
  json["input"] = arguments.text("input");
  json["output"] = arguments.text("output");
  json["format"] = report.format;
  json["sourceBytes"] = report.sourceBytes;
  json["container"] = arguments.text("container");
  json["profile"] = rowOf(report.encoding).profile;
  for (const char* name : {"target", "primitives", "index"})
    json[name] = arguments.text(name);
  if (!report.x3domUrl.empty())
    json["x3dom"] = {{"version", report.x3domVersion}, {"url", report.x3domUrl}};
  json["positionBits"] = report.maxPositionBits;
  json["leastPositionBits"] = report.minPositionBits;
  json["coordType"] = arguments.text("coord-type");
  json["layout"] = arguments.text("layout");
  json["normalEncoding"] = nameOf(report.normalEncoding);
  json["normalBits"] = report.normalBits;
  json["normalErrorDegrees"] = report.normalErrorDegrees;
  json["attributes"] = Json::array();
  for (const AttributeReport& attribute : report.attributes)
    json["attributes"].push_back({{"name", attribute.name},
                                  {"components", attribute.components},
                                  {"bits", attribute.bits},
                                  {"error", attribute.error}});
  const TextureReport& textures = report.textures;
  json["textures"] = {{"format", arguments.text("textures")},
                      {"files", textures.files},
                      {"resized", textures.resized},
                      {"reencoded", textures.reencoded},
                      {"previews", textures.previews},
                      {"sourceBytes", textures.sourceBytes},
                      {"bytes", textures.bytes},
                      {"previewBytes", textures.previewBytes}};
  json["texCoordBits"] = report.texCoordBits;
  if (report.texCoordError)
    json["texCoordError"] = *report.texCoordError;
  json["colorBits"] = report.colorBits;
  if (report.hasColors)
    json["colorError"] = colorErrorBound(report.colorBits);
  json["patchVertices"] = arguments.integer("patch-vertices");
  json["effort"] = arguments.integer("effort");
  json["normals"] = normalsOf(arguments, report);
  json["step"] = report.maxStep;
  json["positionError"] = report.positionError;
  json["collapsed"] = {{"triangles", report.collapsed.triangles}, {"lines", report.collapsed.lines}};
  json["triangles"] = report.elements.triangles;
  json["lines"] = report.elements.lines;
  json["points"] = report.elements.points;
  json["vertices"] = report.vertices;
  json["patches"] = report.patches;
  json["weld"] = {{"mergedPositions", report.weld.mergedPositions},
                  {"mergedWedges", report.weld.mergedWedges},
                  {"unreferencedPositions", report.weld.unreferencedPositions},
                  {"degenerateElements", report.weld.degenerateElements},
                  {"duplicateElements", report.weld.duplicateElements},
                  {"drop", arguments.text("drop")}};
  json["roles"] = Json::array();
  for (const RoleBytes& role : report.roles)
    json["roles"].push_back({{"role", role.role}, {"files", role.files}, {"bytes", role.bytes}});
  json["bytesPerTriangle"] = report.bytesPerTriangle;
  json["warnings"] = report.warnings;
  json["seconds"] = {{"import", report.importSeconds},
                     {"prepare", report.prepareSeconds},
                     {"encode", report.encodeSeconds},
                     {"total", report.totalSeconds}};
  json["peakMemoryBytes"] = report.peakMemoryBytes;
  return json;
}

std::string textOf(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void printLine(const std::string& label, const std::string& text) {
  fmt::print("{} {}\n", bold(fmt::format("{:10}", label)), text);
}

std::string positionsOf(const Arguments& arguments, const ConvertReport& report) {
  const bool asFloats = arguments.text("coord-type") == "float32";
  const std::string lattice = asFloats && arguments.text("position-bits").empty() ? "the source's numbers"
                              : report.minPositionBits < report.maxPositionBits
                                  ? fmt::format("{} to {} bits: steps of up to {:.4g}", report.minPositionBits,
                                                report.maxPositionBits, report.maxStep)
                                  : fmt::format("{} bits: step {:.4g}", report.maxPositionBits, report.maxStep);
  return fmt::format("{}{}, so off by at most {:.4g} an axis, in units of the source", lattice,
                     asFloats ? " as float32" : "", report.positionError);
}

/// "12 files: 34.1 MB as found, 3.2 MB as written; 2 made smaller, 10 re-encoded; 12 previews of 14 kB"
std::string texturesOf(const TextureReport& textures) {
  std::string text =
      fmt::format("{} {}: {} as found, {} as written", textures.files, textures.files == 1 ? "file" : "files",
                  byteSize(textures.sourceBytes), byteSize(textures.bytes));
  if (textures.resized + textures.reencoded > 0)
    text += fmt::format("; {} made smaller, {} re-encoded", textures.resized, textures.reencoded);
  if (textures.previews > 0)
    text += fmt::format("; {} {} of {}", textures.previews, textures.previews == 1 ? "preview" : "previews",
                        byteSize(textures.previewBytes));
  return text;
}

void printTextures(const TextureReport& textures) {
  if (textures.files > 0)
    printLine("textures", texturesOf(textures));
}

void printChoices(const Arguments& arguments, const ConvertReport& report) {
  const EncodingRow& row = rowOf(report.encoding);
  printLine("source", fmt::format("{}, {}", report.format, byteSize(report.sourceBytes)));
  if (report.patches == 0) { // a scene of a few primitives
    printLine("elements", "none to encode: what geometry there is stays in the document as it is");
    return printTextures(report.textures);
  }
  printLine("elements", fmt::format("{} of {} vertices", listed(report.elements), grouped(report.vertices)));
  const bool onlyPoints = report.elements.points == report.elements.sum();
  printLine("container", fmt::format("{} ({}), profile {}, target {}, {}{}", row.container, row.fileKind, row.profile,
                                     arguments.text("target"), onlyPoints ? "points" : arguments.text("primitives"),
                                     onlyPoints || arguments.text("index") == "on" ? "" : " without index"));
  if (!report.x3domUrl.empty())
    printLine("X3DOM", fmt::format("{}, from {}", report.x3domVersion, report.x3domUrl));
  printLine("positions", positionsOf(arguments, report));
  if (report.collapsed.sum() > 0)
    printLine("", fmt::format("too coarse for {}, without area or length there", listed(report.collapsed)));
  if (report.hasNormals)
    printLine("normals",
              fmt::format("{}, {} bits: off by at most {:.2g} degrees; {}", nameOf(report.normalEncoding),
                          report.normalBits, report.normalErrorDegrees,
                          report.normalsComputed
                              ? "computed: triangles count by " +
                                    std::string(arguments.text("normal-weighting") == "area"    ? "their area"
                                                : arguments.text("normal-weighting") == "angle" ? "their angle"
                                                                                                : "one each")
                              : "the source's, where it has any"));
  const auto bitsOf = [&](std::uint32_t bits) {
    return row.storage != PatchStorage::arrays ? fmt::format("{} bits: ", bits) : "";
  };
  if (report.texCoordError)
    printLine("texcoords", fmt::format("{}off by at most {:.3g}", bitsOf(report.texCoordBits), *report.texCoordError));
  if (report.hasColors)
    printLine("colours", bitsOf(report.colorBits) +
                             (report.colorBits >= 8
                                  ? "the source's own of 8"
                                  : fmt::format("off by at most {:.0f} of 255", colorErrorBound(report.colorBits))));
  for (const AttributeReport& attribute : report.attributes)
    printLine("attribute",
              fmt::format("{}: {} bits, off by at most {:.3g}", attribute.name, attribute.bits, attribute.error));
  printTextures(report.textures);
  printLine("patches", fmt::format("{} of at most {} vertices", report.patches,
                                   grouped(static_cast<std::uint64_t>(arguments.integer("patch-vertices")))));
  const WeldReport& weld = report.weld;
  const std::string drop = arguments.text("drop");
  printLine("welding", fmt::format("merged {} positions and {} wedges, dropped {} unreferenced positions",
                                   grouped(weld.mergedPositions), grouped(weld.mergedWedges),
                                   grouped(weld.unreferencedPositions)));
  const bool isStrips = arguments.text("primitives") == "strips"; // which draw nothing degenerate
  if (weld.degenerateElements + weld.duplicateElements > 0)
    printLine("",
              fmt::format("{} {} degenerate elements, {} {} repeated ones",
                          drop == "degenerate" || drop == "both" || isStrips ? "dropped" : "kept",
                          grouped(weld.degenerateElements), drop == "repeated" || drop == "both" ? "dropped" : "kept",
                          grouped(weld.duplicateElements)));
}

void printBytes(const ConvertReport& report) {
  fmt::print("\n{}\n", bold(fmt::format("{:10} {:>7} {:>14} {:>16}", "role", "files", "bytes", "bytes/triangle")));
  RoleBytes sum{"together", 0, 0};
  const auto print = [&](const RoleBytes& role) {
    const std::size_t triangles = report.elements.triangles;
    const bool counts = triangles > 0;
    const double each = counts ? static_cast<double>(role.bytes) / static_cast<double>(triangles) : 0;
    fmt::print("{:10} {:>7} {:>14} {:>16}\n", role.role, role.files, grouped(role.bytes),
               counts ? fmt::format("{:.3f}", each) : "");
  };
  for (const RoleBytes& role : report.roles) {
    print(role);
    sum.bytes += role.bytes;
    sum.files += role.files;
  }
  print(sum);
  if (report.elements.triangles > 0)
    fmt::print("\nGeometry takes {:.3f} bytes a triangle, its nodes in the document included.\n",
               report.bytesPerTriangle);
}

/// ", 83 bytes a triangle"; nothing for what has none.
std::string eachTriangle(const ConvertReport& report) {
  return report.elements.triangles == 0
             ? ""
             : fmt::format(", {} bytes a triangle", grouped(report.peakMemoryBytes / report.elements.triangles));
}

void printFiles(const std::filesystem::path& site) {
  fmt::print("\n");
  for (const SiteFile& file : inspect(site).files)
    fmt::print("{:10} {:>14}  {}\n", file.role, grouped(file.bytes), file.path);
}

} // namespace

int runConvert(const Arguments& arguments) {
  limitThreads(static_cast<std::size_t>(arguments.integer("threads")));
  noteInterruptions();
  const std::string& output = arguments.text("output");
  ConvertReport report;
  {
    ProgressBar bar;
    report =
        convert(arguments.text("input"), output, optionsFrom(arguments), [&](double share, const std::string& doing) {
          throwIfInterrupted();
          bar.show(share, doing);
        });
  }
  for (const std::string& warning : report.warnings)
    fmt::print(stderr, "imgeo: warning: {}\n", warning);
  const Json json = jsonOf(arguments, report);
  if (!arguments.text("report").empty())
    writeFile(arguments.text("report"), asBytes(textOf(json)));
  if (arguments.has("json")) {
    fmt::print("{}", textOf(json));
    return 0;
  }
  printChoices(arguments, report);
  printBytes(report);
  if (arguments.has("verbose"))
    printFiles(output);
  fmt::print("It took {:.2f} s (import {:.2f}, prepare {:.2f}, encode {:.2f}) and at most {} of memory{}.\n",
             report.totalSeconds, report.importSeconds, report.prepareSeconds, report.encodeSeconds,
             byteSize(report.peakMemoryBytes), eachTriangle(report));
  fmt::print("\nTo look at it: imgeo serve {}\n", output);
  return 0;
}

} // namespace imgeo::cli
