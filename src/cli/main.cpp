#include "cli/commands.h"
#include "cli/heap.h"
#include "cli/help.h"
#include "cli/run_and_report.h"
#include "imgeo/version.h"

#include <fmt/format.h>

namespace imgeo::cli {

namespace {

int run(const Arguments& arguments) {
  if (!arguments.command) {
    fmt::print("{}", arguments.has("help") ? overview() : fmt::format("imgeo {}\n", version()));
    return 0;
  }
  if (arguments.has("help")) {
    fmt::print("{}", helpOf(*arguments.command));
    return 0;
  }
  const std::string& name = arguments.command->name;
  if (name == "convert")
    return runConvert(arguments);
  if (name == "info")
    return runInfo(arguments);
  if (name == "verify")
    return runVerify(arguments);
  if (name == "export")
    return runExport(arguments);
  if (name == "transform")
    return runTransform(arguments);
  if (name == "sample")
    return runSample(arguments);
  if (name == "serve")
    return runServe(arguments);
  if (name == "publish")
    return runPublish(arguments);
  if (name == "completion")
    return runCompletion(arguments);
  return runManual(arguments);
}

} // namespace

} // namespace imgeo::cli

int main(int count, char** words) {
  imgeo::cli::prepareHeap();
  return imgeo::cli::runAndReport("imgeo", [&] {
    return imgeo::cli::run(imgeo::cli::parseArguments({words + 1, words + count}));
  });
}
