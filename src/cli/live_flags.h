#pragma once
// The rows of the commands that generate, serve or publish in the table of commands: those that may listen.

#include "cli/flags.h"

namespace imgeo::cli {

Command sampleCommand();
Command serveCommand();
Command publishCommand();

} // namespace imgeo::cli
