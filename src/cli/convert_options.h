#pragma once
// Turns the arguments of `imgeo convert` into ConvertOptions.

#include "cli/arguments.h"
#include "imgeo/convert.h"

namespace imgeo::cli {

/// Throws Error{usage} for values that the parser cannot check.
ConvertOptions convertOptionsFrom(const Arguments& arguments);

} // namespace imgeo::cli
