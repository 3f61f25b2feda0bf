#include "base/error.h"
#include "cli/commands.h"
#include "cli/element_counts.h"
#include "cli/interruption.h"
#include "cli/terminal.h"
#include "transcode/export/export_site.h"
#include "transcode/sample/sample_file.h"
#include "transcode/site/listed_elements.h"
#include "transcode/transform/transform_file.h"

#include <charconv>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace imgeo::cli {

namespace {

int print(const Arguments& arguments, const ExportReport& report) {
  if (arguments.has("json")) {
    const nlohmann::ordered_json json{{"format", report.format},
                                      {"shapes", report.shapes},
                                      {"triangles", report.elements.triangles},
                                      {"lines", report.elements.lines},
                                      {"points", report.elements.points},
                                      {"vertices", report.vertices},
                                      {"bytes", report.bytes},
                                      {"lightsLeftOut", report.lightsLeftOut},
                                      {"routesLeftOut", report.routesLeftOut},
                                      {"geometryLeftOut", nlohmann::ordered_json(report.geometryLeftOut)},
                                      {"choicesWritten", nlohmann::ordered_json(report.choicesWritten)},
                                      {"warnings", report.warnings}};
    fmt::print("{}\n", json.dump(2));
    return 0;
  }
  if (report.lightsLeftOut > 0)
    fmt::print(stderr,
               "imgeo: warning: {} left out: lights of glTF shine on everything and fall off with the square of the "
               "distance.\n",
               report.lightsLeftOut == 1 ? "1 light is" : fmt::format("{} lights are", report.lightsLeftOut));
  if (report.routesLeftOut > 0)
    fmt::print(stderr,
               "imgeo: warning: {} left out: glTF moves nodes, and weights of displacers, by a TimeSensor and an "
               "interpolator.\n",
               report.routesLeftOut == 1 ? "1 ROUTE is" : fmt::format("{} ROUTEs are", report.routesLeftOut));
  if (!report.geometryLeftOut.empty())
    fmt::print(stderr, "imgeo: warning: Geometry of which no mesh can be made is left out: {}.\n",
               imgeo::listed(report.geometryLeftOut));
  if (!report.choicesWritten.empty())
    fmt::print(stderr, "imgeo: warning: All children are written of nodes of which pages show one: {}.\n",
               imgeo::listed(report.choicesWritten));
  for (const std::string& warning : report.warnings)
    fmt::print(stderr, "imgeo: warning: {}\n", warning);
  fmt::print("{}: {}, {}, {} vertices in {} {}, {}\n", arguments.text("output"), report.format, listed(report.elements),
             grouped(report.vertices), report.shapes, report.shapes == 1 ? "shape" : "shapes", byteSize(report.bytes));
  return 0;
}

} // namespace

namespace {

/// "out/cloth.ply" as "out/cloth-0012.ply".
std::filesystem::path numbered(const std::filesystem::path& file, std::uint32_t frame) {
  return file.parent_path() / fmt::format("{}-{:04}{}", file.stem().string(), frame, file.extension().string());
}

ExportReport exportAllFrames(const Arguments& arguments) {
  const std::uint32_t count = frameCountOf(arguments.text("site"));
  ExportReport sum;
  for (std::uint32_t frame = 0; frame < count; ++frame) {
    throwIfInterrupted();
    const std::uint64_t bytes = sum.bytes;
    sum = exportFrame(arguments.text("site"), frame, numbered(arguments.text("output"), frame));
    sum.bytes += bytes;
  }
  return sum;
}

} // namespace

int runExport(const Arguments& arguments) {
  handleSignals();
  const std::string& frame = arguments.text("frame");
  if (frame == "all")
    return print(arguments, exportAllFrames(arguments));
  if (!frame.empty()) {
    std::uint32_t number = 0;
    const auto [last, fault] = std::from_chars(frame.data(), frame.data() + frame.size(), number);
    if (fault != std::errc{} || last != frame.data() + frame.size())
      throw Error(ErrorKind::usage, "--frame", fmt::format("\"{}\" is neither a number nor all", frame));
    return print(arguments, exportFrame(arguments.text("site"), number, arguments.text("output")));
  }
  return print(arguments, exportSite(arguments.text("site"), arguments.text("output"), {},
                                     static_cast<std::uint32_t>(arguments.integer("level"))));
}

int runTransform(const Arguments& arguments) {
  handleSignals();
  const auto [written, warnings] = transformFile(arguments.text("input"), arguments.text("output"),
                                                 arguments.text("operators"), arguments.has("outside"));
  for (const std::string& warning : warnings)
    fmt::print(stderr, "imgeo: warning: {}\n", warning);
  return print(arguments, written);
}

namespace {

ExportReport writeSample(const Arguments& arguments, const std::string& what) {
  const auto number = [&](const char* name) { return static_cast<std::uint64_t>(arguments.integer(name)); };
  const std::string& output = arguments.text("output");
  const bool isShuffled = arguments.has("shuffled");
  if (what == "hall")
    return writeSampleHall(static_cast<std::uint32_t>(number("seats")), output);
  if (what == "boxes")
    return writeSampleBoxes(number("count"), number("seed"), isShuffled, output);
  if (number("points") > 0 && number("charts") > 0)
    throw Error(ErrorKind::usage, "--charts", "is of triangles, not of points");
  if (number("points") > 0)
    return writeSampleCloud(number("points"), isShuffled, output);
  if (number("charts") > 0)
    return writeSampleReliefInCharts(number("triangles"), number("charts"), isShuffled, output);
  return writeSampleRelief(number("triangles"), isShuffled, output);
}

} // namespace

int runSample(const Arguments& arguments) {
  handleSignals();
  if (arguments.has("live"))
    return runLiveSample(arguments);
  const std::string& what = arguments.text("sample");
  if (what != "hall" && what != "relief" && what != "boxes")
    return runFramesSample(arguments);
  if (arguments.text("output").empty())
    throw Error(ErrorKind::usage, "", fmt::format("--output FILE is missing: imgeo sample {} -o FILE", what));
  return print(arguments, writeSample(arguments, what));
}

} // namespace imgeo::cli
