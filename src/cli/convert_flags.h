#pragma once
// The row of convert in the table of commands: its texts and its flags.

#include "cli/flags.h"

namespace imgeo::cli {

Command convertCommand();

} // namespace imgeo::cli
