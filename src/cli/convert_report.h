#pragma once
// The report of `imgeo convert`, as JSON and as text.

#include "cli/arguments.h"
#include "imgeo/convert.h"

#include <string>

namespace imgeo::cli {

/// The report as indented JSON.
std::string convertJson(const Arguments& arguments, const ConvertReport& report);

/// The report of a rank that does not write the site, as indented JSON.
std::string shareJson(const RankOptions& ranks, const ConvertReport& report);

/// Prints the options that were chosen, errors and sizes.
void printReport(const Arguments& arguments, const ConvertReport& report);

/// Prints time and memory.
void printCosts(const ConvertReport& report);

} // namespace imgeo::cli
