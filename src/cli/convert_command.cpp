#include "base/file.h"
#include "base/parallel.h"
#include "cli/commands.h"
#include "cli/convert_json.h"
#include "cli/convert_options.h"
#include "cli/convert_report.h"
#include "cli/embed_snippet.h"
#include "cli/input_files.h"
#include "cli/interruption.h"
#include "cli/shell_word.h"
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

/// What ranks that do not write the site say.
void printShare(const Arguments& arguments, const RankOptions& ranks, const ConvertReport& report) {
  if (arguments.has("json"))
    fmt::print("{}", shareJson(ranks, report));
  else if (report.tasks == 0)
    fmt::print("Rank 0 converts {} alone: it is not converted out of core.\n", arguments.list("input").front());
  else
    fmt::print("Rank {} of {} has done {} of {} tasks, in {:.2f} s and at most {} of memory.\n", ranks.rank,
               ranks.count, report.tasksTaken, report.tasks, report.totalSeconds, byteSize(report.peakMemoryBytes));
}

} // namespace

int runConvert(const Arguments& arguments, const RankOptions* launched) {
  handleSignals();
  limitThreads(static_cast<std::size_t>(arguments.integer("threads")));
  const std::string& output = arguments.text("output");
  ConvertReport report;
  ConvertOptions options = convertOptionsFrom(arguments);
  if (launched)
    options.ranks = *launched;
  {
    ProgressBar bar;
    report = convertSequence(inputFiles(arguments.list("input")), output, options,
                             [&](double fraction, const std::string& step) {
                               throwIfInterrupted();
                               bar.show(fraction, step);
                             });
  }
  if (options.ranks.rank > 0) {
    printShare(arguments, options.ranks, report);
    return 0;
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
  fmt::print("\nTo look at it: imgeo serve {}\n", shellWord(output));
  if (report.x3domUrl.empty())
    fmt::print("To embed it in a page beside this folder:\n{}\n", embedSnippet(output));
  return 0;
}

} // namespace imgeo::cli
