#pragma once
// The report of `imgeo convert` as JSON.

#include "cli/arguments.h"
#include "imgeo/convert.h"

#include <string>

namespace imgeo::cli {

/// The report, indented.
std::string convertJson(const Arguments& arguments, const ConvertReport& report);

/// The report of a rank that does not write the site, indented.
std::string shareJson(const RankOptions& ranks, const ConvertReport& report);

} // namespace imgeo::cli
