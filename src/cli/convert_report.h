#pragma once
// The report of `imgeo convert` as text; convert_json.h has it as JSON.

#include "cli/arguments.h"
#include "imgeo/convert.h"

namespace imgeo::cli {

/// Prints the options that were chosen, errors and sizes.
void printReport(const Arguments& arguments, const ConvertReport& report);

/// Prints time and memory.
void printCosts(const ConvertReport& report);

} // namespace imgeo::cli
