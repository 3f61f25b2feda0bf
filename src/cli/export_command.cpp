#include "cli/commands.h"
#include "cli/terminal.h"
#include "transcode/transcode.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace imgeo::cli {

int runExport(const Arguments& arguments) {
  const ExportReport report = exportSite(arguments.text("site"), arguments.text("output"));
  if (arguments.has("json")) {
    const nlohmann::ordered_json json{{"format", report.format},       {"shapes", report.shapes},
                                      {"triangles", report.triangles}, {"points", report.points},
                                      {"vertices", report.vertices},   {"bytes", report.bytes}};
    fmt::print("{}\n", json.dump(2));
    return 0;
  }
  std::string elements;
  if (report.triangles > 0)
    elements += grouped(report.triangles) + " triangles, ";
  if (report.points > 0)
    elements += grouped(report.points) + " points, ";
  fmt::print("{}: {}, {}{} vertices in {} {}, {}\n", arguments.text("output"), report.format, elements,
             grouped(report.vertices), report.shapes, report.shapes == 1 ? "shape" : "shapes",
             byteSize(report.bytes));
  return 0;
}

} // namespace imgeo::cli
