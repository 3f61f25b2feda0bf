#include "base/error.h"
#include "cli/commands.h"
#include "cli/heap.h"
#include "cli/help.h"
#include "cli/interruption.h"
#include "imgeo/version.h"

#include <cstdio>
#include <exception>
#include <fmt/format.h>
#include <new>
#include <system_error>

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

/// Ends the process by a signal that has arrived, whatever exception its arrival has caused.
int runUnlessInterrupted(const Arguments& arguments) {
  try {
    return run(arguments);
  } catch (...) {
    endProcessIfInterrupted();
    throw;
  }
}

int report(int code, const std::string& message) {
  fmt::print(stderr, "imgeo: {}\n", message);
  return code;
}

/// Runs the command. Reports every exception as one sentence and the documented exit code.
int runAndReport(int count, char** words) {
  try {
    const int code = runUnlessInterrupted(parseArguments({words + 1, words + count}));
    if (std::fflush(stdout) != 0)
      return report(exitCode(ErrorKind::io), "standard output cannot be written");
    return code;
  } catch (const Error& error) {
    return report(exitCode(error.kind()), error.what());
  } catch (const std::bad_alloc&) {
    return report(exitCode(ErrorKind::limit), "there is not enough memory for this");
  } catch (const std::system_error& error) {
    return report(exitCode(ErrorKind::io), error.what());
  } catch (const std::exception& error) {
    return report(4, fmt::format("internal error: {}", error.what()));
  } catch (...) {
    return report(4, "internal error");
  }
}

} // namespace

} // namespace imgeo::cli

int main(int count, char** words) {
  imgeo::cli::prepareHeap();
  return imgeo::cli::runAndReport(count, words);
}
