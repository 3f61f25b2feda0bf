#include "cli/run_and_report.h"

#include "base/error.h"
#include "cli/interruption.h"

#include <cstdio>
#include <exception>
#include <fmt/format.h>
#include <new>
#include <system_error>

namespace imgeo::cli {

namespace {

int runUnlessInterrupted(const std::function<int()>& body) {
  try {
    return body();
  } catch (...) {
    endProcessIfInterrupted();
    throw;
  }
}

} // namespace

int runAndReport(const std::string& program, const std::function<int()>& body) {
  const auto report = [&](int code, const std::string& message) {
    fmt::print(stderr, "{}: {}\n", program, message);
    return code;
  };
  try {
    const int code = runUnlessInterrupted(body);
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

} // namespace imgeo::cli
