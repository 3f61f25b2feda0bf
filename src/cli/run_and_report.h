#pragma once
// What programs do with errors.

#include <functional>
#include <string>

namespace imgeo::cli {

/// Calls body, which returns the exit code of the process. Reports every exception as one sentence behind the name of
/// the program, and returns the documented exit code. Ends the process by a signal that has arrived (interruption.h),
/// whatever exception its arrival has caused.
int runAndReport(const std::string& program, const std::function<int()>& body);

} // namespace imgeo::cli
