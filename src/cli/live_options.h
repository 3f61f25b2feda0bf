#pragma once
// Options of commands that serve live streams.

#include "cli/arguments.h"
#include "imgeo/live.h"

namespace imgeo::cli {

/// The server that --host, --port, --site, --token and --view-token describe. Without --token nobody may publish,
/// unless the environment variable IMGEO_TOKEN has one.
live::ServerOptions serverOptionsOf(const Arguments& arguments);

/// --token, or the environment variable IMGEO_TOKEN; empty if there is neither.
std::string publishTokenOf(const Arguments& arguments);

} // namespace imgeo::cli
