#include "cli/convert_options.h"

#include "base/error.h"
#include "cli/choices.h"
#include "cli/memory_size.h"
#include "containers/encodings.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace imgeo::cli {

namespace {

/// Parses "all", "none" or names of attributes separated by commas.
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

/// Parses "x:90,y:-45".
std::vector<AxisRotation> rotationsFrom(const std::string& text) {
  std::vector<AxisRotation> rotations;
  if (text.empty())
    return rotations;
  for (std::size_t begin = 0, end = 0; begin <= text.size(); begin = end + 1) {
    end = std::min(text.find(',', begin), text.size());
    const std::string_view part = std::string_view(text).substr(begin, end - begin);
    AxisRotation rotation;
    const bool isAxis = part.size() > 2 && part[0] >= 'x' && part[0] <= 'z' && part[1] == ':';
    const char* const last = part.data() + part.size();
    const auto [read, fault] =
        isAxis ? std::from_chars(part.data() + 2, last, rotation.degrees) : std::from_chars_result{};
    if (!isAxis || fault != std::errc{} || read != last || !std::isfinite(rotation.degrees))
      throw Error(ErrorKind::usage, "--rotate", fmt::format("\"{}\" is not an axis with an angle, as x:90 is", part));
    rotation.axis = part[0] - 'x';
    rotations.push_back(rotation);
  }
  return rotations;
}

/// The number that a text is; NaN for other texts.
double numberFrom(const std::string& text) {
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [last, fault] = std::from_chars(text.data(), end, number);
  return fault == std::errc{} && last == end ? number : std::numeric_limits<double>::quiet_NaN();
}

/// The factor that an option states.
double factorFrom(const char* option, const std::string& text) {
  const double factor = numberFrom(text);
  if (!(factor >= 1e-12 && factor <= 1e12))
    throw Error(ErrorKind::usage, option, fmt::format("\"{}\" is not a factor within 1e-12..1e12", text));
  return factor;
}

/// Parses "0.02" or "0.05%".
MaxError maxErrorFrom(const std::string& text) {
  MaxError error;
  const char* end = text.data() + text.size();
  error.isPercent = text.ends_with('%');
  const auto [last, fault] = std::from_chars(text.data(), end - error.isPercent, error.value);
  if (fault != std::errc{} || last != end - error.isPercent || !(error.value > 0) || !std::isfinite(error.value))
    throw Error(ErrorKind::usage, "--max-error", fmt::format("\"{}\" is neither a length nor a percentage", text));
  return error;
}

double basePercentFrom(const std::string& text) {
  const double percent = numberFrom(text);
  if (!std::isfinite(percent))
    throw Error(ErrorKind::usage, "--base", fmt::format("\"{}\" is not a percentage", text));
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

/// The only encoding that --container and --profile allow; nothing if they allow several, so that convert chooses.
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

double creaseDegreesFrom(const std::string& text) {
  const double degrees = numberFrom(text);
  if (!(degrees >= 0 && degrees <= 180))
    throw Error(ErrorKind::usage, "--crease-angle", fmt::format("\"{}\" is not an angle within 0..180 degrees", text));
  return degrees;
}

} // namespace

ConvertOptions convertOptionsFrom(const Arguments& arguments) {
  ConvertOptions options;
  options.encoding = encodingFrom(arguments);
  options.target = valueNamed(targetChoices, arguments.text("target"));
  options.x3domUrl = arguments.text("x3dom-url");
  options.form = valueNamed(formChoices, arguments.text("as"));
  options.primitives = valueNamed(primitivesChoices, arguments.text("primitives"));
  options.indexed = valueNamed(indexChoices, arguments.text("index"));
  options.normalWeighting = valueNamed(normalWeightingChoices, arguments.text("normal-weighting"));
  if (!arguments.text("crease-angle").empty())
    options.creaseDegrees = creaseDegreesFrom(arguments.text("crease-angle"));
  const auto takeBits = [&](const char* name, std::uint32_t& bits) {
    if (!arguments.text(name).empty())
      bits = static_cast<std::uint32_t>(arguments.integer(name));
  };
  takeBits("grid", options.grid);
  takeBits("position-bits", options.positionBits);
  takeBits("normal-bits", options.normalBits);
  takeBits("texcoord-bits", options.texCoordBits);
  takeBits("color-bits", options.colorBits);
  if (!arguments.text("max-error").empty())
    options.maxError = maxErrorFrom(arguments.text("max-error"));
  if (!arguments.text("base").empty())
    options.basePercent = basePercentFrom(arguments.text("base"));
  options.findInstances = valueNamed(instancesChoices, arguments.text("instances"));
  options.levels = valueNamed(levelsChoices, arguments.text("levels"));
  options.groupTriangles = static_cast<std::uint32_t>(arguments.integer("group-triangles"));
  options.regionTriangles = static_cast<std::uint32_t>(arguments.integer("region-triangles"));
  if (!arguments.text("memory").empty())
    options.memoryBytes = memoryFrom(arguments.text("memory"));
  options.workFolder = arguments.text("work");
  options.resume = arguments.has("resume");
  options.ranks.count = static_cast<std::uint32_t>(arguments.integer("ranks"));
  options.ranks.rank = static_cast<std::uint32_t>(arguments.integer("rank"));
  options.ranks.maxSilenceSeconds = static_cast<double>(arguments.integer("silence"));
  options.coordType = valueNamed(coordTypeChoices, arguments.text("coord-type"));
  options.layout = valueNamed(layoutChoices, arguments.text("layout"));
  options.images = valueNamed(imagesChoices, arguments.text("images"));
  options.normals = valueNamed(normalsChoices, arguments.text("normals"));
  options.dropped = valueNamed(dropChoices, arguments.text("drop"));
  options.keepAttributes = attributesNamed(arguments.text("keep-attributes"));
  if (!arguments.text("attribute-bits").empty())
    options.attributeBits = static_cast<std::uint32_t>(arguments.integer("attribute-bits"));
  options.textures = texturesFrom(arguments);
  options.patchVertices = static_cast<std::uint32_t>(arguments.integer("patch-vertices"));
  options.axes = {.up = valueNamed(upChoices, arguments.text("up")),
                  .rotations = rotationsFrom(arguments.text("rotate")),
                  .scale = factorFrom("--scale", arguments.text("scale")),
                  .exaggeration = factorFrom("--exaggerate", arguments.text("exaggerate")),
                  .metres = valueNamed(unitChoices, arguments.text("unit"))};
  options.rate = factorFrom("--rate", arguments.text("rate"));
  options.view = valueNamed(viewChoices, arguments.text("view"));
  options.pictures = !arguments.has("no-pictures");
  options.effort = static_cast<int>(arguments.integer("effort"));
  options.title = arguments.text("title");
  options.outside = arguments.has("outside");
  options.precompress = arguments.has("precompress");
  options.strict = arguments.has("strict");
  options.force = arguments.has("force");
  return options;
}

} // namespace imgeo::cli
