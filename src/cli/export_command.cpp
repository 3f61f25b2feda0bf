#include "base/error.h"
#include "cli/commands.h"
#include "cli/element_counts.h"
#include "cli/interruption.h"
#include "cli/terminal.h"
#include "transcode/export/export_site.h"
#include "transcode/sample/sample_file.h"
#include "transcode/transform/transform_file.h"

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
                                      {"lightsLeftOut", report.lightsLeftOut}};
    fmt::print("{}\n", json.dump(2));
    return 0;
  }
  if (report.lightsLeftOut > 0)
    fmt::print(stderr,
               "imgeo: warning: {} left out: lights of glTF shine on everything and fall off with the square of the "
               "distance.\n",
               report.lightsLeftOut == 1 ? "1 light is" : fmt::format("{} lights are", report.lightsLeftOut));
  fmt::print("{}: {}, {}, {} vertices in {} {}, {}\n", arguments.text("output"), report.format, listed(report.elements),
             grouped(report.vertices), report.shapes, report.shapes == 1 ? "shape" : "shapes", byteSize(report.bytes));
  return 0;
}

} // namespace

int runExport(const Arguments& arguments) {
  handleSignals();
  return print(arguments, exportSite(arguments.text("site"), arguments.text("output")));
}

int runTransform(const Arguments& arguments) {
  handleSignals();
  const auto [written, warnings] = transformFile(arguments.text("input"), arguments.text("output"),
                                                 arguments.text("operators"), arguments.has("outside"));
  for (const std::string& warning : warnings)
    fmt::print(stderr, "imgeo: warning: {}\n", warning);
  return print(arguments, written);
}

int runSample(const Arguments& arguments) {
  handleSignals();
  if (arguments.has("live"))
    return runLiveSample(arguments);
  const std::string& what = arguments.text("sample");
  if (what != "hall")
    throw Error(ErrorKind::usage, "", fmt::format("{} is a motion: imgeo sample {} --live", what, what));
  if (arguments.text("output").empty())
    throw Error(ErrorKind::usage, "", "--output FILE is missing: imgeo sample hall -o FILE");
  const auto seats = static_cast<std::uint32_t>(arguments.integer("seats"));
  return print(arguments, writeSampleHall(seats, arguments.text("output")));
}

} // namespace imgeo::cli
