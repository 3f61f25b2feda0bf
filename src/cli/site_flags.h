#pragma once
// The rows of the commands that read a site or a mesh file in the table of commands.

#include "cli/flags.h"

namespace imgeo::cli {

Command infoCommand();
Command verifyCommand();
Command exportCommand();
Command transformCommand();

} // namespace imgeo::cli
