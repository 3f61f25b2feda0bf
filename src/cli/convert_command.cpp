#include "base/file.h"
#include "base/parallel.h"
#include "cli/commands.h"
#include "cli/convert_options.h"
#include "cli/convert_report.h"
#include "cli/embed_snippet.h"
#include "cli/input_files.h"
#include "cli/interruption.h"
#include "cli/terminal.h"
#include "imgeo/convert.h"
#include "imgeo/site.h"

#include <fmt/format.h>

namespace imgeo::cli {

namespace {

void printFiles(const std::filesystem::path& site) {
  fmt::print("\n");
  for (const SiteFile& file : inspect(site).files)
    fmt::print("{:10} {:>14}  {}\n", file.role, grouped(file.bytes), file.path);
}

} // namespace

int runConvert(const Arguments& arguments) {
  handleSignals();
  limitThreads(static_cast<std::size_t>(arguments.integer("threads")));
  const std::string& output = arguments.text("output");
  ConvertReport report;
  {
    ProgressBar bar;
    report = convertSequence(inputFiles(arguments.list("input")), output, convertOptionsFrom(arguments),
                             [&](double fraction, const std::string& step) {
                               throwIfInterrupted();
                               bar.show(fraction, step);
                             });
  }
  for (const std::string& warning : report.warnings)
    fmt::print(stderr, "imgeo: warning: {}\n", warning);
  const std::string json = convertJson(arguments, report);
  if (!arguments.text("report").empty())
    writeFile(arguments.text("report"), asBytes(json));
  if (arguments.has("json")) {
    fmt::print("{}", json);
    return 0;
  }
  printReport(arguments, report);
  if (arguments.has("verbose"))
    printFiles(output);
  printCosts(report);
  fmt::print("\nTo look at it: imgeo serve {}\n", output);
  if (report.x3domUrl.empty())
    fmt::print("To embed it in a page beside this folder:\n{}\n", embedSnippet(output));
  return 0;
}

} // namespace imgeo::cli
