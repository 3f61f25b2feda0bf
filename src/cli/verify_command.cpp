#include "cli/commands.h"
#include "cli/terminal.h"
#include "transcode/transcode.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace imgeo::cli {

namespace {

constexpr int notEqual = 3;

void printJson(const VerifyReport& report) {
  const nlohmann::ordered_json json{{"equal", report.equal},
                                    {"inputTriangles", report.inputTriangles},
                                    {"siteTriangles", report.siteTriangles},
                                    {"missingTriangles", report.missingTriangles},
                                    {"extraTriangles", report.extraTriangles},
                                    {"inputPoints", report.inputPoints},
                                    {"sitePoints", report.sitePoints},
                                    {"missingPoints", report.missingPoints},
                                    {"extraPoints", report.extraPoints},
                                    {"positionError", report.positionError},
                                    {"positionBound", report.positionBound},
                                    {"normalErrorDegrees", report.normalErrorDegrees},
                                    {"normalBoundDegrees", report.normalBoundDegrees},
                                    {"findings", report.findings}};
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void printElements(const char* kind, std::size_t input, std::size_t site, std::size_t missing,
                   std::size_t extra) {
  if (input + site == 0)
    return;
  fmt::print("{} {} in the input, {} in the site: {} missing, {} extra\n", bold(fmt::format("{:10}", kind)),
             grouped(input), grouped(site), grouped(missing), grouped(extra));
}

void printText(const VerifyReport& report) {
  printElements("triangles", report.inputTriangles, report.siteTriangles, report.missingTriangles,
                report.extraTriangles);
  printElements("points", report.inputPoints, report.sitePoints, report.missingPoints, report.extraPoints);
  fmt::print("{} off by at most {:.6g} an axis; half a step is {:.6g}\n",
             bold(fmt::format("{:10}", "positions")), report.positionError, report.positionBound);
  if (report.normalBoundDegrees > 0)
    fmt::print("{} off by at most {:.4g} degrees; their rounding allows {:.4g}\n",
               bold(fmt::format("{:10}", "normals")), report.normalErrorDegrees, report.normalBoundDegrees);
  for (const std::string& finding : report.findings)
    fmt::print("{}\n", finding);
  fmt::print("{}\n", report.equal ? "The site equals its input." : "The site does not equal its input.");
}

} // namespace

int runVerify(const Arguments& arguments) {
  const VerifyReport report = verify(arguments.text("site"), arguments.text("input"));
  if (arguments.has("json"))
    printJson(report);
  else
    printText(report);
  return report.equal ? 0 : notEqual;
}

} // namespace imgeo::cli
