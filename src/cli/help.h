#pragma once
// The flag table as text: help on a terminal, and the manual page.

#include "cli/flags.h"

#include <string>

namespace imgeo::cli {

/// `imgeo --help`
std::string overview();

/// `imgeo COMMAND --help`
std::string helpOf(const Command& command);

/// The manual page in troff's man macros.
std::string manualPage(const std::string& version);

} // namespace imgeo::cli
