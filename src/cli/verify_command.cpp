#include "cli/commands.h"
#include "cli/input_files.h"
#include "cli/interruption.h"
#include "cli/memory_size.h"
#include "cli/terminal.h"
#include "imgeo/verify.h"

#include <cctype>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace imgeo::cli {

namespace {

constexpr int notEqual = 3;

void printJson(const VerifyReport& report) {
  nlohmann::ordered_json json{{"equal", report.equal}};
  for (const Topology kind : allTopologies) {
    std::string name = nameOf(kind);
    name[0] = static_cast<char>(std::toupper(name[0]));
    json["input" + name] = report.input.of(kind);
    json["site" + name] = report.site.of(kind);
    json["missing" + name] = report.missing.of(kind);
    json["extra" + name] = report.extra.of(kind);
  }
  json["positionError"] = report.positionError;
  json["positionBound"] = report.positionBound;
  json["normalErrorDegrees"] = report.normalErrorDegrees;
  json["normalBoundDegrees"] = report.normalBoundDegrees;
  json["attributeError"] = report.attributeError;
  if (report.frames > 0)
    json["frames"] = report.frames;
  if (report.resampledMeshes > 0)
    json["resampled"] = {{"meshes", report.resampledMeshes},
                         {"largestDistance", report.surfaceDistance},
                         {"statedDistance", report.surfaceDistanceBound}};
  if (report.instances > 0)
    json["instances"] = {{"shapes", report.instances},
                         {"largestDistance", report.instanceDistance},
                         {"statedDistance", report.instanceDistanceBound}};
  json["materials"] = report.comparedMaterials;
  json["notCompared"] = report.notCompared;
  json["findings"] = report.findings;
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void printText(const VerifyReport& report) {
  for (const Topology kind : allTopologies)
    if (report.input.of(kind) + report.site.of(kind) > 0)
      fmt::print("{} {} in the input, {} in the site: {} missing, {} extra\n", bold(fmt::format("{:10}", nameOf(kind))),
                 grouped(report.input.of(kind)), grouped(report.site.of(kind)), grouped(report.missing.of(kind)),
                 grouped(report.extra.of(kind)));
  if (report.resampledMeshes > 0)
    fmt::print("{} {} {} geometry images, sampled anew: off by at most {:.6g}, and the site states {:.6g}\n",
               bold(fmt::format("{:10}", "surfaces")), grouped(report.resampledMeshes),
               report.resampledMeshes == 1 ? "mesh is" : "meshes are", report.surfaceDistance,
               report.surfaceDistanceBound);
  if (report.instances > 0)
    fmt::print("{} {} {} of others: off by at most {:.6g}, and the site states {:.6g}\n",
               bold(fmt::format("{:10}", "instances")), grouped(report.instances),
               report.instances == 1 ? "shape is an instance" : "shapes are instances", report.instanceDistance,
               report.instanceDistanceBound);
  if (report.frames > 0)
    fmt::print("{} {} compared\n", bold(fmt::format("{:10}", "frames")), grouped(report.frames));
  if (report.positionBound > 0)
    fmt::print("{} off by at most {:.6g} an axis; half a step is {:.6g}\n", bold(fmt::format("{:10}", "positions")),
               report.positionError, report.positionBound);
  if (report.normalBoundDegrees > 0)
    fmt::print("{} off by at most {:.4g} degrees; their rounding allows {:.4g}\n",
               bold(fmt::format("{:10}", "normals")), report.normalErrorDegrees, report.normalBoundDegrees);
  if (report.isForeign)
    fmt::print("Another program wrote the site: how its files are named, and normals that the input lacks, are "
               "not checked.\n");
  if (report.attributeError > 0)
    fmt::print("{} off by at most {:.4g} of what their rounding allows\n", bold(fmt::format("{:10}", "attributes")),
               report.attributeError);
  if (report.comparedMaterials > 0)
    fmt::print("{} of {} shapes compared; lights, viewpoints and pictures are not\n",
               bold(fmt::format("{:10}", "materials")), grouped(report.comparedMaterials));
  for (const std::string& sentence : report.notCompared)
    fmt::print("{}\n", sentence);
  for (const std::string& finding : report.findings)
    fmt::print("{}\n", finding);
  fmt::print("{}\n", !report.equal                ? "The site does not equal its input."
                     : report.resampledMeshes > 0 ? "The site is its input, resampled within what it states."
                                                  : "The site equals its input.");
}

} // namespace

int runVerify(const Arguments& arguments) {
  handleSignals();
  VerifyOptions options;
  options.outside = arguments.has("outside");
  if (!arguments.text("memory").empty())
    options.memoryBytes = memoryFrom(arguments.text("memory"));
  options.workFolder = arguments.text("work");
  const VerifyReport report = verifySequence(arguments.text("site"), inputFiles(arguments.list("input")), options);
  if (arguments.has("json"))
    printJson(report);
  else
    printText(report);
  return report.equal ? 0 : notEqual;
}

} // namespace imgeo::cli
